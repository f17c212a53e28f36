// Joint forces at equilibrium: the force of every patch.
#pragma once
#include "solver/step/snapshot.h"
#include "solver/step/stepper.h"

namespace voussoir {

/// Force of a patch on its block a. The force on block b is the opposite.
struct PatchForce {
  Vec3 force = Vec3::Zero();   // N
  Vec3 moment = Vec3::Zero();  // N m, about the origin of the world
  // Both are 0 for ties and patches without force.
  double shear_capacity = 0.0;       // N, see make_snapshot.h
  double largest_compression = 0.0;  // Pa, at an integration point or corner; positive
};

/// Joint forces of an equilibrium.
struct RestForces {
  Snapshot snapshot;               // without its fill
  std::vector<PatchForce> forces;  // of Snapshot::patches, in their order
  bool empty() const { return forces.empty(); }
};

/// Evaluates every patch once, on a copy of the state. The state must be at rest and without damping branches, because
/// forces in branches are not counted.
RestForces forces_at_rest(const Model& model, const State& state);

}  // namespace voussoir
