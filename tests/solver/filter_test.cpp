// Taper, band-pass and resampling of accelerograms, against their closed forms.
#include "solver/motion/filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/base/error.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

constexpr double pi = std::numbers::pi;

std::vector<double> wave(double frequency, double dt, std::size_t n) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = std::sin(2.0 * pi * frequency * dt * double(i));
  return values;
}

/// Amplitude of a frequency in the middle half, where the ends are far away.
double amplitude(const std::vector<double>& values, double frequency, double dt) {
  double c = 0.0, s = 0.0;
  const std::size_t begin = values.size() / 4, end = begin + values.size() / 2;
  for (std::size_t i = begin; i < end; ++i) {
    c += values[i] * std::cos(2.0 * pi * frequency * dt * double(i));
    s += values[i] * std::sin(2.0 * pi * frequency * dt * double(i));
  }
  return 2.0 * std::hypot(c, s) / double(end - begin);
}

TEST(Filter, AmplitudesOfButterworthBothWays) {
  const double dt = 0.005;
  for (const double f : {0.25, 0.5, 1.0, 5.0, 20.0, 25.0}) {
    const std::vector<double> passed = band_pass(wave(f, dt, 16000), dt, 0.5, 20.0, 4);
    const double gain = 1.0 / (1.0 + std::pow(0.5 / f, 8)) / (1.0 + std::pow(f / 20.0, 8));
    EXPECT_NEAR(amplitude(passed, f, dt), gain, 2e-3) << f;
  }
}

TEST(Filter, NoPhase) {
  const double dt = 0.01;
  std::vector<double> pulse(2001, 0.0);
  for (int i = -20; i <= 20; ++i) pulse[std::size_t(1000 + i)] = std::cos(0.5 * pi * i / 20.0);
  const std::vector<double> passed = band_pass(pulse, dt, 0.1, 10.0);
  for (std::size_t i = 0; i <= 1000; ++i) EXPECT_NEAR(passed[1000 - i], passed[1000 + i], 1e-12);
  EXPECT_NEAR(band_pass(pulse, dt, 0.0, 0.0)[1000], 1.0, 1e-12);  // both sides open
}

TEST(Filter, TaperIsHalfACosine) {
  std::vector<double> ones(100, 1.0);
  taper(ones, 0.1);
  EXPECT_EQ(ones.front(), 0.0);
  EXPECT_NEAR(ones[5], 0.5, 1e-15);
  EXPECT_EQ(ones[10], 1.0);
  EXPECT_EQ(ones[99], 0.0);
  EXPECT_THROW(taper(ones, 0.6), InputError);
}

TEST(Filter, ResamplingIsLinearToFinerAndFoldsNothingBackToCoarser) {
  const std::vector<double> fine = resample({0.0, 1.0, -1.0}, 0.01, 0.0025);
  ASSERT_EQ(fine.size(), 9u);
  EXPECT_NEAR(fine[2], 0.5, 1e-12);
  EXPECT_NEAR(fine[6], 0.0, 1e-12);
  EXPECT_NEAR(fine[8], -1.0, 1e-12);
  // 18 Hz at 200 Hz; a step of 0.05 s has room for 10 Hz: without a filter it would appear at 2 Hz.
  const std::vector<double> coarse = resample(wave(18.0, 0.005, 16001), 0.005, 0.05);
  EXPECT_EQ(coarse.size(), 1601u);
  EXPECT_LT(amplitude(coarse, 2.0, 0.05), 3e-3);
  EXPECT_NEAR(amplitude(resample(wave(2.0, 0.005, 16001), 0.005, 0.05), 2.0, 0.05), 1.0, 1e-2);
}

TEST(Filter, ProcessingKeepsOrderAndComponents) {
  GroundMotion motion{0.005, {}};
  for (const double a : wave(2.0, 0.005, 4001)) motion.acceleration.emplace_back(a, 0.0, -2.0 * a);
  MotionProcessing asked;
  asked.taper = 0.05, asked.low = 0.1, asked.high = 25.0, asked.baseline = true, asked.dt = 0.01;
  const GroundMotion done = process(motion, asked);
  EXPECT_EQ(done.dt, 0.01);
  ASSERT_EQ(done.acceleration.size(), 2001u);
  double velocity = 0.0;
  for (std::size_t i = 0; i < done.acceleration.size(); ++i) {
    EXPECT_EQ(done.acceleration[i].y(), 0.0);
    EXPECT_NEAR(done.acceleration[i].z(), -2.0 * done.acceleration[i].x(), 1e-10);
    velocity += 0.01 * done.acceleration[i].x();
  }
  EXPECT_NEAR(velocity, 0.0, 1e-3);
}

TEST(Filter, CornersOutOfOrderAreRefused) {
  const std::vector<double> values(100, 1.0);
  EXPECT_THROW(band_pass(values, 0.01, 10.0, 1.0), InputError);
  EXPECT_THROW(band_pass(values, 0.01, 0.1, 60.0), InputError);
  EXPECT_THROW(band_pass(values, 0.01, 0.1, 10.0, 0), InputError);
  EXPECT_THROW(resample(values, 0.01, 0.0), InputError);
  // What would take hours or all memory.
  EXPECT_THROW(resample(values, 0.01, 1e9), InputError);
  EXPECT_THROW(resample(std::vector<double>(20000, 1.0), 1.0, 1e-5), InputError);
  EXPECT_THROW(band_pass(values, 0.01, 1e-9, 10.0), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
