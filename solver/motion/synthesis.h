// Synthetic accelerograms: stationary Gaussian noise with the spectrum of a soil layer, under an envelope in time.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "solver/model/settings.h"
#include "solver/motion/target.h"

namespace voussoir {

struct SyntheticSettings {
  std::uint64_t seed = 1;
  double peak = 0.0;                                // m/s2, largest absolute value of each shaken axis
  double duration = 0.0;                            // s
  std::array<bool, 3> axes = {true, false, false};  // x, y, z: independent noise in each
  double frequency = 2.5;                           // Hz, of the ground filter (firm soil)
  double bandwidth = 0.6;                           // damping ratio of the ground filter
  double rise = 0.15;                               // share of the duration at which the strong phase begins
  double strong = 0.55;                             // share of the duration at which the decay begins
  double dt = 0.005;                                // s
  /// Instead of `peak`: each axis has this response spectrum, and z the vertical one. The filter then only gives the
  /// start values.
  std::optional<TargetSpectrum> spectrum = std::nullopt;
  bool operator==(const SyntheticSettings&) const = default;
};

/// Power spectral density of ground acceleration at circular frequency omega (rad/s), for unit white noise at the
/// bedrock: the Kanai-Tajimi layer filter (Kanai 1957; Tajimi 1960) times the high-pass filter of Clough & Penzien
/// (1975), whose frequency is a tenth of the ground's with damping 0.6, so that displacements stay bounded.
double ground_spectrum(double omega, double ground_omega, double ground_damping);

/// Envelope of Jennings, Housner & Tsai (1968): parabolic rise, level strong phase, exponential decay to 0.05 at the
/// end. `rise` and `strong` are times in s.
double jennings_envelope(double t, double rise, double strong, double duration);

/// Throws InputError when peak (without a spectrum), duration, frequency, bandwidth or dt is not positive, no axis is
/// chosen, 0 < rise <= strong < 1 does not hold, dt is above 0.1 s, or the samples are fewer than 20 or more than a
/// million; with a spectrum also as check_target(). These are all possible errors of a synthetic motion; the motion is
/// not made.
void check_synthetic(const SyntheticSettings& settings);

/// Sum of cosines with Gaussian coefficients, enveloped, baseline-corrected (zero velocity at the end) and scaled to
/// the peak. The program has its own random number generator, so a seed gives the same motion on every machine, up to
/// the last digits of the mathematical functions (solver/base/random.h). With a spectrum, the amplitudes of the Fourier
/// components are repeatedly multiplied by target over response at their periods, with constant phases (Gasparini &
/// Vanmarcke 1976): from 0.04 s to 4 s, or to a third of the duration. Costs n log n. Throws InputError as
/// check_synthetic() does.
GroundMotion synthesize(const SyntheticSettings& settings);

}  // namespace voussoir
