// Signals of known structures, for tests of identification.
#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "solver/base/random.h"

namespace voussoir {

/// Standard normal numbers, the second of each pair left out.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : random_(seed * 0x2545f4914f6cdd1dULL) {}
  double operator()() {
    const double radius = std::sqrt(-2.0 * std::log(random_.uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * random_.uniform());
  }

 private:
  RandomStream random_;
};

/// x⁺ = A x + b u of one mode under a force held over the step: exact (matrix exponential in closed form).
struct Oscillator {
  double omega, damping;
  Eigen::Matrix2d a;
  Eigen::Vector2d b, x = Eigen::Vector2d::Zero();
  Oscillator(double frequency, double ratio, double dt) : omega(2.0 * std::numbers::pi * frequency), damping(ratio) {
    const double damped = omega * std::sqrt(1.0 - ratio * ratio), decay = std::exp(-ratio * omega * dt);
    const double c = std::cos(damped * dt), s = std::sin(damped * dt) / damped;
    a << c + ratio * omega * s, s, -omega * omega * s, c - ratio * omega * s;
    a *= decay;
    b = {(1.0 - a(0, 0)) / (omega * omega), a(0, 1)};
  }
  double acceleration(double force) const { return force - 2.0 * damping * omega * x[1] - omega * omega * x[0]; }
  void advance(double force) { x = a * x + b * force; }
  /// Acceleration now; then a step on.
  double step(double force) {
    const double now = acceleration(force);
    advance(force);
    return now;
  }
};

}  // namespace voussoir
