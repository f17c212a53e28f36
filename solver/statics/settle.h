// Brings a state of a run to rest and keeps its damage: the bridge after an earthquake.
#pragma once
#include "solver/statics/equilibrium.h"

namespace voussoir {

struct Settled {
  Equilibrium equilibrium;
  std::vector<std::int32_t> falling;  // freely falling bodies: they are held where they were
};

/// Stops all motion and relaxes (solver/statics/relaxation.cpp) under gravity and the stepper's loads. The stepper must
/// have no damping branches. Stones without support would fall without end. A stone that has fallen by a tenth of a
/// block and is not connected to a fixed body by closed joints is therefore held until the rest stands, and then
/// released to land on it. At its third fall it is held permanently. If the relaxation does not converge in 400 000
/// iterations, the structure is still collapsing.
Settled settle(Stepper& stepper, double tolerance, const std::atomic<bool>* stop,
               const std::function<void(std::int64_t, double)>& progress);

}  // namespace voussoir
