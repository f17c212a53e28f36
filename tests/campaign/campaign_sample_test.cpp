// What is sampled has the moments that its distribution says, and depends on nothing but seed, name and number.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/campaign/campaign_folder.h"
#include "tools/campaign/sample.h"

namespace voussoir::campaign {
namespace VOUSSOIR_FILE {

constexpr int many = 40000;

Sampled sampled(Sampled::Distribution distribution, double cov) {
  Sampled s;
  s.keys = {std::string("materials.masonry.youngs_modulus")};
  s.distribution = distribution;
  s.cov = cov;
  return s;
}

struct Moments {
  double mean = 0.0, deviation = 0.0, skewness = 0.0, lowest = 1e300, highest = -1e300;
};

Moments moments(const Sampled& s, double mean, std::uint64_t seed = 7) {
  std::vector<double> x;
  for (int i = 1; i <= many; ++i) x.push_back(draw(s, s.keys[0], mean, seed, i));
  Moments m;
  for (const double v : x) m.mean += v / many, m.lowest = std::min(m.lowest, v), m.highest = std::max(m.highest, v);
  for (const double v : x) m.deviation += (v - m.mean) * (v - m.mean) / many;
  m.deviation = std::sqrt(m.deviation);
  for (const double v : x) m.skewness += std::pow((v - m.mean) / m.deviation, 3.0) / many;
  return m;
}

// Standard errors of mean and deviation of n numbers are σ/√n and σ/√(2n): 0.5 % and 0.35 % of σ here; tolerances are
// four of them and more where tails are longer.

TEST(CampaignSample, NormalHasItsMoments) {
  const Moments m = moments(sampled(Sampled::Distribution::normal, 0.2), 4e9);
  EXPECT_NEAR(m.mean, 4e9, 0.02 * 0.8e9);
  EXPECT_NEAR(m.deviation, 0.8e9, 0.015 * 0.8e9);
  EXPECT_NEAR(m.skewness, 0.0, 0.05);
}

/// Skewness of a lognormal variable: (v² + 3) v.
TEST(CampaignSample, LognormalHasMeanAndCovOfTheVariableItself) {
  const Moments m = moments(sampled(Sampled::Distribution::lognormal, 0.3), 4e9);
  EXPECT_NEAR(m.mean, 4e9, 0.02 * 1.2e9);
  EXPECT_NEAR(m.deviation, 1.2e9, 0.03 * 1.2e9);
  EXPECT_NEAR(m.skewness, 0.3 * (0.3 * 0.3 + 3.0), 0.15);
  EXPECT_GT(m.lowest, 0.0);
}

TEST(CampaignSample, UniformFillsItsRange) {
  Sampled s = sampled(Sampled::Distribution::uniform, 0.0);
  s.low = 20.0, s.high = 40.0;
  const Moments range = moments(s, 1.0);
  EXPECT_NEAR(range.mean, 30.0, 0.02 * 5.77);
  EXPECT_NEAR(range.deviation, 20.0 / std::sqrt(12.0), 0.02 * 5.77);
  EXPECT_GE(range.lowest, 20.0);
  EXPECT_LE(range.highest, 40.0);
  const Moments spread = moments(sampled(Sampled::Distribution::uniform, 0.1), 30.0);
  EXPECT_NEAR(spread.deviation, 3.0, 0.02 * 3.0);
  EXPECT_GE(spread.lowest, 30.0 - 3.0 * std::sqrt(3.0));
}

TEST(CampaignSample, LimitsCutWithoutHeapingUp) {
  Sampled s = sampled(Sampled::Distribution::normal, 0.0);
  s.deviation = 3.0, s.low = 28.0, s.high = 32.0;
  const Moments m = moments(s, 30.0);
  EXPECT_GE(m.lowest, 28.0);
  EXPECT_LE(m.highest, 32.0);
  // Of a normal variable cut at ±c: σ² (1 − 2 c φ(c) / (2 Φ(c) − 1)).
  const double c = 2.0 / 3.0, density = std::exp(-0.5 * c * c) / std::sqrt(2.0 * M_PI);
  EXPECT_NEAR(m.deviation, 3.0 * std::sqrt(1.0 - 2.0 * c * density / std::erf(c / std::sqrt(2.0))), 0.02);
}

TEST(CampaignSample, SeedNameAndNumberMakeIt) {
  Sampled s = sampled(Sampled::Distribution::normal, 0.1);
  const double value = draw(s, s.keys[0], 1.0, 1, 1);
  EXPECT_EQ(draw(s, s.keys[0], 1.0, 1, 1), value);
  EXPECT_NE(draw(s, s.keys[0], 1.0, 2, 1), value);
  EXPECT_NE(draw(s, s.keys[0], 1.0, 1, 2), value);
  EXPECT_DOUBLE_EQ(draw(s, s.keys[0], 5.0, 1, 1), 5.0 * value)
      << "another case with another mean: the same share of it";
  s.keys.push_back("materials.masonry.shear_modulus");
  EXPECT_EQ(draw(s, s.keys[1], 1.0, 1, 1), value) << "keys of one table go together";
  s.keys.erase(s.keys.begin());
  EXPECT_NE(draw(s, s.keys[0], 1.0, 1, 1), value);
}

/// Neighbouring seeds and names must not give related streams.
TEST(CampaignSample, StreamsAreNotRelated) {
  Sampled a = sampled(Sampled::Distribution::normal, 1.0), b = a;
  b.keys = {std::string("materials.masonry.shear_modulus")};
  const auto correlation = [&](const Sampled& other, std::uint64_t seed, int shift) {
    double sum = 0.0;
    for (int i = 1; i <= many; ++i)
      sum += (draw(a, a.keys[0], 1.0, 1, i) - 1.0) * (draw(other, other.keys[0], 1.0, seed, i + shift) - 1.0) / many;
    return sum;
  };
  EXPECT_NEAR(correlation(a, 1, 0), 1.0, 0.05);
  EXPECT_NEAR(correlation(a, 2, 0), 0.0, 0.025);
  EXPECT_NEAR(correlation(a, 1, 1), 0.0, 0.025);
  EXPECT_NEAR(correlation(b, 1, 0), 0.0, 0.025);
}

TEST(CampaignSample, WhatCannotBeDrawnIsSaid) {
  const Sampled s = sampled(Sampled::Distribution::lognormal, 0.2);
  EXPECT_NE(test::message_of<InputError>([&] {
              draw(s, "k", 0.0, 1, 1);
            }).find("has the mean 0. A lognormal distribution needs a mean above 0"),
            std::string::npos);
  Sampled far = sampled(Sampled::Distribution::normal, 0.01);
  far.low = 10.0;
  EXPECT_NE(test::message_of<InputError>([&] { draw(far, "k", 1.0, 1, 1); }).find("Increase this range"),
            std::string::npos);
  Sampled zero = sampled(Sampled::Distribution::normal, 0.1);
  EXPECT_NE(test::message_of<InputError>([&] { draw(zero, "k", 0.0, 1, 1); }).find("Give 'deviation'"),
            std::string::npos);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::campaign
