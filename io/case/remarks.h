// Remarks on values that are possible but probably in another unit: a modulus in GPa, a record in cm/s2.
#pragma once
#include <string>
#include <vector>

#include "io/case/case.h"

namespace voussoir {

/// Remarks on a case: "FILE:LINE: youngs_modulus = 4 Pa in [materials.masonry]: usual … is …; if it was meant in GPa,
/// write 4e+09". Empty for a case with usual values. A remark never stops the program.
std::vector<std::string> remarks(const Case& c);

/// Remarks on an assembly: on its size and, if it comes from a file, on its materials. They begin with `name`.
std::vector<std::string> remarks(const Assembly& assembly, const std::string& name);

/// Remarks on both.
std::vector<std::string> remarks(const Case& c, const Assembly& assembly);

}  // namespace voussoir
