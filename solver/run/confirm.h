// Dynamic confirmation of static collapse loads.
#pragma once
#include <atomic>

#include "geometry/assembly.h"
#include "solver/model/settings.h"

namespace voussoir {

/// Runs the stages of the settings, raises the loads smoothly to `loads` within `rise` seconds and holds them for twice
/// this time, with the damping of the settings. Returns true if a body moves by more than `limit` (m) during this hold
/// and does not slow down, if it moves farther than the size of a block, or if the run fails. A motion that slows down
/// is a settlement.
bool moves_away(const Assembly& assembly, const SolverSettings& settings, const Loads& loads, double rise, double limit,
                int threads, const std::atomic<bool>* stop);

}  // namespace voussoir
