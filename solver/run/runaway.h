// Words for a step that has run away.
#pragma once
#include <string>

#include "solver/step/energy.h"

namespace voussoir {

/// "block 12 (arch)".
std::string body_name(const Assembly& assembly, const Model& model, std::int32_t body);
/// What an advance that ended in StepOutcome::runaway met, where, and what to do about it.
std::string runaway_text(const Assembly& assembly, const Model& model, const State& state, const Advance& last);
/// Which terms of the ledger are not finite, and the first stone, joint or contact where something is not; empty when
/// all terms are.
std::string not_finite_text(const Assembly& assembly, const Stepper& stepper, const Energies& energies);

}  // namespace voussoir
