// Vibration modes from transfer functions of the recorded motion of the ground (docs/theory/identification.md).
#pragma once
#include "solver/identify/transfer.h"

namespace voussoir {

struct DrivenSettings {
  int largest_count = 15;         // largest number of poles, including those set aside
  bool smoothed = true;           // apply the window of the estimates to the model
  double largest_damping = 0.2;   // ratio
  double largest_spread = 0.05;   // frequency_std over frequency
  double least_mean_phase = 0.5;  // modal phase collinearity
  double largest_second = 0.5;    // second singular value of a residue over the first
};

/// A mode that the motion of the ground excites.
struct DrivenMode {
  double frequency = 0.0, frequency_std = 0.0;  // Hz
  double damping = 0.0, damping_std = 0.0;      // ratio
  /// One component for each output. The largest component above the noise has the absolute value 1, and the phase
  /// minimises the sum of squares of the imaginary parts.
  Eigen::VectorXcd shape;
  Eigen::VectorXd shape_std;          // of each of real and imaginary part
  Eigen::VectorXcd participation;     // per input: acceleration of the largest component over that of the ground
  Eigen::VectorXd participation_std;  // of each of real and imaginary part
  double mean_phase = 0.0;            // modal phase collinearity (Pappa et al. 1993) of these components
  double second = 0.0;                // second singular value of the residue over the first: 0 for a single mode
};

struct UndrivenMode {
  DrivenMode mode;
  std::string reason;  // "its damping ratio is 0.31"
};

struct DrivenModes {
  std::vector<std::string> inputs, outputs;  // as in the transfer functions
  std::vector<DrivenMode> modes;             // ascending in frequency
  std::vector<UndrivenMode> set_aside;       // ascending in frequency
  double explained = 0.0;  // explained share of the power of the transfer functions, each over its usual standard
                           // deviation; 0 to 1
};

/// Fits common poles to all transfer functions at once. The residue of a pole is shape × participationᵀ.
///
/// The method is variable projection (Golub & Pereyra 1973) with Ceres. It adds one pole after the other as long as the
/// Bayesian information criterion (Schwarz 1978) decreases. Throws InputError if fewer than 16 lines are finite or the
/// number of poles is 0. It uses one thread and gives the same bits for the same input.
DrivenModes driven_modes(const TransferFunctions& t, const DrivenSettings& settings = {});

}  // namespace voussoir
