// Selective mass scaling: raises the inertia, but not the weight, of the bodies and nodes that limit the critical time
// step.
#pragma once
#include "solver/step/local_rates.h"

namespace voussoir {

/// Effect of mass scaling on a model.
struct MassScaling {
  double share = 0.0;             // added mass over the mass of all that can move
  std::int64_t bodies = 0;        // number of bodies with increased inertia
  std::int64_t heavier = 0;       // number of these with increased mass
  std::int64_t nodes = 0;         // number of nodes of the fill with increased mass
  double largest = 1.0;           // factor on one mass
  double largest_rotary = 1.0;    // factor on one body's inertia tensor
  std::vector<Mat3> true_tensor;  // of all bodies, without scaling, kg m2, reference axes
  bool at_work() const { return bodies > 0 || nodes > 0; }
};

/// Lowers the own rates (see LocalRate) of all bodies and nodes above `ceiling` (1/s2) to it. The mass is scaled by the
/// rate of displacements, and the inertia tensor by that of displacements and rotations. Without a fill, ω_max² of the
/// assembly is then at most 4 × ceiling.
MassScaling raise_to(Model& model, const std::vector<LocalRate>& rates, double ceiling);

/// Scales so that the critical time step reaches `step` (s) or, with step = 0, so that the added share of mass is
/// `limit`. Throws InputError if the time step requires more than the limit.
MassScaling scale_mass(Model& model, const State& state, double step, double limit);

/// Upper bounds of the reduction of the lowest frequencies of the intact assembly, as a share of each frequency, in
/// ascending order of frequency. Degrees of freedom that nothing holds are left out. `scaling` must be at work.
std::vector<double> frequency_shifts(const Model& model, const State& state, const MassScaling& scaling, int count);

}  // namespace voussoir
