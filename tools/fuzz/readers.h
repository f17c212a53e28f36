// Everything that reads what people hand to the program, as functions of bytes: for the fuzzers and for the test that
// replays their corpus. Each takes any bytes and returns; errors that a person can act on are an answer, anything else
// that happens is a fault.
#pragma once
#include <string>

namespace voussoir::fuzz {

void read_case(const std::string& bytes);    // TOML cases: parsed, resolved, written and parsed again
void read_record(const std::string& bytes);  // records of ground motion in every format, measured curves
void read_surface(
    const std::string& bytes);             // OBJ, STL, PLY, COMPAS and glTF, by the first byte (0 to 4), down to shells
void read_mesh(const std::string& bytes);  // Gmsh files
void read_table(const std::string& bytes);     // folders of measurements: parts apart at lines "%% name"
void read_vehicle(const std::string& bytes);   // TOML vehicles
void read_json(const std::string& bytes);      // JSON
void read_assembly(const std::string& bytes);  // HDF5 assemblies

}  // namespace voussoir::fuzz
