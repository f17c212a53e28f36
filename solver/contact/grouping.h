// Groups patches that are computed in the same way into batches. Eight patches side by side cost as much as the most
// expensive of them, so one patch that is evaluated point by point slows down seven others. As damage spreads, the
// joints and contacts of a tile are therefore reordered from time to time: intact patches first, then wholly open ones,
// then those evaluated point by point, then removed ones.
#pragma once
#include "solver/model/state.h"

namespace voussoir {

/// Least number of time steps between groupings.
constexpr std::int64_t grouping_interval = 128;

/// Groups the patches of every tile in which the saving is sufficient. The result depends only on the state. Positions
/// in Model::joints and slots of contacts change, and with them the order in which wrenches are summed: call
/// Stepper::prepare_contacts() afterwards.
void group_patches(Model& model, State& state, int threads);

/// Reorders the joints of a model to the order of a state from a file. Throws InputError if that is not a valid order
/// of these joints.
void take_joint_order(Model& model, const State& state);
/// Copies the stress-free jumps of the state to the joints of the model.
void take_built(Model& model, const State& state);

}  // namespace voussoir
