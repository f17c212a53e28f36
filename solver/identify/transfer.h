// Transfer functions from the ground's motion to the sensors (docs/theory/identification.md).
#pragma once
#include "solver/identify/recording.h"

namespace voussoir {

struct TransferSettings {
  double highest_frequency = 0.0;  // Hz; 0: 20, or 0.4 of the sampling frequency where that is less
  double window = 0.0;             // s; 0: about a tenth of the longest recording
};

struct TransferFunctions {
  std::vector<std::string> inputs;       // of base_x, base_y, base_z those that were recorded and move
  std::vector<std::string> outputs;      // all other channels
  Eigen::VectorXd frequencies;           // Hz, a line each, zero left out
  std::vector<Eigen::MatrixXcd> values;  // a line each: outputs × inputs, (m/s2)/(m/s2); NaN where inputs are one
  std::vector<Eigen::MatrixXd> magnitude_std;  // a line each: standard deviation of |H|, outputs × inputs
  Eigen::MatrixXd coherence;                   // lines × outputs, multiple, 0 to 1
  double window = 0.0;                         // s
  double averages = 0.0;                       // independent windows
};

/// H1 with the matrix of the inputs' cross spectra (Bendat & Piersol 2010, chapter 7). Throws InputError as
/// check_recordings() does, without a base channel that moves or without another channel, for two inputs that are the
/// same motion, and for recordings too short for as many windows as there are inputs and two more.
TransferFunctions transfer_functions(const std::vector<Recording>& recordings, const TransferSettings& settings = {});

/// Whether the ground's motion was recorded: a channel base_x, base_y or base_z that all recordings have, and that
/// moves. Throws InputError as check_recordings() does, without a channel in common and for recordings too short to
/// identify modes from.
bool has_base_motion(const std::vector<Recording>& recordings);

}  // namespace voussoir
