// Decides whether the signal at a frequency comes from a machine or from the structure.
#pragma once
#include <Eigen/Dense>
#include <vector>

namespace voussoir {

struct Narrowband {
  double kurtosis = 3.0;     // 3 for narrow-band Gaussian noise, 1.5 for a harmonic
  double independent = 0.0;  // number of independent envelopes
};

/// Kurtosis of the signals (samples × channels, one matrix for each recording), filtered about `frequency` (Hz) and
/// projected on the shape `along` (for each channel). `damping` gives the correlation time of a mode at this frequency.
Narrowband narrowband_kurtosis(const std::vector<Eigen::MatrixXd>& signals, double dt, double frequency, double damping,
                               const Eigen::VectorXcd& along);

/// Whether the signal comes from a machine: its kurtosis is near 1.5 (Jacobsen, Andersen & Brincker 2007). With too few
/// envelopes for a decision, only a damping ratio near zero counts.
bool is_harmonic(const Narrowband& band, double damping);

/// Ends of the motion at a frequency.
struct Stops {
  int count = 0;       // number of times at which it stopped faster than free vibration with its damping ratio decays
  double share = 0.0;  // share of the lost energy that was lost in these stops
};

/// The free vibration of a structure decays with its damping ratio; a machine that is switched off stops immediately.
/// The envelope of the signals, filtered and projected as above, is compared with the decay by the damping ratio a few
/// windows later.
Stops fast_stops(const std::vector<Eigen::MatrixXd>& signals, double dt, double frequency, double damping,
                 const Eigen::VectorXcd& along);

/// Whether it is an intermittent machine: most of the energy is lost in such stops.
bool is_intermittent(const Stops& stops);

}  // namespace voussoir
