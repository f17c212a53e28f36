// A load pattern: the difference between two sets of loads, and the displacement of the structure along it.
#pragma once
#include "solver/linear/unknowns.h"
#include "solver/step/loads.h"

namespace voussoir {

/// Loads in which each point and each node appears once, so that their difference is well defined: `from` before, `to`
/// after.
LoadsAtWork one_a_point(LoadsAtWork loads);
/// The same for two sets of loads: the first acts before, the second after.
LoadsAtWork pattern_between(const LoadsAtWork& before, const LoadsAtWork& after);

/// The total loads at a share: from + share (to − from), stored in `to`. The share may be outside 0 to 1.
LoadsAtWork at_share(LoadsAtWork loads, double share);
/// The same, stored in the result of an earlier at_share() without new memory.
void set_share(const LoadsAtWork& pattern, double share, LoadsAtWork& loads);

/// Σ |to − from| of forces on points and nodes, and of mass times acceleration, N.
double pattern_force(const Model& model, const LoadsAtWork& pattern);
/// Displacement of the loaded points along the pattern since the reference placement, m: the mean, weighted by force,
///   a = Σ (to − from)·u / Σ |to − from|,
/// so that force and displacement are conjugate. 0 without a pattern.
double pattern_displacement(const Model& model, const State& state, const LoadsAtWork& pattern);

/// The pattern over the unknowns, at the present placement (N, N m): the derivative of the out-of-balance forces with
/// respect to the multiplier, and of Σ |to − from| a with respect to the unknowns.
Eigen::VectorXd pattern_vector(const Model& model, const State& state, const Unknowns& unknowns,
                               const LoadsAtWork& pattern);

/// Of each body, whether forces of the pattern act on it; empty if the pattern acts on all or is empty.
std::vector<char> bodies_loaded(const Model& model, const LoadsAtWork& pattern);

}  // namespace voussoir
