// Values of options, checked as they are read.
#pragma once
#include "tools/voussoir/verb.h"

namespace voussoir {

// Options with a number. Each has a range. A value outside of it, or one that is not finite, is refused when the
// options are read. If `to` is given, the value is also stored there.
options::typed_value<double>* real_option(const std::string& name, double low, double high, double* to = nullptr);
options::typed_value<int>* whole_option(const std::string& name, int low, int high, int* to = nullptr);

/// Throws InputError if the name of a file to write has the ending of another kind of file ("x.svg" for a picture of
/// pixels). `endings` are the allowed endings, `kind` names the file for the message ("a PNG picture").
void check_ending(const std::string& path, const std::vector<std::string>& endings, const char* kind);

}  // namespace voussoir
