#include "solver/motion/synthesis.h"

#include <cmath>
#include <numbers>

#include "solver/base/error.h"
#include "solver/base/random.h"
#include "solver/motion/baseline.h"

namespace voussoir {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double highest_frequency = 25.0;  // Hz; above it neither records nor bridges have much to say

/// Σ √(S Δω) (A cos ωt + B sin ωt) at n samples; the cosines by turning a phasor, which costs two products a sample.
std::vector<double> stationary_noise(const SyntheticSettings& settings, std::size_t n, RandomStream& random) {
  std::vector<double> a(n, 0.0);
  const double step = 1.0 / (2.0 * settings.duration);  // Hz: the sum repeats only after twice the duration
  const double highest = std::min(highest_frequency, 0.5 / settings.dt);
  for (int k = 1; double(k) * step <= highest; ++k) {
    const double omega = two_pi * double(k) * step;
    const double size =
        std::sqrt(ground_spectrum(omega, two_pi * settings.frequency, settings.bandwidth) * two_pi * step);
    double c = size * random.normal(), s = size * random.normal();
    const double turn_c = std::cos(omega * settings.dt), turn_s = std::sin(omega * settings.dt);
    for (std::size_t i = 0; i < n; ++i) {
      a[i] += c;
      const double turned = c * turn_c + s * turn_s;
      s = s * turn_c - c * turn_s;
      c = turned;
    }
  }
  return a;
}

void check(const SyntheticSettings& s) {
  const auto positive = [](double value, const char* name, const char* unit) {
    if (!(value > 0.0) || !std::isfinite(value))
      throw InputError("synthetic motion: '{}' is {} {}: must be above 0", name, value, unit);
  };
  positive(s.peak, "peak", "m/s2");
  positive(s.duration, "duration", "s");
  positive(s.frequency, "frequency", "Hz");
  positive(s.bandwidth, "bandwidth", "(damping ratio)");
  positive(s.dt, "dt", "s");
  if (!s.axes[0] && !s.axes[1] && !s.axes[2]) throw InputError("synthetic motion: 'axes' is empty: name x, y or z");
  if (!(s.rise > 0.0 && s.rise <= s.strong && s.strong < 1.0))
    throw InputError("synthetic motion: 'rise' {} and 'strong' {} must satisfy 0 < rise <= strong < 1", s.rise,
                     s.strong);
  if (s.duration < 20.0 * s.dt)
    throw InputError("synthetic motion: 'duration' {} s holds fewer than 20 steps of 'dt' {} s", s.duration, s.dt);
  if (s.duration / s.dt > 1e6)
    throw InputError("synthetic motion: {} s at {} s are more than a million samples", s.duration, s.dt);
}

}  // namespace

double ground_spectrum(double omega, double ground_omega, double ground_damping) {
  constexpr double filter_damping = 0.6;
  const double r = omega / ground_omega, loss = 2.0 * ground_damping * r;
  const double layer = (1.0 + loss * loss) / ((1.0 - r * r) * (1.0 - r * r) + loss * loss);
  const double q = 10.0 * r, filter_loss = 2.0 * filter_damping * q;
  return layer * (q * q * q * q) / ((1.0 - q * q) * (1.0 - q * q) + filter_loss * filter_loss);
}

double jennings_envelope(double t, double rise, double strong, double duration) {
  if (t < 0.0 || t > duration) return 0.0;
  if (t < rise) return (t / rise) * (t / rise);
  if (t <= strong) return 1.0;
  return std::exp(std::log(0.05) * (t - strong) / (duration - strong));
}

GroundMotion synthesize(const SyntheticSettings& settings) {
  check(settings);
  const auto n = std::size_t(std::llround(settings.duration / settings.dt)) + 1;
  GroundMotion motion;
  motion.dt = settings.dt;
  motion.acceleration.assign(n, Vec3::Zero());
  RandomStream random(settings.seed);
  for (int axis = 0; axis < 3; ++axis) {
    if (!settings.axes[std::size_t(axis)]) continue;
    const std::vector<double> noise = stationary_noise(settings, n, random);
    for (std::size_t i = 0; i < n; ++i) {
      const double envelope = jennings_envelope(double(i) * settings.dt, settings.rise * settings.duration,
                                                settings.strong * settings.duration, settings.duration);
      motion.acceleration[i][axis] = envelope * noise[i];
    }
  }
  motion = correct_baseline(motion);
  for (int axis = 0; axis < 3; ++axis) {
    double largest = 0.0;
    for (const Vec3& a : motion.acceleration) largest = std::max(largest, std::abs(a[axis]));
    if (largest == 0.0) continue;
    for (Vec3& a : motion.acceleration) a[axis] *= settings.peak / largest;
  }
  return motion;
}

}  // namespace voussoir
