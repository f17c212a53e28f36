// A pattern of loads: what lies between two sets of loads, and how far the structure goes along it.
#pragma once
#include "solver/linear/unknowns.h"
#include "solver/step/loads.h"

namespace voussoir {

/// Loads of which each point and each node appears once, so that a difference is one: `from` before, `to` after.
LoadsAtWork one_a_point(LoadsAtWork loads);
/// The same of two sets of loads, of which the first acts before and the second after.
LoadsAtWork pattern_between(const LoadsAtWork& before, const LoadsAtWork& after);

/// What acts at a share of the way, as a whole: from + share (to − from), now under `to`. The share need not lie
/// between 0 and 1.
LoadsAtWork at_share(LoadsAtWork loads, double share);
/// The same into loads that have come of at_share(), without new memory.
void set_share(const LoadsAtWork& pattern, double share, LoadsAtWork& loads);

/// Σ |to − from| of forces on points and nodes, and of mass times acceleration, N.
double pattern_force(const Model& model, const LoadsAtWork& pattern);
/// How far the loaded points have gone along the pattern since the reference placement, m: the mean, weighted by force,
///   a = Σ (to − from)·u / Σ |to − from|,
/// so that force and displacement are conjugate. 0 where there is no pattern.
double pattern_displacement(const Model& model, const State& state, const LoadsAtWork& pattern);

/// The pattern over the unknowns, at the present placement (N, N m): the derivative of the out-of-balance forces with
/// respect to the multiplier, and of Σ |to − from| a with respect to the unknowns.
Eigen::VectorXd pattern_vector(const Model& model, const State& state, const Unknowns& unknowns,
                               const LoadsAtWork& pattern);

/// Of each body whether the pattern's forces act on it; empty where the pattern acts on all, or there is none.
std::vector<char> bodies_loaded(const Model& model, const LoadsAtWork& pattern);

}  // namespace voussoir
