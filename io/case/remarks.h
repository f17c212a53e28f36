// Values that can be computed with and are probably not what was meant: a modulus in GPa, a record in cm/s2.
#pragma once
#include <string>
#include <vector>

#include "io/case/case.h"

namespace voussoir {

/// Of a case: "FILE:LINE: youngs_modulus = 4 Pa in [materials.masonry]: usual … is …; if it was meant in GPa, write
/// 4e+09". Empty for a case of usual values. A remark stops nothing.
std::vector<std::string> remarks(const Case& c);

/// Of an assembly: its size; and of one that was read from a file its materials. `name` stands in front.
std::vector<std::string> remarks(const Assembly& assembly, const std::string& name);

/// Both.
std::vector<std::string> remarks(const Case& c, const Assembly& assembly);

}  // namespace voussoir
