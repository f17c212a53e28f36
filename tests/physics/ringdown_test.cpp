// Free decay of a block on a joint: frequency and damping ratio as the theory of the damping model says.
#include <complex>

#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace {

struct Decay {
  double frequency = 0.0, ratio = 0.0;
};

/// From the positive peaks of a decaying oscillation: mean spacing, and the logarithmic decrement over all of them
/// (Clough & Penzien 1993, section 2-6).
Decay measure(const std::vector<double>& u, double dt) {
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

/// A block of 1 m on a joint, axially at `frequency` Hz, let go 0.1 mm above its place.
Decay ring(const DampingSettings& damping, double frequency, double dt, bool shortcut) {
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
  const auto skipped = std::int64_t(1.0 / (frequency * dt));  // the first cycle, in which slow branches settle
  bench.run(skipped);
  bench.run(std::int64_t(12.0 / (frequency * dt)), 1, [&](const BodyPass&) { u.push_back(bench.displacement(1).z()); });
  return measure(u, dt);
}

/// Root of s²/ω0² + 1 + Σ α s/(s + ω_j) = 0 near iω0, by Newton: ring-down of the exact Maxwell oscillator.
Decay exact_maxwell(double frequency) {
  const MaxwellFit fit = fit_maxwell(0.02, {0.5, 12.0}, 3);
  const double w0 = 2 * pi * frequency;
  const auto f = [&](std::complex<double> s) {
    std::complex<double> sum = s * s / (w0 * w0) + 1.0;
    for (int j = 0; j < 3; ++j) sum += fit.stiffness[std::size_t(j)] * s / (s + 2 * pi * fit.frequency[std::size_t(j)]);
    return sum;
  };
  std::complex<double> s(0.0, w0);
  for (int i = 0; i < 50; ++i) s -= f(s) * 1e-4 / (f(s + 1e-4) - f(s));
  return {s.imag() / (2 * pi), -s.real() / std::abs(s)};
}

void say(double frequency, bool shortcut, const Decay& expected, const Decay& got) {
  char what[80];
  std::snprintf(what, sizeof what, "Maxwell, three branches, %g Hz, %s: ", frequency,
                shortcut ? "shortcut" : "point by point");
  measured(std::string(what) + "frequency", expected.frequency, got.frequency, "Hz");
  measured(std::string(what) + "ratio", expected.ratio, got.ratio, "-");
}

/// Validation ladder A: undamped 3.125 Hz rings at 1.0446 × with 2.028 %.
TEST(RingDown, OfMaxwellDamping) {
  for (bool shortcut : {true, false}) {
    const Decay got = ring(DampingSettings{}, 3.125, 1e-3, shortcut), exact = exact_maxwell(3.125);
    EXPECT_NEAR(got.frequency, 1.0446 * 3.125, 0.003 * 3.125);
    EXPECT_NEAR(got.ratio, 0.02028, 0.03 * 0.02028);
    EXPECT_NEAR(got.frequency, exact.frequency, 1e-3 * exact.frequency);
    EXPECT_NEAR(got.ratio, exact.ratio, 0.01 * exact.ratio);
    say(3.125, shortcut, {1.0446 * 3.125, 0.02028}, got);
  }
}

TEST(RingDown, OfMaxwellDampingAcrossTheBand) {
  for (double frequency : {0.7, 1.5, 6.0, 10.0}) {
    const Decay got = ring(DampingSettings{}, frequency, 0.002 / frequency, true), exact = exact_maxwell(frequency);
    EXPECT_NEAR(got.frequency, exact.frequency, 1e-3 * exact.frequency) << frequency;
    EXPECT_NEAR(got.ratio, exact.ratio, 0.02 * exact.ratio) << frequency;
    say(frequency, true, exact, got);
  }
}

/// ξ = mass/(2ω) + stiffness ω/2 (Clough & Penzien 1993, eq. 12-38), exact at both ends of the band.
TEST(RingDown, OfRayleighDamping) {
  DampingSettings rayleigh;
  rayleigh.kind = DampingSettings::Kind::rayleigh;
  const double w1 = 2 * pi * 0.5, w2 = 2 * pi * 12.0;
  for (double frequency : {0.5, 3.125, 12.0}) {
    const double w = 2 * pi * frequency, ratio = 0.02 / (w1 + w2) * (w1 * w2 / w + w);
    for (bool shortcut : {true, false}) {
      const Decay got = ring(rayleigh, frequency, 0.002 / frequency, shortcut);
      EXPECT_NEAR(got.ratio, ratio, 0.01 * ratio) << frequency;
      EXPECT_NEAR(got.frequency, frequency, 1e-3 * frequency) << frequency;
    }
  }
}

TEST(RingDown, WithoutDampingDoesNotDecay) {
  DampingSettings none;
  none.kind = DampingSettings::Kind::none;
  const Decay got = ring(none, 3.125, 1e-3, true);
  EXPECT_LT(std::abs(got.ratio), 1e-6);
  EXPECT_NEAR(got.frequency, 3.125, 1e-4 * 3.125);
}

}  // namespace
}  // namespace voussoir::test
