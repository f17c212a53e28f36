// Vibration modes from transfer functions of the ground's recorded motion (docs/theory/identification.md).
#pragma once
#include "solver/identify/transfer.h"

namespace voussoir {

struct DrivenSettings {
  int largest_count = 15;         // of poles, those set aside among them
  bool smoothed = true;           // the model is seen through the same window as the estimates
  double largest_damping = 0.2;   // ratio
  double largest_spread = 0.05;   // frequency_std over frequency
  double least_mean_phase = 0.5;  // MPC
  double largest_second = 0.5;    // second singular value of a residue over the first
};

/// A mode that the ground's motion excites.
struct DrivenMode {
  double frequency = 0.0, frequency_std = 0.0;  // Hz
  double damping = 0.0, damping_std = 0.0;      // ratio
  /// Per output. Of the components that are not lost in noise the largest is 1 in size, and the sum of squares of the
  /// imaginary parts is least.
  Eigen::VectorXcd shape;
  Eigen::VectorXd shape_std;          // of each of real and imaginary part
  Eigen::VectorXcd participation;     // per input: acceleration of the largest component over that of the ground
  Eigen::VectorXd participation_std;  // of each of real and imaginary part
  double mean_phase = 0.0;            // modal phase collinearity (Pappa et al. 1993) of these components
  double second = 0.0;                // second singular value of the residue over the first: 0 of one mode
};

struct UndrivenMode {
  DrivenMode mode;
  std::string reason;  // "its damping ratio is 0.31"
};

struct DrivenModes {
  std::vector<std::string> inputs, outputs;  // as of the transfer functions
  std::vector<DrivenMode> modes;             // ascending in frequency
  std::vector<UndrivenMode> set_aside;       // ascending in frequency
  double explained = 0.0;  // share of the transfer functions' power, each over its usual standard deviation; 0 to 1
};

/// Poles of all transfer functions at once, residues as shape × participationᵀ.
///
/// Fitted by variable projection (Golub & Pereyra 1973) with Ceres, one pole after the other as long as the Bayesian
/// information criterion (Schwarz 1978) falls. Throws InputError when fewer than 16 lines are finite or no pole is
/// asked for. Single-threaded, and the same bits for the same input.
DrivenModes driven_modes(const TransferFunctions& t, const DrivenSettings& settings = {});

}  // namespace voussoir
