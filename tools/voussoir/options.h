// Values of options, checked as they are read.
#pragma once
#include "tools/voussoir/verb.h"

namespace voussoir {

// Numbers of options. Every one has a range: what is outside of it, or not a finite number, is refused as options are
// read. `to` is where the value goes besides.
options::typed_value<double>* real_option(const std::string& name, double low, double high, double* to = nullptr);
options::typed_value<int>* whole_option(const std::string& name, int low, int high, int* to = nullptr);

/// Throws InputError when the name of a file to write ends like that of another kind of file ("x.svg" for a picture of
/// pixels): `endings` are the right ones, `kind` what is written.
void check_ending(const std::string& path, const std::vector<std::string>& endings, const char* kind);

}  // namespace voussoir
