// Signals of known structures, for tests of identification.
#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace voussoir {

/// Standard normal numbers (splitmix64, Box & Muller): the same on every machine.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : state_(seed * 0x2545f4914f6cdd1dULL) {}
  double operator()() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  double uniform() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
    return (double(z >> 11) + 1.0) * 0x1.0p-53;
  }
  std::uint64_t state_;
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
