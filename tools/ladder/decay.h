// Free decay: frequency and damping ratio of a decaying oscillation.
#pragma once
#include <vector>

#include "tools/ladder/models.h"

namespace voussoir::ladder {

struct Decay {
  double frequency = 0.0, ratio = 0.0;  // Hz, -
};

/// From the positive peaks of a decaying oscillation sampled every `dt` s: the mean spacing, and the logarithmic
/// decrement over all of them (Clough & Penzien 1993, section 2-6). At least two peaks are needed.
inline Decay measure_decay(const std::vector<double>& u, double dt) {
  std::vector<double> times, peaks;
  for (std::size_t i = 1; i + 1 < u.size(); ++i) {
    if (!(u[i] > 0.0 && u[i] >= u[i - 1] && u[i] > u[i + 1])) continue;
    const double curvature = u[i - 1] - 2 * u[i] + u[i + 1], shift = 0.5 * (u[i - 1] - u[i + 1]) / curvature;
    times.push_back((double(i) + shift) * dt);
    peaks.push_back(u[i] - 0.25 * (u[i - 1] - u[i + 1]) * shift);
  }
  const auto n = double(peaks.size() - 1);
  const double decrement = std::log(peaks.front() / peaks.back()) / n;
  return {n / (times.back() - times.front()), decrement / std::sqrt(4 * pi * pi + decrement * decrement)};
}

/// A block of 1 m on a joint, axially at `frequency` Hz, released 0.1 mm above its position, with time steps of `dt`
/// s. The first cycle, in which slow branches settle, is left out.
inline Decay ring(const DampingSettings& damping, double frequency, double dt, bool shortcut) {
  const double kn = 2000.0 * std::pow(2 * pi * frequency, 2);
  Assembly assembly = stone(2000.0);
  add_box(assembly, {0, 0, -1}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  SolverSettings settings = undamped();
  settings.damping = damping;
  settings.step.intact_shortcut = shortcut;
  Bench bench(joined(std::move(assembly), kn, 0.4 * kn, elastic_law()), settings);
  bench.begin(dt);
  bench.stepper.search_distance = 1e300;
  bench.place(1, {0, 0, 1e-4}, Eigen::Quaterniond::Identity());
  std::vector<double> u;
  bench.run(std::int64_t(1.0 / (frequency * dt)));
  bench.run(std::int64_t(12.0 / (frequency * dt)), 1, [&](const BodyPass&) { u.push_back(bench.displacement(1).z()); });
  return measure_decay(u, dt);
}

}  // namespace voussoir::ladder
