// The limit of coordinates.
#pragma once
#include "geometry/polyhedron.h"

namespace voussoir {

/// Largest coordinate, m. National grids reach 10,000 km from their origins. Larger coordinates no longer resolve
/// micrometres, and squares and cubes of lengths may overflow.
inline constexpr double farthest = 1e7;

/// Whether all coordinates are within the limit; false for NaN.
inline bool within_reach(const Vec3& point) {
  return (point.array().abs() <= farthest).all();
}

}  // namespace voussoir
