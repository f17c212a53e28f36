// Modes of setups by one model of all (PreGER). Private to solver/identify.
#pragma once
#include "solver/identify/setups.h"
#include "solver/identify/ssi_problem.h"

namespace voussoir {

/// Channels that all setups have and can use: their names, in the order of the first. Empty: setups cannot be put
/// together before they are identified.
std::vector<std::string> common_references(const std::vector<SsiProblem>& problems);

/// Modes from one model of all setups, which have `problems` and were identified one by one as `results`. Throws
/// InputError where no channel is in all setups.
SsiResult identify_jointly(const std::vector<Setup>& setups, const std::vector<SsiProblem>& problems,
                           const std::vector<SsiResult>& results, const SsiSettings& settings);

}  // namespace voussoir
