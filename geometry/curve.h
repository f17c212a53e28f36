// Orders points so that neighbours in space are near each other in the order.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// Indices of the points along a Morton curve through their box. Points with equal codes keep their order.
std::vector<std::int32_t> along_curve(const std::vector<Vec3>& points);
/// The same in slabs across the longest side of that box, each `thickness` (m) thick. The indices of two points that
/// are less than `thickness` apart then differ by less than the number of points in two slabs.
std::vector<std::int32_t> in_slabs(const std::vector<Vec3>& points, double thickness);

}  // namespace voussoir
