// Describes a deformable fill in words.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// Target values of the mesh; 0: not known.
struct FillAim {
  double volume = 0.0;  // m3, of the space of the fill
  double edge = 0.0;    // m, bound of the longest edge before the skew
  double skew = 0.0;    // rad, skew of the mesh afterwards
};

/// Aligned lines: sizes, volume, edges, angle and height. Empty for an assembly without a deformable fill.
std::vector<std::string> fill_lines(const Assembly& assembly, const FillAim& aim = {});

}  // namespace voussoir
