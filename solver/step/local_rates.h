// What each body by itself asks of the time step: bounds from its own patches, without the eigenproblem of the whole.
#pragma once
#include "solver/step/critical_step.h"

namespace voussoir {

/// Largest eigenvalues of one body's own 6 × 6 blocks of M⁻¹K with all patches intact, 1/s2; zero of what cannot move.
struct LocalRate {
  double displacement = 0.0;  // of displacements alone, all other bodies held
  double own = 0.0;           // of displacements and rotations, all other bodies held
  double bound = 0.0;         // with its neighbours' motion: the largest over all bodies is at least ω_max²
};

/// Of all bodies. A patch between a and b strains by x_a − x_b, and (x_a − x_b)² <= (1 + c) x_a² + (1 + 1/c) x_b² for
/// any c > 0: with c the ratio of the two bodies' own rates, K is at most a block diagonal matrix whose blocks give
/// `bound` (docs/theory/bodies.md). Twice the largest own rate is a bound too.
std::vector<LocalRate> local_rates(const Model& model, const State& state);

/// 2/√rate: the longest stable step at that rate (s).
double step_at(double rate);

}  // namespace voussoir
