// An order of points in which neighbours in space are near each other.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// Indices of the points along a Morton curve through their box; equal codes in the points' own order.
std::vector<std::int32_t> along_curve(const std::vector<Vec3>& points);
/// The same slab by slab across the longest side of that box: neighbours are then no farther apart in the order than
/// two slabs have points. `thickness` (m) is that of a slab.
std::vector<std::int32_t> in_slabs(const std::vector<Vec3>& points, double thickness);

}  // namespace voussoir
