// Intensity measures against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "tools/campaign/measures.h"

namespace voussoir::campaign {
namespace VOUSSOIR_FILE {

const std::vector<double> periods = {0.5, 1.0};

/// Whole waves of A sin ωt along x, and of a share of it along y.
GroundMotion waves(double amplitude, double share, double vertical = 0.0) {
  GroundMotion m;
  m.dt = 0.001;
  for (int i = 0; i <= 4000; ++i) {
    const double a = amplitude * std::sin(2.0 * std::numbers::pi * 2.0 * 0.001 * i);
    m.acceleration.emplace_back(a, share * a, vertical * a);
  }
  return m;
}

std::map<std::string, double> named(const GroundMotion& motion) {
  const std::vector<Measure> list = measures(periods);
  const std::vector<double> values = measure(motion, periods);
  EXPECT_EQ(list.size(), values.size());
  std::map<std::string, double> m;
  for (std::size_t i = 0; i < list.size(); ++i) m[list[i].name] = values[i];
  return m;
}

TEST(CampaignMeasures, OfASineTheyAreKnown) {
  const double a = 3.0, omega = 4.0 * std::numbers::pi, t = 4.0, g = 9.80665;
  auto m = named(waves(a, 0.0));
  EXPECT_NEAR(m["pga"], a, 1e-4);
  EXPECT_NEAR(m["pgv"], 2.0 * a / omega, 1e-4);
  EXPECT_NEAR(m["arias"], std::numbers::pi / (2.0 * g) * a * a * t / 2.0, 1e-3);
  EXPECT_NEAR(m["cav"], a * t * 2.0 / std::numbers::pi, 1e-3);
  EXPECT_NEAR(m["d595"], 0.9 * t, 1.0 / omega);  // ∫ sin² leaves t/2 by at most 1/(4ω) at either end
  EXPECT_EQ(m["pga_y"], 0.0);
  // At resonance for n waves: A / (2 ζ) (1 − exp(−2 π n ζ)), to terms of ζ.
  EXPECT_NEAR(m["sa_0.50"], a / 0.1 * (1.0 - std::exp(-2.0 * std::numbers::pi * 8.0 * 0.05)), 0.02 * a / 0.1);
}

TEST(CampaignMeasures, TwoHorizontalsGiveTheirGeometricMean) {
  auto one = named(waves(3.0, 0.0)), two = named(waves(3.0, 0.25, 2.0));
  EXPECT_NEAR(two["pga"], 0.5 * one["pga"], 1e-9);
  EXPECT_NEAR(two["arias"], 0.25 * one["arias"], 1e-9);
  EXPECT_NEAR(two["sa_1.00"], 0.5 * one["sa_1.00"], 1e-9);
  EXPECT_NEAR(two["d595"], one["d595"], 1e-9);
  EXPECT_NEAR(two["pga_y"], 0.25 * two["pga_x"], 1e-12);
  EXPECT_NEAR(two["pga_z"], 2.0 * two["pga_x"], 1e-12);
}

TEST(CampaignMeasures, AVerticalMotionHasNoHorizontalMeasure) {
  GroundMotion m = waves(3.0, 0.0);
  for (Vec3& a : m.acceleration) a = Vec3(0.0, 0.0, a.x());
  auto found = named(m);
  EXPECT_TRUE(std::isnan(found["pga"]));
  EXPECT_NEAR(found["pga_z"], 3.0, 1e-4);
  EXPECT_NEAR(significant_end(m), 0.95 * 4.0, 0.05);
}

TEST(CampaignMeasures, ScalingIsAPower) {
  const GroundMotion small = waves(1.0, 0.5);
  GroundMotion large = small;
  for (Vec3& a : large.acceleration) a *= 3.0;
  const auto list = measures(periods);
  const auto before = measure(small, periods), after = measure(large, periods);
  for (std::size_t i = 0; i < list.size(); ++i)
    EXPECT_NEAR(after[i], before[i] * std::pow(3.0, list[i].power), 1e-9 * (1.0 + std::abs(after[i]))) << list[i].name;
}

TEST(CampaignMeasures, APartIsCutAtItsDuration) {
  const GroundMotion m = waves(1.0, 0.0);
  EXPECT_EQ(first_part(m, 0.25).acceleration.size(), 251u);
  EXPECT_EQ(first_part(m, 100.0).acceleration.size(), m.acceleration.size());
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::campaign
