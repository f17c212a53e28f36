// Finds the block at a point, or the nearest one.
#pragma once
#include "geometry/assembly.h"

namespace voussoir {

struct NearestBlock {
  std::int64_t block = -1;  // −1: there are no blocks
  /// m; 0 inside. It is the largest distance beyond the plane of a face of a cell, so that it is less than the distance
  /// to the surface if the nearest point of the surface lies on an edge or at a corner.
  double distance = 1e300;
};
/// If several blocks contain the point, the one with the lowest number. Blocks of the component restraint are ignored,
/// so that a point just beside the bridge belongs to the bridge.
NearestBlock nearest_block(const Assembly& assembly, const Vec3& point);

}  // namespace voussoir
