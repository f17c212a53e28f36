// Joint laws at a single point, driven by displacement.
#include "solver/model/laws.h"

#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double kn = 1e9, ks = 4e8;  // Pa/m

JointLaw bonded_law() {
  JointLaw law;
  law.tension = 2e5;
  law.cohesion = 3e5;
  law.friction_angle = radians(35.0);
  law.residual_friction_angle = radians(30.0);
  return law;
}

/// A point under test: law, memory and what it has dissipated.
template <class Law>
struct Point {
  explicit Point(const JointLaw& l) : law(law_constants(l)) {}
  PointResult to(double n, double s, double t = 0.0) {
    const PointResult r = Law::update(law, kn, ks, n, s, t, memory);
    friction += r.friction;
    fracture += r.fracture;
    return r;
  }
  LawConstants law;
  PointMemory memory;
  double friction = 0.0, fracture = 0.0;
};

TEST(BrittleLaw, IsASpringBelowItsLimits) {
  Point<BrittleLaw> point(bonded_law());
  const PointResult r = point.to(1.9e5 / kn, 1e-5, -2e-5);
  EXPECT_TRUE(r.elastic);
  EXPECT_DOUBLE_EQ(r.n, 1.9e5 / kn);
  EXPECT_DOUBLE_EQ(r.s, 1e-5);
  EXPECT_DOUBLE_EQ(r.t, -2e-5);
  EXPECT_FALSE(point.memory.broken);
}

TEST(BrittleLaw, LosesItsBondForGoodAtTheTensionLimit) {
  Point<BrittleLaw> point(bonded_law());
  const PointResult r = point.to(2.01e5 / kn, 0.0);
  EXPECT_TRUE(point.memory.broken);
  EXPECT_TRUE(r.open);
  EXPECT_EQ(r.n, 0.0);
  // The spring's energy at the limit, ft²/(2 kn), is lost.
  EXPECT_NEAR(point.fracture, 0.5 * 2.01e5 * 2.01e5 / kn, 1e-9);
  EXPECT_EQ(point.to(1e5 / kn, 0.0).n, 0.0) << "half the old strength is carried no more";
  EXPECT_DOUBLE_EQ(point.to(-1e-5, 0.0).n, -1e-5) << "it closes again";
}

TEST(BrittleLaw, LosesItsBondAtTheCohesiveCone) {
  Point<BrittleLaw> point(bonded_law());
  const double sigma = -1e6, limit = 3e5 + 1e6 * std::tan(radians(35.0));
  EXPECT_TRUE(point.to(sigma / kn, 0.9999 * limit / ks).elastic);
  const PointResult r = point.to(sigma / kn, 1.0001 * limit / ks);
  EXPECT_TRUE(point.memory.broken);
  // No cohesion left, residual friction: |τ| = −σ tan φ_res.
  EXPECT_NEAR(ks * r.s, 1e6 * std::tan(radians(30.0)), 1e-6);
  EXPECT_DOUBLE_EQ(kn * r.n, sigma);
}

TEST(BrittleLaw, SlidesOnTheConeAgainstTheShear) {
  Point<BrittleLaw> point(dry_law(0.6));
  point.memory.broken = true;
  point.to(-1e-3, 0.0);
  for (int i = 1; i <= 100; ++i) {
    const PointResult r = point.to(-1e-3, 3e-5 * i, 4e-5 * i);
    const double shear = ks * std::hypot(r.s, r.t);
    EXPECT_LE(shear, 0.6 * 1e6 * (1 + 1e-12));
    EXPECT_DOUBLE_EQ(r.n, -1e-3) << "no dilation: the normal jump is untouched";
    if (i == 100) {
      EXPECT_NEAR(ks * r.s, 0.6 * 0.6e6, 1.0);
      EXPECT_NEAR(ks * r.t, 0.8 * 0.6e6, 1.0);
    }
  }
  // Work: friction × slip, slip = total − elastic.
  const double slip = 5e-3 - 0.6e6 / ks;
  EXPECT_NEAR(std::hypot(point.memory.s, point.memory.t), slip, 1e-12);
  EXPECT_NEAR(point.friction, 0.6e6 * slip, 1e-6 * 0.6e6 * slip);
}

TEST(BrittleLaw, DilationPressesAConfinedPoint) {
  JointLaw law = dry_law(0.6);
  law.dilation_angle = radians(10.0);
  Point<BrittleLaw> point(law);
  point.memory.broken = true;
  PointResult r;
  for (int i = 0; i <= 1000; ++i) r = point.to(-1e-4, 1e-6 * i);
  // While it slides at a fixed un the compression grows by kn tan ψ times the slip and stays on the cone.
  EXPECT_NEAR(point.memory.n, std::tan(radians(10.0)) * point.memory.s, 1e-12);
  EXPECT_NEAR(r.n, -1e-4 - point.memory.n, 1e-15);
  EXPECT_NEAR(ks * r.s, -0.6 * kn * r.n, 1e-6 * ks * r.s);
  EXPECT_NEAR(point.memory.s + r.s, 1e-3, 1e-12);
  // Energy: work of the driving displacement (shear only, un fixed) = stored − stored at the start + friction. The
  // driving shear traction is τ = 0.6 (σ0 + kn tan ψ slip) once it slides.
  const double tan_dilation = std::tan(radians(10.0)), slip = point.memory.s, start = 0.6 * kn * 1e-4;
  const double elastic_slip_ratio = 0.6 * kn * tan_dilation / ks;  // d(us_el)/d(slip)
  const double work =
      0.5 * start * start / ks + (1 + elastic_slip_ratio) * (start * slip + 0.3 * kn * tan_dilation * slip * slip);
  const double stored = 0.5 * kn * r.n * r.n + 0.5 * ks * r.s * r.s - 0.5 * kn * 1e-8;
  EXPECT_NEAR(stored + point.friction, work, 2e-3 * work);
}

TEST(BrittleLaw, AnOpenPointFollowsAndClosesWithoutAShearKick) {
  Point<BrittleLaw> point(dry_law(0.6));
  point.memory.broken = true;
  point.to(-1e-4, 1e-6);
  EXPECT_TRUE(point.to(1e-3, 5e-3, -2e-3).open);
  const PointResult r = point.to(-1e-6, 5e-3 + 1e-7, -2e-3);
  EXPECT_NEAR(r.s, 1e-7, 1e-18);
  EXPECT_EQ(r.t, 0.0);
  EXPECT_DOUBLE_EQ(r.n, -1e-6);
}

TEST(BrittleLaw, AnApexBelowTheTensionLimitBreaksInPureTension) {
  JointLaw law = bonded_law();
  law.cohesion = 5e4;  // c / tan φ = 7.1e4 Pa < ft = 2e5 Pa
  Point<BrittleLaw> point(law);
  EXPECT_TRUE(point.to(7.0e4 / kn, 0.0).elastic);
  point.to(7.2e4 / kn, 0.0);
  EXPECT_TRUE(point.memory.broken);
}

JointLaw softening_law() {
  JointLaw law = bonded_law();
  law.kind = JointLaw::Kind::softening;
  law.residual_friction_angle = law.friction_angle;
  law.fracture_energy = {50.0, 200.0};  // J/m2
  return law;
}

TEST(SofteningLaw, DissipatesTheModeOneEnergy) {
  Point<SofteningLaw> point(softening_law());
  const double width = 2 * 50.0 / 2e5;  // wI = 2 GI / ft
  double peak = 0.0, work = 0.0, before = 0.0;
  const double step = width / 2000;
  for (int i = 1; i <= 3000; ++i) {
    const double sigma = kn * point.to(i * step, 0.0).n;
    work += 0.5 * (before + sigma) * step;
    before = sigma;
    peak = std::max(peak, sigma);
  }
  EXPECT_NEAR(peak, 2e5, 0.002 * 2e5);
  EXPECT_TRUE(point.memory.broken);
  EXPECT_NEAR(point.fracture, 50.0, 0.01 * 50.0);
  EXPECT_NEAR(work, 50.0, 0.01 * 50.0) << "area under the traction curve";
}

TEST(SofteningLaw, FollowsTheLineBetweenPeakAndZero) {
  Point<SofteningLaw> point(softening_law());
  const double width = 2 * 50.0 / 2e5;
  for (int i = 1; i <= 1000; ++i) {
    const double un = i * width / 1000;
    const PointResult r = point.to(un, 0.0);
    const double expected = un < 2e5 / kn ? kn * un : 2e5 * (1 - (un - 2e5 / kn) / (width - 2e5 / kn));
    if (i == 1000) break;  // at the very end the bond is gone
    EXPECT_NEAR(kn * r.n, expected, 1e-6 * 2e5) << i;
  }
}

TEST(SofteningLaw, DissipatesTheModeTwoEnergyBesideFriction) {
  Point<SofteningLaw> point(softening_law());
  const double un = -1e-3, width = 2 * 200.0 / 3e5, friction = 1e6 * std::tan(radians(35.0));
  const double step = width / 4000;
  double work = 0.0, before = 0.0, peak = 0.0;
  PointResult r;
  for (int i = 1; i <= 12000; ++i) {
    r = point.to(un, i * step);
    work += 0.5 * (before + ks * r.s) * step;
    before = ks * r.s;
    peak = std::max(peak, before);
  }
  EXPECT_NEAR(peak, 3e5 + friction, 1e-3 * peak);
  EXPECT_TRUE(point.memory.broken);
  EXPECT_NEAR(ks * r.s, friction, 1e-6 * friction) << "friction remains";
  EXPECT_NEAR(point.fracture, 200.0, 0.01 * 200.0);
  const double stored = 0.5 * ks * r.s * r.s;
  EXPECT_NEAR(point.fracture + point.friction + stored, work, 2e-3 * work);
}

TEST(SofteningLaw, UnloadsElasticallyAndComesBackToTheLine) {
  Point<SofteningLaw> point(softening_law());
  const double width = 2 * 50.0 / 2e5, step = width / 1000;
  double un = 0.0, n = 0.0;
  for (int i = 0; i < 500; ++i) un += step, n = point.to(un, 0.0).n;
  const double dissipated = point.fracture, softened = point.memory.softening;
  EXPECT_GT(softened, 0.1);
  EXPECT_LT(softened, 0.9);
  const PointResult back = point.to(un - 0.5 * n, 0.0);
  EXPECT_TRUE(back.elastic);
  EXPECT_NEAR(back.n, 0.5 * n, 1e-15);
  EXPECT_NEAR(point.to(un, 0.0).n, n, 1e-15);
  EXPECT_NEAR(point.fracture, dissipated, 1e-9 * dissipated);
  for (int i = 0; i < 1000; ++i) point.to(un += step, 0.0);
  EXPECT_TRUE(point.memory.broken);
  EXPECT_NEAR(point.fracture, 50.0, 0.01 * 50.0);
}

TEST(SofteningLaw, TooSteepABranchIsBrittle) {
  JointLaw law = softening_law();
  law.fracture_energy = {5.0, 200.0};  // wI = 5e-5 m < ft/kn = 2e-4 m
  Point<SofteningLaw> point(law);
  EXPECT_TRUE(point.to(1.99e5 / kn, 0.0).elastic);
  EXPECT_EQ(point.to(2.01e5 / kn, 0.0).n, 0.0);
  EXPECT_TRUE(point.memory.broken);
}

TEST(SofteningLaw, StaysFiniteWhereTheConeEndsBelowTheTensionLimit) {
  JointLaw law = softening_law();
  law.cohesion = 5e4;  // c / tan φ = 7.1e4 Pa < ft = 2e5 Pa: pure tension meets the cone's tip
  Point<SofteningLaw> point(law);
  for (int i = 1; i <= 400; ++i) {
    const PointResult r = point.to(i * 1e3 / kn, 0.0);
    ASSERT_TRUE(std::isfinite(r.n) && std::isfinite(r.s) && std::isfinite(r.t)) << "at sigma = " << i << " kPa";
    ASSERT_TRUE(std::isfinite(point.memory.s) && std::isfinite(point.fracture)) << "at sigma = " << i << " kPa";
    EXPECT_GE(point.fracture, 0.0);
  }
}

TEST(SofteningLaw, ShearNeverTurnsAgainstTheSlip) {
  // Tension and shear together near the tip of a cone that softening has shrunk.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int repeat = 0; repeat < 200; ++repeat) {
    JointLaw law = softening_law();
    law.cohesion = (0.5 + 2 * unit(random)) * 2e5 * std::tan(law.friction_angle);
    Point<SofteningLaw> point(law);
    const double slope = 3 * unit(random);
    for (int i = 1; i <= 500; ++i) {
      const PointResult r = point.to(1e-6 * i, slope * 1e-6 * i);
      ASSERT_TRUE(std::isfinite(r.s));
      ASSERT_GE(r.s, -1e-15) << "cohesion " << law.cohesion << ", us = " << slope << " un, step " << i;
    }
  }
}

TEST(ElasticLaw, HasNoLimit) {
  Point<ElasticLaw> point(elastic_law());
  const PointResult r = point.to(1.0, 2.0, 3.0);
  EXPECT_TRUE(r.elastic);
  EXPECT_EQ(r.n, 1.0);
  EXPECT_EQ(r.s, 2.0);
  EXPECT_EQ(r.t, 3.0);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
