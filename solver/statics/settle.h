// A state of a run brought to rest, its damage kept: the bridge as it stands after an earthquake.
#pragma once
#include "solver/statics/equilibrium.h"

namespace voussoir {

struct Settled {
  Equilibrium equilibrium;
  std::vector<std::int32_t> falling;  // bodies that fell freely: they stay where they were met
};

/// Stops all motion and relaxes (solver/statics/relaxation.cpp) under gravity and the stepper's loads, which must have
/// no damping branches. Stones in the air would fall for ever: one that has fallen by a tenth of a block and that no
/// closed joint ties to anything fixed is held until the rest stands, then let go again to land on it; at its third
/// fall it is held for good. Not converged after 400,000 steps: the structure is still coming down.
Settled settle(Stepper& stepper, double tolerance, const std::atomic<bool>* stop,
               const std::function<void(std::int64_t, double)>& progress);

}  // namespace voussoir
