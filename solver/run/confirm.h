// A dynamic second opinion on static collapse loads.
#pragma once
#include <atomic>

#include "geometry/assembly.h"
#include "solver/model/settings.h"

namespace voussoir {

/// Runs the settings' stages, raises the loads to `loads` within `rise` seconds (eased) and holds them twice as long,
/// with the settings' damping. True when a body moves by more than `limit` (m) while they are held and does not slow
/// down, or moves farther than a block's size, or the run fails. A motion that slows down is a settlement.
bool moves_away(const Assembly& assembly, const SolverSettings& settings, const Loads& loads, double rise, double limit,
                int threads, const std::atomic<bool>* stop);

}  // namespace voussoir
