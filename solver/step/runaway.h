// Words for a step that has run away.
#pragma once
#include <string>

#include "solver/step/stepper.h"

namespace voussoir {

/// "block 12 (arch)".
std::string body_name(const Assembly& assembly, const Model& model, std::int32_t body);
/// What an advance that ended in StepOutcome::runaway met, where, and what to do about it.
std::string runaway_text(const Assembly& assembly, const Model& model, const State& state, const Advance& last);

}  // namespace voussoir
