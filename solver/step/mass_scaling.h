// Selective mass scaling: inertia, never weight, for the bodies and nodes that hold the critical step down.
#pragma once
#include "solver/step/local_rates.h"

namespace voussoir {

/// What mass scaling has done to a model.
struct MassScaling {
  double share = 0.0;             // added mass over the mass of all that can move
  std::int64_t bodies = 0;        // with more inertia than they had
  std::int64_t heavier = 0;       // and, of them, with more mass
  std::int64_t nodes = 0;         // of the fill, with more mass
  double largest = 1.0;           // factor on one mass
  double largest_rotary = 1.0;    // factor on one body's inertia tensor
  std::vector<Mat3> true_tensor;  // of all bodies, before, kg m2, reference axes
  bool at_work() const { return bodies > 0 || nodes > 0; }
};

/// Raises all bodies whose own rates (see LocalRate) are above `ceiling` (1/s2) to it: the mass by that of
/// displacements, the inertia tensor by that of displacements and rotations; and all such nodes. The assembly's ω_max²
/// is then at most 4 × ceiling, without a fill.
MassScaling raise_to(Model& model, const std::vector<LocalRate>& rates, double ceiling);

/// Scales so that the critical step reaches `step` (s), or, with step = 0, so that the added share of mass is `limit`.
/// Throws InputError when the step would take more than the limit.
MassScaling scale_mass(Model& model, const State& state, double step, double limit);

/// Bounds of what that costs the lowest frequencies of the intact assembly, as a share of each, ascending: each is
/// lower than with the true inertia, by no more than that. Ways that nothing holds are left out.
std::vector<double> frequency_shifts(const Model& model, const State& state, const MassScaling& scaling, int count);

}  // namespace voussoir
