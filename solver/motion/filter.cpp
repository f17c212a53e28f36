#include "solver/motion/filter.h"

#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "solver/motion/baseline.h"

namespace voussoir {

namespace {

/// A length that the transform likes: 2^a 3^b 5^c.
std::size_t good_length(std::size_t least) {
  for (std::size_t n = least;; ++n) {
    std::size_t rest = n;
    for (const std::size_t factor : {2u, 3u, 5u})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1 && n % 2 == 0) return n;
  }
}

double gain(double f, double low, double high, int order) {
  double g = 1.0;
  if (low > 0.0) g *= f > 0.0 ? 1.0 / (1.0 + std::pow(low / f, 2 * order)) : 0.0;
  if (high > 0.0) g /= 1.0 + std::pow(f / high, 2 * order);
  return g;
}

}  // namespace

void taper(std::vector<double>& values, double share) {
  if (!(share >= 0.0 && share <= 0.5)) throw InputError("taper is {}. It must be a share from 0 to 0.5.", share);
  const auto n = std::size_t(share * double(values.size()));
  for (std::size_t i = 0; i < n; ++i) {
    const double weight = 0.5 * (1.0 - std::cos(pi * double(i) / double(n)));
    values[i] *= weight;
    values[values.size() - 1 - i] *= weight;
  }
}

std::vector<double> band_pass(const std::vector<double>& values, double dt, double f_low, double f_high, int order) {
  const double highest = 0.5 / dt;
  if (!(f_low >= 0.0 && f_high >= 0.0 && f_low < highest && f_high < highest))
    throw InputError(
        "band-pass from {} to {} Hz: the corner frequencies must be below {:.4g} Hz, half the sampling rate", f_low,
        f_high, highest);
  constexpr double lowest = 1e-3;  // Hz; the zeros at the ends are as long as 1.5 n / corner
  for (const double corner : {f_low, f_high})
    if (corner > 0.0 && corner < lowest)
      throw InputError(
          "band-pass from {} to {} Hz: each corner frequency must be 0 (no filter on this side) or at least {} Hz",
          f_low, f_high, lowest);
  if (f_low > 0.0 && f_high > 0.0 && f_low >= f_high)
    throw InputError("band-pass from {} to {} Hz: the lower corner frequency must come first", f_low, f_high);
  if (order < 1 || order > 16) throw InputError("the order of the band-pass is {}. It must be from 1 to 16.", order);
  const double pad = 1.5 * order / (f_low > 0.0 ? f_low : f_high > 0.0 ? f_high : highest);  // s
  const auto zeros = std::size_t(std::ceil(pad / dt));
  const std::size_t n = good_length(values.size() + 2 * zeros);
  std::vector<double> padded(n, 0.0);
  std::ranges::copy(values, padded.begin() + std::ptrdiff_t(zeros));
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  transform.fwd(spectrum, padded);
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    spectrum[k] *= gain(double(k) / (double(n) * dt), f_low, f_high, order);
  transform.inv(padded, spectrum, Eigen::Index(n));
  return {padded.begin() + std::ptrdiff_t(zeros), padded.begin() + std::ptrdiff_t(zeros + values.size())};
}

std::vector<double> resample(const std::vector<double>& values, double dt, double new_dt) {
  constexpr double shortest = 1e-5, longest = 1.0, most = 1e7;  // s, s, samples
  if (!(new_dt >= shortest && new_dt <= longest))
    throw InputError("resampling to a time step of {} s: the time step must be from {} to {} s", new_dt, shortest,
                     longest);
  if (const double samples = dt / new_dt * double(values.size()); samples > most)
    throw InputError("resampling {} s to a time step of {} s gives {:.3g} samples. At most {:g} are allowed.",
                     dt * double(values.size()), new_dt, samples, most);
  if (values.size() < 2 || new_dt == dt) return values;
  const std::vector<double> from =
      new_dt > dt ? band_pass(values, dt, 0.0, std::min(0.4 / new_dt, 0.499 / dt)) : values;
  const double length = dt * double(values.size() - 1);
  std::vector<double> to;
  for (std::size_t i = 0; double(i) * new_dt <= length * (1.0 + 1e-12); ++i) {
    const double at = std::min(double(i) * new_dt / dt, double(values.size() - 1));
    const auto k = std::min(std::size_t(at), values.size() - 2);
    const double share = at - double(k);
    to.push_back((1.0 - share) * from[k] + share * from[k + 1]);
  }
  return to;
}

std::vector<double> component(const GroundMotion& motion, int axis) {
  std::vector<double> values;
  values.reserve(motion.acceleration.size());
  for (const Vec3& a : motion.acceleration) values.push_back(a[axis]);
  return values;
}

GroundMotion process(const GroundMotion& motion, const MotionProcessing& asked) {
  GroundMotion result = motion;
  const auto each = [&](const auto& change) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double> values = change(component(result, axis));
      result.acceleration.resize(values.size(), Vec3::Zero());
      for (std::size_t i = 0; i < values.size(); ++i) result.acceleration[i][axis] = values[i];
    }
  };
  if (asked.taper > 0.0)
    each([&](std::vector<double> values) {
      taper(values, asked.taper);
      return values;
    });
  if (asked.low > 0.0 || asked.high > 0.0)
    each([&](const std::vector<double>& values) {
      return band_pass(values, result.dt, asked.low, asked.high, asked.order);
    });
  if (asked.baseline) result = correct_baseline(result);
  if (asked.dt > 0.0 && asked.dt != result.dt) {
    GroundMotion resampled;
    resampled.dt = asked.dt;
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double> values = resample(component(result, axis), result.dt, asked.dt);
      resampled.acceleration.resize(values.size(), Vec3::Zero());
      for (std::size_t i = 0; i < values.size(); ++i) resampled.acceleration[i][axis] = values[i];
    }
    result = resampled;
  }
  return result;
}

}  // namespace voussoir
