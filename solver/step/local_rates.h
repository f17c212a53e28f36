// Bound on the time step for each body and each node of the fill, from the stiffness around it and without the
// eigenvalue problem of the whole assembly.
#pragma once
#include "solver/step/critical_step.h"

namespace voussoir {

/// Largest eigenvalues of the block of one site in M⁻¹K with all patches intact, 1/s2; zero for a site that cannot
/// move.
struct LocalRate {
  double displacement = 0.0;  // of displacements only, with all other sites held
  double own = 0.0;           // of displacements and rotations, with all other sites held
  double bound = 0.0;         // including the motion of its neighbours: the largest value of all sites is at least
                              // ω_max²
};

/// The rates of all sites: bodies, then nodes of the fill. A patch between a and b strains by x_a − x_b, and (x_a −
/// x_b)² <= (1 + c) x_a² + (1 + 1/c) x_b² for any c > 0: with c the ratio of the two bodies' own rates, K is at most a
/// block diagonal matrix whose blocks give `bound` (docs/theory/bodies.md). Without a fill, twice the largest own rate
/// is also a bound. Nodes are bounded by the sums of the norms in their rows (Gershgorin).
std::vector<LocalRate> local_rates(const Model& model, const State& state);

/// 2/√rate: the longest stable time step (s) at that rate (1/s2). 0 for a rate of 0.
double step_at(double rate);

}  // namespace voussoir
