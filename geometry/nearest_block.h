// The block at, or nearest to, a point.
#pragma once
#include "geometry/assembly.h"

namespace voussoir {

struct NearestBlock {
  std::int64_t block = -1;  // −1: there are no blocks
  double distance = 1e300;  // m, to its surface; 0 inside
};
/// Of blocks that share the point, the one with the lowest number. Blocks that stand for the ground behind an end
/// (restraint) are passed over: a point just off the bridge is on the bridge.
NearestBlock nearest_block(const Assembly& assembly, const Vec3& point);

}  // namespace voussoir
