// How far coordinates may go.
#pragma once
#include "geometry/polyhedron.h"

namespace voussoir {

/// m. Grids of whole countries reach 10,000 km from their origins. Beyond, a coordinate no longer tells micrometres,
/// and squares and cubes of lengths leave what a double holds.
inline constexpr double farthest = 1e7;

/// False for what is not a number, too.
inline bool within_reach(const Vec3& point) {
  return (point.array().abs() <= farthest).all();
}

}  // namespace voussoir
