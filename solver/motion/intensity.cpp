#include "solver/motion/intensity.h"

#include <algorithm>
#include <cmath>

#include "solver/base/constants.h"
#include "solver/motion/baseline.h"

namespace voussoir {

namespace {

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

/// ∫ f dt up to each sample.
template <class Function>
std::vector<double> integral_of(const std::vector<double>& values, double dt, const Function& f) {
  std::vector<double> sums(values.size(), 0.0);
  for (std::size_t i = 1; i < values.size(); ++i) sums[i] = sums[i - 1] + 0.5 * dt * (f(values[i - 1]) + f(values[i]));
  return sums;
}

/// When a sum that only rises gets to a level.
double time_of(const std::vector<double>& sums, double dt, double level) {
  const auto at = std::lower_bound(sums.begin(), sums.end(), level);
  if (at == sums.begin() || at == sums.end()) return 0.0;
  const double before = *(at - 1), share = (level - before) / (*at - before);
  return dt * (double(at - sums.begin()) - 1.0 + share);
}

/// u'' + 2 ζ ω u' + ω² u = −a with a linear over each step h, in closed form.
struct Oscillator {
  double omega, damping, damped, h;
  double decay, cosine, sine;  // over a step
  double u = 0.0, v = 0.0;

  Oscillator(double period, double ratio, double step)
      : omega(2.0 * pi / period),
        damping(ratio),
        damped(omega * std::sqrt(1.0 - ratio * ratio)),
        h(step),
        decay(std::exp(-ratio * omega * step)),
        cosine(std::cos(damped * step)),
        sine(std::sin(damped * step)) {}

  void advance(double a0, double a1) {
    const double slope = (a1 - a0) / h, w2 = omega * omega;
    // Particular solution c + d t, and what is left of it: e^(−ζωt) (A cos + B sin).
    const double d = -slope / w2, c = -a0 / w2 + 2.0 * damping * slope / (w2 * omega);
    const double a = u - c, b = (v - d + damping * omega * a) / damped;
    u = c + d * h + decay * (a * cosine + b * sine);
    v = d + decay * ((b * damped - a * damping * omega) * cosine - (a * damped + b * damping * omega) * sine);
  }
};

double largest_displacement(const std::vector<double>& acceleration, double dt, double period, double damping) {
  constexpr double points = 40.0;  // a period, at least
  const auto parts = std::max(1, int(std::ceil(points * dt / period)));
  Oscillator oscillator(period, damping, dt / parts);
  double most = 0.0;
  const auto step = [&](double a0, double a1) {
    oscillator.advance(a0, a1);
    most = std::max(most, std::abs(oscillator.u));
  };
  for (std::size_t i = 1; i < acceleration.size(); ++i)
    for (int k = 0; k < parts; ++k) {
      const double rise = (acceleration[i] - acceleration[i - 1]) / parts;
      step(acceleration[i - 1] + k * rise, acceleration[i - 1] + (k + 1) * rise);
    }
  for (double t = 0.0; t < period; t += dt / parts) step(0.0, 0.0);
  return most;
}

}  // namespace

Intensity intensity_of(const std::vector<double>& acceleration, double dt) {
  Intensity found;
  found.pga = largest(acceleration);
  if (!(found.pga > 0.0) || acceleration.size() < 2) return found;
  found.pgv = largest(integrate(acceleration, dt));
  const std::vector<double> squares = integral_of(acceleration, dt, [](double a) { return a * a; });
  found.arias = pi / (2.0 * standard_gravity) * squares.back();
  found.cav = integral_of(acceleration, dt, [](double a) { return std::abs(a); }).back();
  found.t5 = time_of(squares, dt, 0.05 * squares.back());
  found.t95 = time_of(squares, dt, 0.95 * squares.back());
  return found;
}

std::vector<double> response_spectrum(const std::vector<double>& acceleration, double dt,
                                      const std::vector<double>& periods, double damping) {
  std::vector<double> spectrum;
  for (const double period : periods) {
    const double omega = 2.0 * pi / period;
    spectrum.push_back(omega * omega * largest_displacement(acceleration, dt, period, damping));
  }
  return spectrum;
}

}  // namespace voussoir
