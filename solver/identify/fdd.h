// Frequency-domain decomposition (Brincker, Zhang & Andersen 2001): a second look at modes, and a picture of them.
#pragma once
#include "solver/identify/prepare.h"

namespace voussoir {

struct FddSettings {
  double highest_frequency = 0.0;  // Hz; 0: as of identify_modes()
  double window = 0.0;             // s; 0: about a twentieth of the longest recording
  int singular_values = 3;         // kept per line
};

struct Fdd {
  std::vector<std::string> channels;      // those that all recordings have
  std::vector<PoorChannel> poor;          // left out
  Eigen::VectorXd frequencies;            // Hz, a line each
  Eigen::MatrixXd singular;               // lines × kept, descending: of the matrix of spectra, (m/s2)²/Hz
  std::vector<Eigen::MatrixXcd> vectors;  // a line each: channels × kept; NaN where a channel was left out
  double window = 0.0;                    // s
  double averages = 0.0;                  // independent windows
};

/// Throws InputError as prepare() does, and for a window longer than all recordings or shorter than 8 samples.
Fdd decompose_spectra(const std::vector<Recording>& recordings, const FddSettings& settings = {});

struct FddPeak {
  bool found = false;      // a local maximum within reach
  double frequency = 0.0;  // Hz, by a parabola through three lines
  double height = 0.0;     // (m/s2)²/Hz
  double assurance = 0.0;  // MAC of `shape` with the one that was asked for; 0 when none was
  Eigen::VectorXcd shape;  // per channel, largest component 1; NaN where a channel was left out
};

/// The highest peak of the first singular value within `reach` (a share) of a frequency (Hz), two lines at least.
FddPeak peak_near(const Fdd& fdd, double frequency, double reach = 0.05);

/// The same of what moves along a shape (per channel, NaN: not measured): it tells close modes apart. The shape of the
/// peak is the singular vector there that is most like the one given.
FddPeak peak_near(const Fdd& fdd, double frequency, const Eigen::VectorXcd& shape, double reach = 0.05);

}  // namespace voussoir
