#include "solver/modal/damped_mode.h"

#include <cmath>
#include <complex>

#include "solver/base/constants.h"
#include "solver/step/damping.h"

namespace voussoir {

namespace {

using Complex = std::complex<double>;

DampedMode of_pole(Complex s) {
  if (std::abs(s.imag()) <= 1e-12 * std::abs(s)) return {0.0, 1.0};
  return {std::abs(s.imag()) / two_pi, -s.real() / std::abs(s)};
}

/// Newton on f(s) = s² + ω² (1 + Σ α_j s/(s + ω_j)) from the undamped pole.
DampedMode maxwell(const DampingSettings& damping, double omega) {
  const MaxwellFit fit = fit_maxwell(damping.ratio, damping.band, damping.branches);
  Complex s(0.0, omega);
  for (int i = 0; i < 50; ++i) {
    Complex factor = 1.0, slope = 0.0;
    for (std::size_t j = 0; j < fit.stiffness.size(); ++j) {
      const double rate = two_pi * fit.frequency[j];
      factor += fit.stiffness[j] * s / (s + rate);
      slope += fit.stiffness[j] * rate / ((s + rate) * (s + rate));
    }
    const Complex step = (s * s + omega * omega * factor) / (2.0 * s + omega * omega * slope);
    s -= step;
    if (std::abs(step) < 1e-14 * std::abs(s)) break;
  }
  return of_pole(s);
}

/// s² + (a + b ω²) s + ω² = 0.
DampedMode rayleigh(const DampingSettings& damping, double omega) {
  const auto [a, b] = rayleigh_terms(damping);
  const double rate = 0.5 * (a + b * omega * omega);
  return of_pole(-rate + std::sqrt(Complex(rate * rate - omega * omega)));
}

/// The restoring force is 1 + c times as large on the way out and 1 − c on the way back: quarter cycles of two
/// frequencies, and a ratio of velocities of √((1 − c)/(1 + c)) from one passage through zero to the next.
DampedMode local(double c, double omega) {
  if (c >= 1.0) return {0.0, 1.0};
  const double half_period = 0.5 * pi / omega * (1.0 / std::sqrt(1.0 + c) + 1.0 / std::sqrt(1.0 - c));
  const double decay = 0.5 * std::log((1.0 + c) / (1.0 - c));
  return {0.5 / half_period, decay / std::hypot(pi, decay)};
}

}  // namespace

DampedMode damped_mode(const DampingSettings& damping, double frequency) {
  if (frequency <= 0.0) return {};
  const bool by_ratio = damping.kind != DampingSettings::Kind::local;
  if (by_ratio && damping.ratio < least_damping_ratio) return {frequency, 0.0};
  const double omega = two_pi * frequency;
  switch (damping.kind) {
    case DampingSettings::Kind::maxwell:
      return maxwell(damping, omega);
    case DampingSettings::Kind::rayleigh:
      return rayleigh(damping, omega);
    case DampingSettings::Kind::local:
      return local(damping.coefficient, omega);
    default:
      return {frequency, 0.0};
  }
}

}  // namespace voussoir
