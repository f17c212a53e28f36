// A bridge that is built step by step: what is not there yet, and what is free of stress when it comes
// (docs/theory/construction.md).
#pragma once
#include "solver/model/state.h"

namespace voussoir {

/// Before the first step: no joint carries anything, no patch with the fill is there. The model must have a plan.
void clear_site(const Model& model, State& state);

/// What a step adds is there now. A joint whose two stones are, is made: the jump that it has is the one at which it is
/// free of stress. So are patches with the fill, and tetrahedra in the shape that their nodes give them.
void add_step(std::int32_t step, Model& model, State& state);

/// The model while only the steps up to this one are done: what is not there yet, or stands on centering, is held and
/// weighs nothing to the rest; contacts are not looked for.
Model during_step(const Model& model, std::int32_t step);

}  // namespace voussoir
