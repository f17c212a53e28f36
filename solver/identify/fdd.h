// Frequency-domain decomposition (Brincker, Zhang & Andersen 2001): an independent check of the modes, and a chart of
// them.
#pragma once
#include "solver/identify/prepare.h"

namespace voussoir {

struct FddSettings {
  double highest_frequency = 0.0;  // Hz; 0: as in identify_modes()
  double window = 0.0;             // s; 0: about a twentieth of the longest recording
  int singular_values = 3;         // number of values stored for each line
};

struct Fdd {
  std::vector<std::string> channels;      // channels of all recordings
  std::vector<PoorChannel> poor;          // left out
  Eigen::VectorXd frequencies;            // Hz, one for each line
  Eigen::MatrixXd singular;               // lines × singular values of the matrix of spectra, descending, (m/s2)²/Hz
  std::vector<Eigen::MatrixXcd> vectors;  // for each line: channels × singular values; NaN for channels that were left
                                          // out
  double window = 0.0;                    // s
  double averages = 0.0;                  // number of independent windows
};

/// Throws InputError as prepare(), and for a window that is longer than all recordings or shorter than 8 samples.
Fdd decompose_spectra(const std::vector<Recording>& recordings, const FddSettings& settings = {});

struct FddPeak {
  bool found = false;      // a local maximum within reach
  double frequency = 0.0;  // Hz, by a parabola through three lines
  double height = 0.0;     // (m/s2)²/Hz
  double assurance = 0.0;  // MAC of `shape` with the given shape; 0 without one
  Eigen::VectorXcd shape;  // for each channel, largest component 1; NaN for channels that were left out
};

/// The highest peak of the first singular value within `reach` (a share) of a frequency (Hz), two lines at least.
FddPeak peak_near(const Fdd& fdd, double frequency, double reach = 0.05);

/// The same for the motion along a given shape (for each channel, NaN: not measured), which separates close modes. The
/// shape of the peak is the most similar singular vector at this line.
FddPeak peak_near(const Fdd& fdd, double frequency, const Eigen::VectorXcd& shape, double reach = 0.05);

}  // namespace voussoir
