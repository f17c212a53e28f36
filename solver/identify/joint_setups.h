// Modes from one joint model of all setups (PreGER). Private to solver/identify.
#pragma once
#include "solver/identify/setups.h"
#include "solver/identify/ssi_problem.h"

namespace voussoir {

/// Names of the channels that are usable in all setups, in the order of the first setup. Empty: the setups cannot be
/// merged before the identification.
std::vector<std::string> common_references(const std::vector<SsiProblem>& problems);

/// Modes from one joint model of all setups. `problems` and `results` are those of the separate setups. Throws
/// InputError if no channel is usable in all setups.
SsiResult identify_jointly(const std::vector<Setup>& setups, const std::vector<SsiProblem>& problems,
                           const std::vector<SsiResult>& results, const SsiSettings& settings);

}  // namespace voussoir
