// Finds the block at a point, or the nearest one.
#pragma once
#include "geometry/assembly.h"

namespace voussoir {

struct NearestBlock {
  std::int64_t block = -1;  // −1: there are no blocks
  double distance = 1e300;  // m, to its surface; 0 inside
};
/// If several blocks contain the point, the one with the lowest number. Blocks of the component restraint are ignored,
/// so that a point just beside the bridge belongs to the bridge.
NearestBlock nearest_block(const Assembly& assembly, const Vec3& point);

}  // namespace voussoir
