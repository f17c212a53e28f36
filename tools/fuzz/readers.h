// All readers of input files as functions of bytes, for the fuzzers and for the test that repeats their corpus. Each
// function accepts any bytes. It ignores InputError and RunError; any other exception and any crash is a fault.
#pragma once
#include <string>

namespace voussoir::fuzz {

void read_case(const std::string& bytes);    // TOML cases: parsed, resolved, written and parsed again
void read_record(const std::string& bytes);  // records of ground motion in every format, measured curves
void read_surface(
    const std::string& bytes);             // OBJ, STL, PLY, COMPAS and glTF, by the first byte (0 to 4), down to shells
void read_mesh(const std::string& bytes);  // Gmsh files
void read_table(const std::string& bytes);     // folders of measurements: a line "%% name" begins each file
void read_vehicle(const std::string& bytes);   // TOML vehicles
void read_json(const std::string& bytes);      // JSON
void read_assembly(const std::string& bytes);  // HDF5 assemblies

}  // namespace voussoir::fuzz
