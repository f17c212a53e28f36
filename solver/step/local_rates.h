// What each body, and each node of the fill, by itself asks of the time step: bounds from what is around it, without
// the eigenproblem of the whole.
#pragma once
#include "solver/step/critical_step.h"

namespace voussoir {

/// Largest eigenvalues of one site's own block of M⁻¹K with all patches intact, 1/s2; zero of what cannot move.
struct LocalRate {
  double displacement = 0.0;  // of displacements alone, all other sites held
  double own = 0.0;           // of displacements and rotations, all other sites held
  double bound = 0.0;         // with its neighbours' motion: the largest over all sites is at least ω_max²
};

/// Of all sites: bodies, then nodes of the fill. A patch between a and b strains by x_a − x_b, and (x_a − x_b)² <= (1 +
/// c) x_a² + (1 + 1/c) x_b² for any c > 0: with c the ratio of the two bodies' own rates, K is at most a block diagonal
/// matrix whose blocks give `bound` (docs/theory/bodies.md). Twice the largest own rate is a bound too, without a fill.
/// Nodes are bounded by the sums of the norms in their rows (Gershgorin).
std::vector<LocalRate> local_rates(const Model& model, const State& state);

/// 2/√rate: the longest stable step at that rate (s).
double step_at(double rate);

}  // namespace voussoir
