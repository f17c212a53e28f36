// Messages for a run whose motion or energy has grown without limit.
#pragma once
#include <string>

#include "solver/step/energy.h"

namespace voussoir {

/// "block 12 (arch)".
std::string body_name(const Assembly& assembly, const Model& model, std::int32_t body);
/// Cause, place and remedy for an advance that ended in StepOutcome::runaway.
std::string runaway_text(const Assembly& assembly, const Model& model, const State& state, const Advance& last);
/// Names the terms of the energy balance that are not finite, and the first stone, joint or contact with a value that
/// is not finite. Empty if all terms are finite.
std::string not_finite_text(const Assembly& assembly, const Stepper& stepper, const Energies& energies);

}  // namespace voussoir
