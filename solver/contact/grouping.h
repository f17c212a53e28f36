// Patches that are computed alike share batches. Eight patches side by side cost what the dearest of them costs: one
// that goes point by point takes seven others with it. As damage spreads the joints and the contacts of a tile are
// therefore put in a new order now and then: intact ones first, then those wholly open, those that go point by point,
// and what is gone.
#pragma once
#include "solver/model/state.h"

namespace voussoir {

/// Steps that must have passed since patches were last grouped.
constexpr std::int64_t grouping_interval = 128;

/// Groups the patches of every tile in which that saves something worth having; depends on the state alone. Places in
/// Model::joints and slots of contacts change, and with them the order in which wrenches are added up: call
/// Stepper::prepare_contacts() afterwards.
void group_patches(Model& model, State& state, int threads);

/// Puts the joints of a model as it was built, or of one in any other order, into that of a state that has been read.
/// Throws InputError where that is no order of these joints.
void take_joint_order(Model& model, const State& state);
/// Gives the model's joints the jumps at which the state has them free of stress.
void take_built(Model& model, const State& state);

}  // namespace voussoir
