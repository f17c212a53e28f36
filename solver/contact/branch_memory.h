// Starting the damping branches, and keeping them when the time step changes.
#pragma once
#include "solver/model/state.h"

namespace voussoir {

/// Gives every patch room for `to.count` branches and carries the viscous jumps q over: with the same number of branches as
/// before they are kept (another time step), else they start relaxed, q = 0, at the present placement.
void set_branches(const Model& model, State& state, const Branches& from, const Branches& to);

}  // namespace voussoir
