// voussoir import of a deformable fill.
#pragma once
#include <string>

#include "tools/voussoir/verb.h"

namespace voussoir {

double angle(const options::variables_map& values, const char* name);  // an option in degrees, converted to rad

/// Metres per unit, from --units or --scale. Throws InputError if both are given, and for an unknown unit.
double scale_asked(const options::variables_map& values);

/// Whether the name ends in .msh (Gmsh).
bool is_fill_file(const std::string& path);
/// Reads the fill, puts it into the assembly of --into, and writes that assembly. Returns the exit status.
int import_fill(const options::variables_map& values);

}  // namespace voussoir
