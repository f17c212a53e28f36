// Structures of known modes and what instruments on them record.
#pragma once
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "solver/identify/recording.h"
#include "tests/solver/signals.h"

namespace voussoir {

struct ModalModel {
  std::vector<double> frequency, damping;  // Hz, ratio
  Eigen::MatrixXd shapes;                  // channels × modes
};

/// White forces at all channels, `strength` times as large where it is given (of the time in s), accelerations there,
/// and noise of a share of their root mean square.
inline Recording simulated(const ModalModel& model, double duration, double dt, std::uint64_t seed, double noise,
                           const std::function<double(double)>& strength = {}) {
  const auto n = Eigen::Index(std::llround(duration / dt)), channels = model.shapes.rows();
  Normal normal(seed);
  std::vector<Oscillator> modes;
  for (std::size_t m = 0; m < model.frequency.size(); ++m) modes.emplace_back(model.frequency[m], model.damping[m], dt);
  Recording r = {.name = "simulated", .dt = dt, .channels = {}, .values = Eigen::MatrixXd(n, channels)};
  for (Eigen::Index c = 0; c < channels; ++c) r.channels.push_back(fmt::format("s{}", c));
  Eigen::VectorXd force(channels), acceleration(Eigen::Index(modes.size()));
  for (Eigen::Index i = 0; i < n; ++i) {
    for (double& f : force) f = normal();
    if (strength) force *= strength(dt * double(i));
    const Eigen::VectorXd modal = model.shapes.transpose() * force;
    for (Eigen::Index m = 0; m < modal.size(); ++m) acceleration[m] = modes[std::size_t(m)].step(modal[m]);
    r.values.row(i) = model.shapes * acceleration;
  }
  const double size = noise * std::sqrt(r.values.squaredNorm() / double(r.values.size()));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index c = 0; c < channels; ++c) r.values(i, c) += size * normal();
  return r;
}

/// Shapes of a simply supported beam.
inline Eigen::MatrixXd sines(Eigen::Index channels, Eigen::Index modes) {
  Eigen::MatrixXd shapes(channels, modes);
  for (Eigen::Index c = 0; c < channels; ++c)
    for (Eigen::Index m = 0; m < modes; ++m)
      shapes(c, m) = std::sin(std::numbers::pi * double(m + 1) * double(c + 1) / double(channels + 1));
  return shapes;
}

}  // namespace voussoir
