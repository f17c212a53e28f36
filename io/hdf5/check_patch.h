// Common checks of joints between stones and of patches with the fill when they are read from a file.
#pragma once
#include <fmt/format.h>

#include <cmath>

#include "geometry/assembly.h"

namespace voussoir {

/// Calls `fail(dataset, reason)` for the first fault of a Joint or a FillJoint by itself.
template <class Patch, class Fail>
void check_patch(const Patch& patch, const Fail& fail) {
  if (patch.polygon.size() < 3) fail("joints/polygon_offset", "a patch needs at least 3 corners");
  if (std::abs(patch.normal.norm() - 1.0) > 1e-6) fail("joints/normal", "its length must be 1");
  if (!(patch.area > 0.0)) fail("joints/area", fmt::format("{} m2, expected more than 0", patch.area));
  if (!(patch.kn > 0.0)) fail("joints/kn", fmt::format("{} Pa/m, expected more than 0", patch.kn));
  if (!(patch.ks > 0.0)) fail("joints/ks", fmt::format("{} Pa/m, expected more than 0", patch.ks));
  const double area = polygon_area(patch.polygon);
  if (std::abs(area - patch.area) > 1e-3 * patch.area)
    fail("joints/area", fmt::format("{} m2, but its polygon has {} m2", patch.area, area));
  if (polygon_normal(patch.polygon).dot(patch.normal) < 0.99)
    fail("joints/polygon", "its corners must run counter-clockwise about the normal");
}

}  // namespace voussoir
