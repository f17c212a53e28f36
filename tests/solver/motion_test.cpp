// Pulses, synthetic accelerograms and baseline correction against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/base/error.h"
#include "solver/base/random.h"
#include "solver/motion/baseline.h"
#include "solver/motion/filter.h"
#include "solver/motion/ground_path.h"
#include "solver/motion/intensity.h"
#include "solver/motion/pulse.h"
#include "solver/motion/synthesis.h"
#include "solver/motion/target.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

double end_velocity(const GroundMotion& motion, int axis) {
  return integrate(component(motion, axis), motion.dt).back();
}

TEST(Pulse, RectangularAreaIsExact) {
  for (const double start : {0.0, 0.7}) {
    const GroundMotion motion = make_pulse(
        {.kind = PulseSettings::Kind::rectangular, .axis = 1, .amplitude = 3.0, .length = 0.4, .start = start});
    EXPECT_NEAR(end_velocity(motion, 1), 1.2, 1e-12);
    EXPECT_EQ(end_velocity(motion, 0), 0.0);
    EXPECT_NEAR(motion.duration(), start + 0.4, 0.001);
  }
}

TEST(Pulse, HalfSineAreaAndFullSineDisplacement) {
  const GroundMotion half = make_pulse({.kind = PulseSettings::Kind::half_sine, .amplitude = 2.0, .frequency = 1.0});
  EXPECT_NEAR(end_velocity(half, 0), 2.0 * 2.0 * 0.5 / std::numbers::pi, 1e-5);
  const double f = 2.0, amplitude = 4.0;
  const GroundMotion sine =
      make_pulse({.kind = PulseSettings::Kind::sine, .axis = 2, .amplitude = amplitude, .frequency = f});
  EXPECT_NEAR(end_velocity(sine, 2), 0.0, 1e-12);
  const double displacement = integrate(integrate(component(sine, 2), sine.dt), sine.dt).back();
  EXPECT_NEAR(displacement, amplitude / (2.0 * std::numbers::pi * f * f), 1e-5);  // A T / omega
}

TEST(Pulse, LengthAndFrequencyFollowFromEachOther) {
  EXPECT_DOUBLE_EQ(pulse_length({.kind = PulseSettings::Kind::sine, .frequency = 4.0}), 0.25);
  EXPECT_DOUBLE_EQ(pulse_frequency({.kind = PulseSettings::Kind::half_sine, .length = 0.25}), 2.0);
  EXPECT_NEAR(
      make_pulse({.kind = PulseSettings::Kind::sine, .amplitude = 1, .frequency = 2.0, .length = 3.0}).duration(), 3.0,
      0.01);
  EXPECT_THROW(make_pulse({.kind = PulseSettings::Kind::rectangular, .frequency = 2.0}), InputError);
  EXPECT_THROW(make_pulse({.kind = PulseSettings::Kind::sine}), InputError);
  EXPECT_THROW(make_pulse({.kind = PulseSettings::Kind::half_sine, .frequency = 2.0, .length = 1.0}), InputError);
}

/// From rest under a constant acceleration a: u = a t²/2, then on at the velocity reached; nothing before the start.
TEST(GroundPath, UnderConstantAcceleration) {
  const Vec3 a = {2.0, -1.0, 0.5};
  const GroundPath path = ground_path({0.1, std::vector<Vec3>(11, a)});
  EXPECT_EQ(path.displacement(-0.3), Vec3(0, 0, 0));
  EXPECT_EQ(path.displacement(0.0), Vec3(0, 0, 0));
  for (const double t : {0.03, 0.1, 0.57, 1.0}) EXPECT_LT((path.displacement(t) - 0.5 * t * t * a).norm(), 1e-15) << t;
  for (const double t : {1.0 + 1e-9, 1.4, 7.0})
    EXPECT_LT((path.displacement(t) - (0.5 + (t - 1.0)) * a).norm(), 1e-14) << t;
}

/// a = j t: u = j t³/6, whatever the samples; its velocity is continuous where it ends.
TEST(GroundPath, UnderLinearAcceleration) {
  const Vec3 jerk = {3.0, 0.0, -2.0};
  for (const int intervals : {1, 4, 25}) {
    GroundMotion motion = {1.0 / intervals, {}};
    for (int i = 0; i <= intervals; ++i) motion.acceleration.push_back(double(i) / intervals * jerk);
    const GroundPath path = ground_path(motion);
    for (const double t : {0.1, 0.25, 0.5, 0.77, 1.0})
      EXPECT_LT((path.displacement(t) - t * t * t / 6.0 * jerk).norm(), 1e-14) << t;
    EXPECT_LT((path.displacement(3.0) - (1.0 / 6.0 + 2.0 * 0.5) * jerk).norm(), 1e-14);
  }
}

/// Up and down again within three samples: the triangle's area is the velocity that stays, its centre the time from
/// which that velocity seems to count.
TEST(GroundPath, AfterATriangle) {
  const GroundPath path = ground_path({0.2, {Vec3::Zero(), Vec3(5, 0, 0), Vec3::Zero()}});
  EXPECT_NEAR(path.displacement(0.4).x(), 0.2 * 1.0, 1e-15);
  EXPECT_NEAR(path.displacement(1.2).x(), 1.0 * 1.0, 1e-15);
}

TEST(GroundPath, OfNothingOrOneSampleIsNoWay) {
  EXPECT_EQ(GroundPath{}.displacement(1.0), Vec3(0, 0, 0));
  EXPECT_EQ(ground_path({0.1, {Vec3(1, 1, 1)}}).displacement(1.0), Vec3(0, 0, 0));
}

TEST(Baseline, RemovesAnyCubicVelocityDriftAndEndsAtRest) {
  GroundMotion clean;
  clean.dt = 0.01;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.01 * i;
    clean.acceleration.push_back({std::sin(7.0 * t) * std::exp(-0.3 * t), std::cos(3.0 * t), 0.0});
  }
  GroundMotion drifted = clean;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.01 * i;
    drifted.acceleration[std::size_t(i)] += Vec3(0.3 - 0.02 * t, 0.001 * t * t, -0.5);
  }
  const GroundMotion a = correct_baseline(clean), b = correct_baseline(drifted);
  for (std::size_t i = 0; i < a.acceleration.size(); ++i)
    ASSERT_LT((a.acceleration[i] - b.acceleration[i]).norm(), 1e-9) << "sample " << i;
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(end_velocity(b, axis), 0.0, 1e-10);
  EXPECT_GT(std::abs(end_velocity(drifted, 0)), 1.0);
}

TEST(Synthesis, SpectrumAndEnvelopeHaveTheirClosedForms) {
  const double wg = 15.0, zg = 0.6;
  // At the ground's own frequency Kanai-Tajimi is (1 + 4 z²)/(4 z²); the high-pass filter is there within 1 %.
  EXPECT_NEAR(ground_spectrum(wg, wg, zg), (1.0 + 4.0 * zg * zg) / (4.0 * zg * zg), 0.02 * 1.694);
  EXPECT_NEAR(ground_spectrum(0.1 * wg, wg, zg), 1.0 / 1.44 * (1.0 + 0.0144) / (0.9801 + 0.0144), 1e-9);
  EXPECT_LT(ground_spectrum(0.001 * wg, wg, zg), 1e-7);
  EXPECT_DOUBLE_EQ(jennings_envelope(1.0, 2.0, 5.0, 10.0), 0.25);
  EXPECT_DOUBLE_EQ(jennings_envelope(4.0, 2.0, 5.0, 10.0), 1.0);
  EXPECT_NEAR(jennings_envelope(10.0, 2.0, 5.0, 10.0), 0.05, 1e-15);
}

TEST(Synthesis, ReachesItsPeakEndsAtRestAndRepeats) {
  const SyntheticSettings settings = {.seed = 7, .peak = 3.0, .duration = 12.0, .axes = {true, false, true}};
  const GroundMotion motion = synthesize(settings);
  EXPECT_NEAR(motion.duration(), 12.0, 1e-9);
  for (const int axis : {0, 2}) {
    double peak = 0.0;
    for (const double a : component(motion, axis)) peak = std::max(peak, std::abs(a));
    EXPECT_NEAR(peak, 3.0, 1e-12);
    EXPECT_NEAR(end_velocity(motion, axis), 0.0, 1e-10);
  }
  for (const double a : component(motion, 1)) ASSERT_EQ(a, 0.0);
  EXPECT_NE(component(motion, 0), component(motion, 2));
  EXPECT_EQ(component(synthesize(settings), 0), component(motion, 0));
  SyntheticSettings other = settings;
  other.seed = 8;
  EXPECT_NE(component(synthesize(other), 0), component(motion, 0));
}

/// Rate of upward zero crossings of a stationary Gaussian process: √(m2/m0)/2π (Rice 1944), here in the strong phase
/// and averaged over seeds.
TEST(Synthesis, CrossesZeroAtTheRateOfItsSpectrum) {
  const SyntheticSettings base = {.peak = 1.0, .duration = 20.0, .frequency = 3.0, .rise = 0.1, .strong = 0.9};
  double m0 = 0.0, m2 = 0.0;
  for (double f = 0.0125; f <= 25.0; f += 0.025) {
    const double w = 2.0 * std::numbers::pi * f, s = ground_spectrum(w, 6.0 * std::numbers::pi, base.bandwidth);
    m0 += s;
    m2 += s * w * w;
  }
  const double expected = std::sqrt(m2 / m0) / (2.0 * std::numbers::pi);
  double crossings = 0.0, seconds = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SyntheticSettings settings = base;
    settings.seed = seed;
    const std::vector<double> a = component(synthesize(settings), 0);
    for (std::size_t i = 400; i + 400 < a.size(); ++i) crossings += a[i] < 0.0 && a[i + 1] >= 0.0;
    seconds += double(a.size() - 800) * base.dt;
  }
  EXPECT_NEAR(crossings / seconds, expected, 0.05 * expected);
}

TEST(Synthesis, HasTheSpectrumItIsAskedFor) {
  constexpr double g = 9.80665;
  SyntheticSettings settings;
  settings.duration = 20.0, settings.axes = {true, true, true};
  settings.spectrum = TargetSpectrum{TargetCode::ntc2018, 0.2607, 2.36, 0.35, 'D', 1, 0.05};
  std::vector<double> periods;
  for (double period = 0.05; period < 3.0; period *= 1.031) periods.push_back(period);  // not those it was made at
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    settings.seed = seed;
    const GroundMotion motion = synthesize(settings);
    EXPECT_EQ(motion.acceleration, synthesize(settings).acceleration);
    double sums[3] = {};
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double> a = component(motion, axis), response = response_spectrum(a, motion.dt, periods);
      EXPECT_NEAR(integrate(a, motion.dt).back(), 0.0, 1e-9);
      for (std::size_t k = 0; k < periods.size(); ++k) {
        const double target = g * (axis == 2 ? vertical_spectral_acceleration(*settings.spectrum, periods[k])
                                             : spectral_acceleration(*settings.spectrum, periods[k]));
        EXPECT_NEAR(response[k] / target, 1.0, 0.15) << "axis " << axis << ", " << periods[k] << " s, seed " << seed;
        sums[axis] += response[k] / target / double(periods.size());
      }
    }
    for (const double mean : sums) EXPECT_NEAR(mean, 1.0, 0.03);
  }
  settings.spectrum->soil = 'F';
  EXPECT_THROW(synthesize(settings), InputError);
}

/// The sum as it is written, one wave after the other, in the order of its random numbers; then as synthesize() goes
/// on.
std::vector<double> direct_sum(const SyntheticSettings& s) {
  const auto n = std::size_t(std::llround(s.duration / s.dt)) + 1;
  const double step = 0.5 / s.duration, pi = std::numbers::pi;
  GroundMotion motion{s.dt, std::vector<Vec3>(n, Vec3::Zero())};
  RandomStream random(s.seed);
  for (int k = 1; k * step <= std::min(25.0, 0.5 / s.dt); ++k) {
    const double omega = 2.0 * pi * k * step,
                 size = std::sqrt(ground_spectrum(omega, 2.0 * pi * s.frequency, s.bandwidth) * 2.0 * pi * step),
                 c = size * random.normal(), b = size * random.normal();
    for (std::size_t i = 0; i < n; ++i)
      motion.acceleration[i].x() += c * std::cos(omega * double(i) * s.dt) + b * std::sin(omega * double(i) * s.dt);
  }
  for (std::size_t i = 0; i < n; ++i)
    motion.acceleration[i] *=
        jennings_envelope(double(i) * s.dt, s.rise * s.duration, s.strong * s.duration, s.duration);
  std::vector<double> a = component(correct_baseline(motion), 0);
  double largest = 0.0;
  for (const double v : a) largest = std::max(largest, std::abs(v));
  for (double& v : a) v *= s.peak / largest;
  return a;
}

TEST(Synthesis, IsTheDirectSumAtTheCostOfATransform) {
  // Also steps that do not fit the duration, and a prime number of samples.
  for (const auto& [duration, dt] : {std::pair{8.0, 0.005}, {7.0013, 0.01}, {10.06, 0.01}, {3.0, 0.0031}}) {
    SyntheticSettings settings = {.seed = 11, .peak = 2.0, .duration = duration, .dt = dt};
    const std::vector<double> expected = direct_sum(settings), a = component(synthesize(settings), 0);
    ASSERT_EQ(a.size(), expected.size());
    double off = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, std::abs(a[i] - expected[i]));
    EXPECT_LT(off, 1e-10) << duration << " s at " << dt << " s";
  }
  // A million samples: 1e11 products one by one, which is minutes.
  EXPECT_EQ(synthesize({.peak = 1.0, .duration = 5000.0}).acceleration.size(), 1000001u);
}

TEST(Synthesis, RefusesNonsense) {
  EXPECT_THROW(synthesize({.peak = 0.0, .duration = 5.0}), InputError);
  EXPECT_THROW(synthesize({.peak = 1.0, .duration = -5.0}), InputError);
  EXPECT_THROW(synthesize({.peak = 1.0, .duration = 5.0, .axes = {false, false, false}}), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
