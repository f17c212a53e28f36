// voussoir import of a deformable fill.
#pragma once
#include <string>

#include "tools/voussoir/verb.h"

namespace voussoir {

double angle(const options::variables_map& values, const char* name);  // rad, of an option in degrees

/// Metres per unit, of --units or --scale. Throws InputError when both are given, and for an unknown unit.
double scale_asked(const options::variables_map& values);

bool is_fill_file(const std::string& path);
/// Reads the fill, puts it into the assembly it is for and writes that; returns the exit status.
int import_fill(const options::variables_map& values);

}  // namespace voussoir
