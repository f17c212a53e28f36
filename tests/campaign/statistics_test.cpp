// The normal distribution to its far tails, lines and ranks by hand.
#include "tools/fragility/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/random.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

TEST(Statistics, NormalDistribution) {
  EXPECT_DOUBLE_EQ(normal_cdf(0.0), 0.5);
  EXPECT_NEAR(normal_cdf(1.6448536269514722), 0.95, 1e-15);
  EXPECT_NEAR(inverse_mills(0.0), std::sqrt(2.0 / M_PI), 1e-15);
  // Abramowitz & Stegun (1964), table 26.2: −log10 Q(x).
  EXPECT_NEAR(log_normal_cdf(-10.0) / std::log(10.0), -23.11805, 1e-5);
  EXPECT_NEAR(log_normal_cdf(-50.0) / std::log(10.0), -544.96634, 1e-5);
  EXPECT_NEAR(log_normal_cdf(-500.0) / std::log(10.0), -54289.90830, 1e-4);
}

/// The series of the tail takes over without a step, and the slope of ln Φ is φ/Φ on both sides.
TEST(Statistics, TailsJoin) {
  const double omitted = 105.0 / std::pow(25.0, 8);  // the next term
  EXPECT_NEAR(log_normal_cdf(-25.0) - log_normal_cdf(-25.0 + 1e-12), -25e-12, 1.01 * omitted);
  EXPECT_NEAR(inverse_mills(-25.0) / inverse_mills(-25.0 + 1e-12), 1.0, 1.01 * omitted);
  for (double z : {-60.0, -26.0, -24.0, -3.0, 0.0, 4.0})
    EXPECT_NEAR((log_normal_cdf(z + 1e-4) - log_normal_cdf(z - 1e-4)) / 2e-4 / inverse_mills(z), 1.0, 1e-6) << z;
}

TEST(Statistics, StudentsT) {
  EXPECT_NEAR(t_p_value(1.0, 1.0), 0.5, 1e-12);                               // Cauchy
  EXPECT_NEAR(t_p_value(-std::sqrt(2.0), 2.0), 1.0 - std::sqrt(0.5), 1e-12);  // t/√(2 + t²)
  EXPECT_NEAR(t_p_value(2.228139, 10.0), 0.05, 1e-6);                         // tables
  EXPECT_TRUE(std::isnan(t_p_value(1.0, 0.0)));
}

/// Residuals ½, −½, −½, ½ about y = 1 + 2x.
TEST(Statistics, ALineByHand) {
  const Line line = fit_line({0.0, 1.0, 2.0, 3.0}, {1.5, 2.5, 4.5, 7.5});
  EXPECT_NEAR(line.slope, 2.0, 1e-14);
  EXPECT_NEAR(line.intercept, 1.0, 1e-14);
  EXPECT_NEAR(line.scatter, std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(line.slope_std, std::sqrt(0.5 / 5.0), 1e-14);
  EXPECT_NEAR(line.r2, 20.0 / 21.0, 1e-14);
  const double t = 2.0 / std::sqrt(0.1);
  EXPECT_NEAR(line.p_value(), 1.0 - t / std::sqrt(2.0 + t * t), 1e-12);
}

TEST(Statistics, NoLineThroughOneAbscissa) {
  EXPECT_FALSE(fit_line({0.1, 0.1, 0.1}, {1.0, 2.0, 3.0}).known());
  EXPECT_FALSE(fit_line({1.0, 2.0}, {1.0, 2.0}).known());
  EXPECT_FALSE(fit_line({}, {}).known());
}

/// The coefficient of z by hand: x and z are orthogonal here, so it is Σ z r / Σ z² over the residuals of the line.
TEST(Statistics, WhatASecondVariableAdds) {
  const std::vector<double> x = {-1.0, -1.0, 1.0, 1.0, 0.0}, z = {-1.0, 1.0, -1.0, 1.0, 0.0};
  const std::vector<double> y = {0.0, 1.0, 2.0, 5.0, 2.0};  // 2 + 1.5 x + z + (½, −½, −½, ½, 0)
  const double t = 1.0 / std::sqrt(1.0 / 2.0 / 4.0);        // Σ r² = 1, two degrees of freedom, Σ z² = 4
  EXPECT_NEAR(added_p_value(x, y, z), 1.0 - t / std::sqrt(2.0 + t * t), 1e-12);
  EXPECT_TRUE(std::isnan(added_p_value(x, y, {-2.0, -2.0, 2.0, 2.0, 0.0})));  // z = 2 x
  EXPECT_TRUE(std::isnan(added_p_value(x, y, {1.0, 1.0, 1.0, 1.0, 1.0})));
}

/// Under the null hypothesis p-values are uniform: one in ten below 0.1, whatever z has to do with x.
TEST(Statistics, PValuesAreUniformWhereNothingIsAdded) {
  RandomStream random(5);
  int below = 0;
  constexpr int tries = 2000;
  for (int k = 0; k < tries; ++k) {
    std::vector<double> x, y, z;
    for (int i = 0; i < 20; ++i) {
      x.push_back(random.normal());
      y.push_back(2.0 * x.back() + random.normal());
      z.push_back(x.back() + 0.5 * random.normal());
    }
    below += added_p_value(x, y, z) < 0.1;
  }
  EXPECT_NEAR(double(below) / tries, 0.1, 3.0 * std::sqrt(0.09 / tries));
}

TEST(Statistics, Ranks) {
  EXPECT_DOUBLE_EQ(rank_correlation({1.0, 2.0, 3.0}, {1.0, 8.0, 27.0}), 1.0);
  EXPECT_DOUBLE_EQ(rank_correlation({1.0, 2.0, 3.0}, {3.0, 2.0, -7.0}), -1.0);
  // d² = 1 + 1 + 0 + 0: 1 − 6·2/(4·15).
  EXPECT_NEAR(rank_correlation({1.0, 2.0, 3.0, 4.0}, {2.0, 1.0, 3.0, 4.0}), 0.8, 1e-15);
  // Ranks 0.5, 0.5, 2 and 0, 1, 2: 1.5/√(1.5·2).
  EXPECT_NEAR(rank_correlation({5.0, 5.0, 7.0}, {1.0, 2.0, 3.0}), std::sqrt(0.75), 1e-15);
  EXPECT_TRUE(std::isnan(rank_correlation({1.0, 1.0}, {1.0, 2.0})));
}

TEST(Statistics, Quantiles) {
  EXPECT_DOUBLE_EQ(quantile({3.0}, 0.05), 3.0);
  EXPECT_DOUBLE_EQ(quantile({0.0, 1.0, 2.0}, 0.25), 0.5);
  EXPECT_DOUBLE_EQ(quantile({0.0, 1.0, 2.0}, 1.0), 2.0);
}

/// splitmix64 from seed 1234567: the first numbers of the authors' own program.
TEST(Statistics, RandomBits) {
  RandomStream random(1234567);
  EXPECT_EQ(random.bits(), 6457827717110365317ULL);
  EXPECT_EQ(random.bits(), 3203168211198807973ULL);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
