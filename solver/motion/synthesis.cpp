#include "solver/motion/synthesis.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "solver/base/random.h"
#include "solver/motion/baseline.h"
#include "solver/motion/filter.h"
#include "solver/motion/intensity.h"

namespace voussoir {

namespace {
constexpr double highest_frequency = 25.0;  // Hz; above it neither records nor bridges have much to say

using Complex = std::complex<double>;

/// e^(i θ k²/2), by the part of the angle beyond full turns: k² may be large.
Complex chirp(std::size_t k, double theta) {
  const double turns = double(k) * double(k) * theta / (2.0 * two_pi);
  return std::polar(1.0, two_pi * (turns - std::floor(turns)));
}

/// Re Σ z_k e^(i θ k j) at j = 0 … n − 1, for any θ: 2 k j = k² + j² − (j − k)² makes it a convolution (Bluestein
/// 1970), which three transforms of a power of two give.
std::vector<double> sum_of_waves(const std::vector<Complex>& z, double theta, std::size_t n) {
  std::size_t length = 2;
  while (length < n + z.size()) length *= 2;
  std::vector<Complex> waves(length), kernel(length), spectrum, kernel_spectrum;
  for (std::size_t k = 0; k < z.size(); ++k) waves[k] = z[k] * chirp(k, theta);
  for (std::size_t j = 0; j < std::max(n, z.size()); ++j) {
    const Complex c = std::conj(chirp(j, theta));
    if (j < n) kernel[j] = c;
    if (j > 0 && j < z.size()) kernel[length - j] = c;
  }
  Eigen::FFT<double> transform;
  transform.fwd(spectrum, waves);
  transform.fwd(kernel_spectrum, kernel);
  for (std::size_t k = 0; k < length; ++k) spectrum[k] *= kernel_spectrum[k];
  transform.inv(waves, spectrum);
  std::vector<double> sum(n);
  for (std::size_t j = 0; j < n; ++j) sum[j] = (waves[j] * chirp(j, theta)).real();
  return sum;
}

/// Σ √(S Δω) (A cos ωt + B sin ωt) at n samples.
std::vector<double> stationary_noise(const SyntheticSettings& settings, std::size_t n, RandomStream& random) {
  const double step = 1.0 / (2.0 * settings.duration);  // Hz: the sum repeats only after twice the duration
  const double highest = std::min(highest_frequency, 0.5 / settings.dt);
  std::vector<Complex> z(1);  // the mean is none
  for (int k = 1; double(k) * step <= highest; ++k) {
    const double omega = two_pi * double(k) * step;
    const double size =
        std::sqrt(ground_spectrum(omega, two_pi * settings.frequency, settings.bandwidth) * two_pi * step);
    const double c = size * random.normal(), s = size * random.normal();
    z.emplace_back(c, -s);
  }
  return sum_of_waves(z, two_pi * step * settings.dt, n);
}

constexpr double shortest_matched = 0.04, longest_matched = 4.0;  // s
constexpr int matching_rounds = 30;

/// Periods at which spectra are compared: forty a decade.
std::vector<double> matching_periods(const SyntheticSettings& settings) {
  const double longest = std::min(longest_matched, settings.duration / 3.0);
  std::vector<double> periods;
  for (int k = 0;; ++k) {
    periods.push_back(shortest_matched * std::pow(10.0, double(k) / 40.0));
    if (periods.back() > longest) return periods;
  }
}

/// Target over response at a frequency, linear in the logarithm of the period; beyond the ends as there.
double correction_at(double frequency, const std::vector<double>& periods, const std::vector<double>& factors) {
  if (!(frequency > 0.0)) return 1.0;
  const double period = 1.0 / frequency;
  if (period <= periods.front()) return factors.front();
  if (period >= periods.back()) return factors.back();
  const auto above = std::upper_bound(periods.begin(), periods.end(), period);
  const auto i = std::size_t(above - periods.begin());
  const double share = std::log(period / periods[i - 1]) / std::log(periods[i] / periods[i - 1]);
  return std::pow(factors[i - 1], 1.0 - share) * std::pow(factors[i], share);
}

/// One component with the same phases, and amplitudes multiplied by a factor over the period.
std::vector<double> with_amplitudes(const std::vector<double>& values, double dt, const std::vector<double>& periods,
                                    const std::vector<double>& factors) {
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::size_t n = 2;
  while (n < 2 * values.size()) n *= 2;
  std::vector<double> padded(n, 0.0);
  std::ranges::copy(values, padded.begin());
  std::vector<std::complex<double>> spectrum;
  transform.fwd(spectrum, padded);
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    spectrum[k] *= correction_at(double(k) / (double(n) * dt), periods, factors);
  transform.inv(padded, spectrum, Eigen::Index(n));
  padded.resize(values.size());
  return padded;
}

/// Largest of |ln(response/target)|: how far a component is off its target.
double misfit(const std::vector<double>& response, const std::vector<double>& target) {
  double most = 0.0;
  for (std::size_t k = 0; k < target.size(); ++k) most = std::max(most, std::abs(std::log(response[k] / target[k])));
  return most;
}

/// The best of the rounds, since the last need not be: neighbouring periods pull against each other.
GroundMotion matched(const GroundMotion& noise, const SyntheticSettings& settings) {
  const std::vector<double> periods = matching_periods(settings);
  GroundMotion result = noise;
  for (int axis = 0; axis < 3; ++axis) {
    if (!settings.axes[std::size_t(axis)]) continue;
    std::vector<double> target;
    for (const double period : periods)
      target.push_back(standard_gravity * (axis == 2 ? vertical_spectral_acceleration(*settings.spectrum, period)
                                                     : spectral_acceleration(*settings.spectrum, period)));
    GroundMotion now{noise.dt, {}};
    for (const Vec3& a : noise.acceleration) now.acceleration.emplace_back(a[axis], 0.0, 0.0);
    double best = INFINITY;
    for (int round = 0; round < matching_rounds; ++round) {
      now = correct_baseline(now);
      std::vector<double> values = component(now, 0);
      const std::vector<double> response = response_spectrum(values, now.dt, periods, settings.spectrum->damping);
      if (const double off = misfit(response, target); off < best) {
        best = off;
        for (std::size_t i = 0; i < values.size(); ++i) result.acceleration[i][axis] = values[i];
      }
      std::vector<double> factors;
      for (std::size_t k = 0; k < periods.size(); ++k) factors.push_back(target[k] / response[k]);
      values = with_amplitudes(values, now.dt, periods, factors);
      for (std::size_t i = 0; i < values.size(); ++i) now.acceleration[i].x() = values[i];
    }
  }
  return result;
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

void check_synthetic(const SyntheticSettings& s) {
  const auto positive = [](double value, const char* name, const char* unit) {
    if (!(value > 0.0) || !std::isfinite(value))
      throw InputError("synthetic motion: '{}' is {} {}. It must be above 0.", name, value, unit);
  };
  if (s.spectrum) {
    check_target(*s.spectrum);
  } else {
    positive(s.peak, "peak", "m/s2");
  }
  positive(s.duration, "duration", "s");
  positive(s.frequency, "frequency", "Hz");
  positive(s.bandwidth, "bandwidth", "(damping ratio)");
  positive(s.dt, "dt", "s");
  if (!s.axes[0] && !s.axes[1] && !s.axes[2]) throw InputError("synthetic motion: 'axes' is empty. Name x, y or z.");
  if (!(s.rise > 0.0 && s.rise <= s.strong && s.strong < 1.0))
    throw InputError("synthetic motion: 'rise' is {} and 'strong' is {}. They must satisfy 0 < rise <= strong < 1.",
                     s.rise, s.strong);
  if (s.dt > 0.1) throw InputError("synthetic motion: 'dt' is {} s. It must be at most 0.1 s.", s.dt);
  if (s.duration < 20.0 * s.dt)
    throw InputError(
        "synthetic motion: 'duration' is {} s, which is fewer than 20 time steps of 'dt', {} s. Give a longer "
        "'duration' or a smaller 'dt'.",
        s.duration, s.dt);
  if (s.duration / s.dt > 1e6)
    throw InputError(
        "synthetic motion: 'duration' {} s divided by 'dt' {} s gives more than a million samples. Give a shorter "
        "'duration' or a larger 'dt'.",
        s.duration, s.dt);
}

GroundMotion synthesize(const SyntheticSettings& settings) {
  check_synthetic(settings);
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
  if (settings.spectrum) return matched(motion, settings);
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
