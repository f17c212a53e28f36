// Hinges of an arch as it stands: where its joints have turned open.
#pragma once
#include "solver/statics/collapse.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// A hinge of an arch: neighbouring joints that opened on the same side count as one, at the one that turned most.
struct Hinge {
  std::int64_t a = 0, b = 0;  // blocks
  std::string edge;           // that stays closed: "intrados" or "extrados"
  Vec3 place = Vec3::Zero();  // m, middle of that edge, as built
  double turn = 0.0;          // rad, of this joint
};

/// Of arches along x: among the joints between voussoirs, and of voussoirs with fixed bases, those that have turned by
/// at least `share` of what the one that turned most has, and by `least` (rad). Turns are taken to be small. In the
/// order of the assembly's joints.
std::vector<Hinge> find_hinges(const Assembly& assembly, const Snapshot& snapshot, double share = 0.1,
                               double least = 1e-3);

}  // namespace voussoir
