// Whether a signal about a frequency is a machine's or a structure's.
#pragma once
#include <Eigen/Dense>
#include <vector>

namespace voussoir {

struct Narrowband {
  double kurtosis = 3.0;     // 3 of narrow-band Gaussian noise, 1.5 of a harmonic
  double independent = 0.0;  // envelopes that it was found from
};

/// Kurtosis of the signals (samples × channels, a matrix a recording) filtered about `frequency` (Hz), projected on the
/// shape `along` (per channel). `damping` tells how long a mode of that frequency remembers.
Narrowband narrowband_kurtosis(const std::vector<Eigen::MatrixXd>& signals, double dt, double frequency, double damping,
                               const Eigen::VectorXcd& along);

/// Jacobsen, Andersen & Brincker (2007): a kurtosis near 1.5. Where too few envelopes were seen to tell, only a damping
/// next to nothing.
bool is_harmonic(const Narrowband& band, double damping);

/// How the motion at a frequency ends.
struct Stops {
  int count = 0;       // times at which it stopped faster than its damping lets a structure ring down
  double share = 0.0;  // of the energy it lost, that it lost then
};

/// A structure that is left alone rings down by its damping; a machine that is switched off is still at once. The
/// envelope of the signals, filtered and projected as above, is compared with what the damping leaves of it a few
/// windows later.
Stops fast_stops(const std::vector<Eigen::MatrixXd>& signals, double dt, double frequency, double damping,
                 const Eigen::VectorXcd& along);

/// A machine that runs now and then: most of what goes, goes in such stops.
bool is_intermittent(const Stops& stops);

}  // namespace voussoir
