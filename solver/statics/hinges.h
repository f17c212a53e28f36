// Hinges of an arch in a snapshot: joints that have opened by rotation.
#pragma once
#include "solver/statics/collapse.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// A hinge of an arch: neighbouring joints that opened on the same side count as one hinge, at the joint with the
/// largest rotation.
struct Hinge {
  std::int64_t a = 0, b = 0;  // blocks
  std::string edge;           // the closed edge: "intrados" or "extrados"
  Vec3 place = Vec3::Zero();  // m, middle of that edge, as built
  double turn = 0.0;          // rad, of this joint
  double y0 = 0.0, y1 = 0.0;  // m, range across the arch of all joints that count as this hinge, as built
};

/// Finds the hinges of arches along x, among the joints between voussoirs and between voussoirs and bases
/// (Component::base): those whose rotation is at least `share` of the largest rotation and at least `least` (rad).
/// Rotations are assumed to be small. The order is that of the joints of the assembly.
std::vector<Hinge> find_hinges(const Assembly& assembly, const Snapshot& snapshot, double share = 0.1,
                               double least = 1e-3);

}  // namespace voussoir
