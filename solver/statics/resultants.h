// What joints carry at rest: the force of every patch.
#pragma once
#include "solver/step/snapshot.h"
#include "solver/step/stepper.h"

namespace voussoir {

/// What a patch puts on its block a; block b bears the opposite.
struct PatchForce {
  Vec3 force = Vec3::Zero();         // N
  Vec3 moment = Vec3::Zero();        // N m, about the origin of the world
  double shear_capacity = 0.0;       // N, see make_snapshot.h
  double largest_compression = 0.0;  // Pa, at an integration point or corner; positive
};

/// An equilibrium as joints bear it.
struct RestForces {
  Snapshot snapshot;               // without its fill
  std::vector<PatchForce> forces;  // of Snapshot::patches, in their order
  bool empty() const { return forces.empty(); }
};

/// Evaluates every patch once, on a copy of the state. The state must be at rest, without damping branches: what
/// branches bear is not counted.
RestForces forces_at_rest(const Model& model, const State& state);

}  // namespace voussoir
