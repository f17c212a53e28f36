// A state of a run brought to rest, its damage kept: the bridge as it stands after an earthquake.
#pragma once
#include "solver/modal/equilibrium.h"

namespace voussoir {

struct Settled {
  Equilibrium equilibrium;
  std::vector<std::int32_t> falling;  // bodies that nothing held on the way: they stay where they were met
};

/// Stops all motion and relaxes (solver/modal/relaxation.cpp) under gravity and the stepper's loads, which must have no
/// damping branches. Stones in the air would fall for ever: between rounds of relaxation whatever no closed joint ties
/// to something fixed is held. Not converged after 400,000 steps: the structure is still coming down.
Settled settle(Stepper& stepper, double tolerance, const std::atomic<bool>* stop,
               const std::function<void(std::int64_t, double)>& progress);

}  // namespace voussoir
