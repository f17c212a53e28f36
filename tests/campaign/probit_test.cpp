// Lognormal curves from counts: closed forms, data that determine none, and whether errors are what they are said to
// be.
#include "tools/fragility/probit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/campaign/synthetic.h"
#include "tools/fragility/statistics.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// Two levels and two parameters: the curve goes through both shares exactly. z(1/4) = −0.6745, z(3/4) = 0.6745.
TEST(Counts, TwoLevelsAreMetExactly) {
  const LognormalFit fit = fit_counts({{1.0, 20.0, 5.0}, {4.0, 20.0, 15.0}});
  ASSERT_EQ(fit.identified, Identified::yes);
  const double z = 0.6744897501960817;
  EXPECT_NEAR(fit.theta, 2.0, 1e-10);
  EXPECT_NEAR(fit.beta, std::log(2.0) / z, 1e-10);
  EXPECT_NEAR(fit.log_likelihood, 2.0 * (15.0 * std::log(0.75) + 5.0 * std::log(0.25)), 1e-10);
  // var z_i = p(1 − p)/(n φ²); ln θ is mean − β z̄ with both z equally far: std = β std(z)/√2, std β = β std(z)/(z √2).
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * M_PI);
  const double std_z = std::sqrt(0.25 * 0.75 / 20.0) / density;
  EXPECT_NEAR(fit.ln_theta_std, fit.beta * std_z / std::sqrt(2.0), 1e-8);
  EXPECT_NEAR(fit.beta_std, fit.beta * std_z / z / std::sqrt(2.0), 1e-8);
}

TEST(Counts, UnitsAndGroupingDoNotMatter) {
  const LognormalFit grouped = fit_counts({{1.0, 4.0, 1.0}, {2.0, 4.0, 2.0}, {3.0, 4.0, 3.0}});
  std::vector<Count> single;
  for (int level = 1; level <= 3; ++level)
    for (int i = 0; i < 4; ++i) single.push_back({9.81 * level, 1.0, i < level ? 1.0 : 0.0});
  const LognormalFit apart = fit_counts(single);
  EXPECT_NEAR(apart.theta, 9.81 * grouped.theta, 1e-8);
  EXPECT_NEAR(apart.beta, grouped.beta, 1e-9);
  EXPECT_NEAR(apart.ln_theta_std, grouped.ln_theta_std, 1e-9);
}

TEST(Counts, WhatDeterminesNoCurveIsSaid) {
  EXPECT_EQ(fit_counts({}).identified, Identified::no_runs);
  const LognormalFit nothing = fit_counts({{1.0, 5.0, 0.0}, {3.0, 5.0, 0.0}});
  EXPECT_EQ(nothing.identified, Identified::none_beyond);
  EXPECT_DOUBLE_EQ(nothing.below, 3.0);
  EXPECT_TRUE(std::isnan(nothing.above));
  EXPECT_TRUE(std::isnan(nothing.theta));
  const LognormalFit all = fit_counts({{1.0, 5.0, 5.0}, {3.0, 5.0, 5.0}});
  EXPECT_EQ(all.identified, Identified::all_beyond);
  EXPECT_DOUBLE_EQ(all.above, 1.0);
  EXPECT_EQ(fit_counts({{2.0, 10.0, 4.0}}).identified, Identified::one_level);
  const LognormalFit apart = fit_counts({{1.0, 5.0, 0.0}, {2.0, 5.0, 0.0}, {3.0, 5.0, 5.0}});
  EXPECT_EQ(apart.identified, Identified::separated);
  EXPECT_DOUBLE_EQ(apart.below, 2.0);
  EXPECT_DOUBLE_EQ(apart.above, 3.0);
  // Both outcomes at one level alone: which side of it the median is on follows from the share there.
  const LognormalFit mixed = fit_counts({{1.0, 5.0, 0.0}, {2.0, 5.0, 2.0}, {3.0, 5.0, 5.0}});
  EXPECT_EQ(mixed.identified, Identified::one_mixed);
  EXPECT_DOUBLE_EQ(mixed.below, 2.0);
  EXPECT_DOUBLE_EQ(mixed.above, 3.0);
  EXPECT_EQ(mixed.mixed.beyond, 2.0);
  EXPECT_NEAR(mixed.log_likelihood, 2.0 * std::log(0.4) + 3.0 * std::log(0.6), 1e-14);
  const LognormalFit top = fit_counts({{1.0, 5.0, 0.0}, {2.0, 5.0, 2.0}});
  EXPECT_EQ(top.identified, Identified::one_mixed);
  EXPECT_DOUBLE_EQ(top.below, 2.0);
  EXPECT_TRUE(std::isnan(top.above));
  EXPECT_DOUBLE_EQ(fit_counts({{1.0, 5.0, 0.0}, {2.0, 5.0, 3.0}}).below, 1.0);
  EXPECT_EQ(fit_counts({{1.0, 5.0, 5.0}, {2.0, 5.0, 0.0}}).identified, Identified::falling);
  EXPECT_EQ(fit_counts({{1.0, 5.0, 3.0}, {2.0, 5.0, 2.0}}).identified, Identified::falling);
  EXPECT_EQ(fit_counts({{1.0, 5.0, 2.0}, {2.0, 5.0, 2.0}}).identified, Identified::falling);
}

/// Far outliers ask for probabilities that vanish in double precision at the first steps.
TEST(Counts, FarOutliersAndSteepCurvesConverge) {
  std::vector<Count> counts;
  for (int i = 0; i < 50; ++i) counts.push_back({1.0 + 1e-3 * i, 1.0, i % 2 ? 1.0 : 0.0});
  counts.push_back({1e-6, 1.0, 1.0});
  const LognormalFit flat = fit_counts(counts);
  EXPECT_TRUE(flat.identified == Identified::yes || flat.identified == Identified::falling);
  const LognormalFit steep =
      fit_counts({{1e-8, 1000.0, 0.0}, {0.999, 9.0, 1.0}, {1.001, 9.0, 8.0}, {1e8, 1000.0, 1000.0}});
  ASSERT_EQ(steep.identified, Identified::yes);
  EXPECT_NEAR(steep.theta, 1.0, 1e-6);
  EXPECT_NEAR(steep.beta, 0.5 * std::log(1.001 / 0.999) / 1.2206403488473496, 1e-8);  // z(8/9)
}

/// Many campaigns of stripes: θ and β without bias, standard errors that are those of the estimates.
TEST(Counts, StripesGiveBackWhatTheyWereDrawnFrom) {
  constexpr double theta = 2.5, beta = 0.45;
  constexpr int tries = 600;
  RandomStream random(11);
  double sum_t = 0.0, sum_b = 0.0, squares_t = 0.0, squares_b = 0.0, said_t = 0.0, said_b = 0.0;
  int far = 0;
  for (int k = 0; k < tries; ++k) {
    const auto trials = test::draw_stripes({1.0, 1.5, 2.0, 2.5, 3.2, 4.5}, 40, theta, beta, random);
    const LognormalFit fit = fit_counts(counts_of(trials, {1.0, 1.5, 2.0, 2.5, 3.2, 4.5}));
    ASSERT_EQ(fit.identified, Identified::yes);
    const double t = std::log(fit.theta / theta), b = fit.beta - beta;
    sum_t += t, sum_b += b, squares_t += t * t, squares_b += b * b;
    said_t += fit.ln_theta_std * fit.ln_theta_std, said_b += fit.beta_std * fit.beta_std;
    far += std::abs(t) > 3.0 * fit.ln_theta_std;
  }
  const double std_t = std::sqrt(squares_t / tries), std_b = std::sqrt(squares_b / tries);
  EXPECT_NEAR(sum_t / tries, 0.0, 3.0 * std_t / std::sqrt(double(tries)));
  EXPECT_NEAR(sum_b / tries, 0.0, 0.02 * beta);               // of order 1/n: 240 runs
  EXPECT_NEAR(std::sqrt(said_t / tries) / std_t, 1.0, 0.09);  // three standard errors of a standard deviation of 600
  EXPECT_NEAR(std::sqrt(said_b / tries) / std_b, 1.0, 0.09);
  EXPECT_LT(far, 10);  // 0.27 % are 1.6
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
