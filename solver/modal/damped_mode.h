// Frequency and damping ratio of a mode with the damping of a case.
#pragma once
#include "solver/model/settings.h"

namespace voussoir {

struct DampedMode {
  double frequency = 0.0;  // Hz, of the decaying vibration; 0: none (overdamped, or no frequency without damping)
  double ratio = 0.0;      // damping ratio: −Re s/|s| of the pole s
  double period() const { return frequency > 0.0 ? 1.0 / frequency : 0.0; }  // s
};

/// `frequency` (Hz) is the undamped one. All joints have the same damping per stiffness and all bodies the same per
/// mass, so the mode shape does not change. The effect of the finite time step is negligible (docs/theory/modes.md).
DampedMode damped_mode(const DampingSettings& damping, double frequency);

}  // namespace voussoir
