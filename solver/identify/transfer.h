// Transfer functions from the motion of the ground to the sensors (docs/theory/identification.md).
#pragma once
#include "solver/identify/recording.h"

namespace voussoir {

struct TransferSettings {
  double highest_frequency = 0.0;  // Hz; 0: 20, or 0.4 of the sampling frequency if that is less
  double window = 0.0;             // s; 0: about a tenth of the longest recording
};

struct TransferFunctions {
  std::vector<std::string> inputs;             // channels base_x, base_y, base_z that were recorded and move
  std::vector<std::string> outputs;            // all other channels
  Eigen::VectorXd frequencies;                 // Hz, one for each line, without zero
  std::vector<Eigen::MatrixXcd> values;        // for each line: outputs × inputs, (m/s2)/(m/s2); NaN if inputs are
                                               // proportional
  std::vector<Eigen::MatrixXd> magnitude_std;  // for each line: standard deviation of |H|, outputs × inputs
  Eigen::MatrixXd coherence;                   // lines × outputs, multiple, 0 to 1
  double window = 0.0;                         // s
  double averages = 0.0;                       // number of independent windows
};

/// H1 with the matrix of cross spectra of the inputs (Bendat & Piersol 2010, chapter 7). Throws InputError as
/// check_recordings(), if no base channel moves or there is no other channel, for two proportional inputs, and for
/// recordings that are too short for the number of inputs plus two windows.
TransferFunctions transfer_functions(const std::vector<Recording>& recordings, const TransferSettings& settings = {});

/// Whether the motion of the ground was recorded: a channel base_x, base_y or base_z that all recordings have, and that
/// moves. Throws InputError as check_recordings() does, without a channel in common and for recordings too short to
/// identify modes from.
bool has_base_motion(const std::vector<Recording>& recordings);

}  // namespace voussoir
