// A deformable fill in words, for those who look at an assembly.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// What is known of how the mesh should be; zero where it is not.
struct FillAim {
  double volume = 0.0;  // m3, of the space to be filled
  double edge = 0.0;    // m, bound of the longest edge as it is meshed
  double skew = 0.0;    // rad, to which the mesh was turned then
};

/// Aligned lines: sizes, volume, edges, angle and height. None for an assembly without a deformable fill.
std::vector<std::string> fill_lines(const Assembly& assembly, const FillAim& aim = {});

}  // namespace voussoir
