// voussoir import of a deformable fill.
#pragma once
#include <string>

#include "tools/voussoir/verb.h"

namespace voussoir {

// Numbers of the verb's options; each throws InputError that names the option.
double positive(const options::variables_map& values, const char* name);
double zero_or_more(const options::variables_map& values, const char* name);
double angle(const options::variables_map& values, const char* name);  // rad, of degrees from 0 to below 90

bool is_fill_file(const std::string& path);
/// Reads the fill, puts it into the assembly it is for and writes that; returns the exit status.
int import_fill(const options::variables_map& values);

}  // namespace voussoir
