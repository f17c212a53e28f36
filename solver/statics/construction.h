// Construction of a bridge step by step: absent parts, and new parts without stress (docs/theory/construction.md).
#pragma once
#include "solver/model/state.h"

namespace voussoir {

/// Sets the state before the first step: no joint carries a force, and there is no patch with the fill. The model must
/// have a plan.
void clear_site(const Model& model, State& state);

/// Adds the parts of a step. A joint is made when both its stones are present; its present jump is then its stress-free
/// jump. The same holds for patches with the fill and for the present shapes of tetrahedra.
void add_step(std::int32_t step, Model& model, State& state);

/// The model after the steps up to this one. Absent parts and parts on centering are held, and absent parts have no
/// weight. There is no contact search.
Model during_step(const Model& model, std::int32_t step);

}  // namespace voussoir
