// The composite law at a single point, driven by displacement, against closed forms.
#include "solver/model/laws.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double kn = 1e10, ks = 4e9;                                                    // Pa/m
constexpr double ft = 2e5, c = 4e5, mode_1 = 50.0, mode_2 = 200.0;                       // Pa, J/m2
constexpr double tan_first = 0.75, tan_last = 0.6, fc = 9e6, peak = 9e-4, mode_c = 2e4;  // –, Pa, m, J/m2
constexpr double width_1 = mode_1 / ft, width_2 = mode_2 / c;                            // m

JointLaw composite_law() {
  JointLaw law;
  law.kind = JointLaw::Kind::composite;
  law.tension = ft, law.cohesion = c;
  law.friction_angle = std::atan(tan_first), law.residual_friction_angle = std::atan(tan_last);
  law.fracture_energy = {mode_1, mode_2};
  law.compressive_strength = fc, law.compressive_energy = mode_c, law.compressive_peak = peak;
  return law;
}

/// Without a cap, which the shear of the tests of friction would reach.
JointLaw without_cap() {
  JointLaw law = composite_law();
  law.compressive_strength = law.compressive_energy = law.compressive_peak = 0.0;
  return law;
}

/// A point under test, with a ledger of its own: work on its spring by the trapezoidal rule.
struct Point {
  explicit Point(const JointLaw& l) : law(law_constants(l)) {}
  PointResult to(double n, double s, double t = 0.0) {
    const PointResult r = CompositeLaw::update(law, kn, ks, n, s, t, memory);
    work += 0.5 * (kn * (r.n + last.n) * (n - un) + ks * (r.s + last.s) * (s - us) + ks * (r.t + last.t) * (t - ut));
    un = n, us = s, ut = t, last = r;
    friction += r.friction, fracture += r.fracture;
    least_loss = std::min({least_loss, r.friction, r.fracture});
    return r;
  }
  /// In so many equal steps.
  PointResult along(double n, double s, int steps) {
    const double n0 = un, s0 = us;
    PointResult r;
    for (int i = 1; i <= steps; ++i) r = to(n0 + (n - n0) * i / steps, s0 + (s - s0) * i / steps);
    return r;
  }
  double kept() const { return kept_stiffness(law, kn, memory.crushed); }
  double stored() const { return 0.5 / kept() * (kn * last.n * last.n + ks * (last.s * last.s + last.t * last.t)); }
  LawConstants law;
  PointMemory memory;
  PointResult last;
  double un = 0.0, us = 0.0, ut = 0.0, work = 0.0, friction = 0.0, fracture = 0.0, least_loss = 0.0;
};

TEST(Fading, IsTheExponentialToRounding) {
  for (int i = 0; i < 5000; ++i) {
    const double x = 0.01 * i * (1.0 + 1e-3 * (i % 7));
    EXPECT_NEAR(fading(x), std::exp(-x), 2e-16 * (2.0 + x) * std::exp(-x)) << x;
  }
  EXPECT_EQ(fading(0.0), 1.0);
  EXPECT_EQ(fading(1e4), 0.0);
}

TEST(CompositeLaw, IsASpringBelowItsLimits) {
  Point point(composite_law());
  const PointResult r = point.to(-0.3 * fc / kn, 1e-4, -2e-5);
  EXPECT_TRUE(r.elastic);
  EXPECT_DOUBLE_EQ(r.n, -0.3 * fc / kn);
  EXPECT_DOUBLE_EQ(r.s, 1e-4);
  EXPECT_DOUBLE_EQ(r.t, -2e-5);
  EXPECT_EQ(point.memory.crushed, 0.0);
  EXPECT_FALSE(point.to(-0.34 * fc / kn, 1e-4, -2e-5).elastic) << "a third of the strength";
}

TEST(CompositeLaw, SoftensExponentiallyInTension) {
  Point point(composite_law());
  for (int i = 1; i <= 4000; ++i) {
    const double un = 1e-6 * i;
    const PointResult r = point.to(un, 0.0);
    if (point.memory.broken) break;
    if (un <= ft / kn) continue;
    ASSERT_NEAR(kn * r.n, ft * std::exp(-(un - r.n) / width_1), 1e-9 * ft) << i;
  }
  EXPECT_TRUE(point.memory.broken);
  EXPECT_NEAR(point.fracture, mode_1, 1e-3 * mode_1);
  EXPECT_NEAR(point.work, mode_1, 1e-3 * mode_1) << "area under the traction curve";
  EXPECT_EQ(point.friction, 0.0);
}

TEST(CompositeLaw, SlipTakesCohesionAndFriction) {
  const double p = 1e6;
  Point point(without_cap());
  point.to(-p / kn, 0.0);
  const PointResult r = point.along(-p / kn, 0.02, 40000);
  EXPECT_TRUE(point.memory.broken);
  EXPECT_NEAR(ks * r.s, p * tan_last, 1e-9 * p) << "friction remains";
  EXPECT_NEAR(point.fracture, mode_2, 1e-3 * mode_2);
  const double rubbed = p * (tan_last * point.memory.s + (tan_first - tan_last) * width_2);
  EXPECT_NEAR(point.friction, rubbed, 1e-3 * rubbed);
  EXPECT_NEAR(point.work, point.stored() + point.friction + point.fracture, 1e-4 * point.work);
}

TEST(CompositeLaw, OpeningAndSlipSoftenTheSameBond) {
  Point point(without_cap());
  PointResult r = point.along(1.3 * width_1, 0.0, 20000);
  const double opened = (1.3 * width_1 - r.n) / width_1;
  EXPECT_NEAR(1.0 - point.memory.softening, std::exp(-opened), 1e-9);
  point.along(point.memory.n - 1e5 / kn, 0.0, 1000);
  r = point.along(point.un, 1.1 * width_2, 20000);
  const double bond = std::exp(-opened - point.memory.s / width_2);
  EXPECT_NEAR(1.0 - point.memory.softening, bond, 1e-9);
  EXPECT_NEAR(ks * r.s, c * bond + 1e5 * (tan_last + bond * (tan_first - tan_last)), 1e-6 * c);
}

/// ∫ strength over the inelastic jump, in closed form.
double area_under_cap(double k) {
  const double w = mode_c / ((67.0 / 75.0) * fc), tail = (k - peak - w) / w / 0.4;
  return fc * peak * 7.0 / 9.0 + fc * w * 5.0 / 6.0 + 0.1 * fc * (k - peak - w) +
         0.16 * fc * w * (1.0 - std::exp(-tail));
}

TEST(CompositeLaw, CrushesAlongItsCurve) {
  const double w = mode_c / ((67.0 / 75.0) * fc);
  const CrushingCurve curve(law_constants(composite_law()), kn);
  EXPECT_DOUBLE_EQ(curve.strength(0.0), fc / 3);
  EXPECT_DOUBLE_EQ(curve.strength(peak), fc);
  EXPECT_DOUBLE_EQ(curve.strength(peak + w), 0.5 * fc);
  EXPECT_NEAR(curve.strength(peak + 40 * w), 0.1 * fc, 1e-12 * fc);
  for (const double k : {0.3 * peak, peak + 0.5 * w, peak + 1.5 * w})
    EXPECT_NEAR(curve.slope(k), (curve.strength(k + 1e-8) - curve.strength(k - 1e-8)) / 2e-8, 1e-5 * fc / w) << k;
  Point point(composite_law());
  double most = 0.0;
  for (int i = 1; i <= 40000; ++i) {
    const PointResult r = point.to(-1e-6 * i, 0.0);
    const double p = -kn * r.n, crushed = 1e-6 * i - p / kn;
    most = std::max(most, p);
    if (crushed <= 1e-9) continue;
    EXPECT_NEAR(point.memory.crushed, crushed, 1e-12) << i;
    EXPECT_NEAR(p, curve.strength(crushed), 1e-9 * fc) << i;
    EXPECT_NEAR(point.memory.closure, 0.7 * crushed, 1e-12) << "seven tenths of it stay";
  }
  EXPECT_NEAR(most, fc, 1e-6 * fc);
}

TEST(CompositeLaw, DissipatesItsCompressiveEnergy) {
  Point point(composite_law());
  PointResult r = point.along(-0.06, 0.0, 60000);
  const double k = point.memory.crushed, p = -kn * r.n;
  const double lost = area_under_cap(k) - 0.5 * 0.3 * k * p;  // less what the softer spring still gives back
  EXPECT_NEAR(point.fracture, lost, 1e-4 * lost);
  const double beyond = lost - fc * peak * 7.0 / 9.0 - 0.1 * fc * (k - peak) + 0.5 * 0.3 * k * p;
  EXPECT_NEAR(beyond, mode_c, 1e-3 * mode_c);
  r = point.along(-point.memory.closure, 0.0, 100);
  EXPECT_NEAR(kn * r.n, 0.0, 1e-6);
  EXPECT_NEAR(point.work, lost, 1e-4 * lost);
}

TEST(CompositeLaw, UnloadsWithWhatIsLeftOfItsStiffness) {
  Point point(composite_law());
  point.along(-3e-3, 0.0, 3000);
  const double pressed = kn * point.last.n, kept = point.kept(), lost = point.fracture;
  EXPECT_LT(kept, 0.9);
  EXPECT_NEAR(kept, 1.0 / (1.0 + 0.3 * kn * point.memory.crushed / -pressed), 1e-12);
  const PointResult back = point.to(-2.8e-3, 0.0);
  EXPECT_TRUE(back.elastic);
  EXPECT_NEAR(kn * back.n - pressed, kept * kn * 2e-4, 1e-6 * fc);
  EXPECT_NEAR(ks * point.to(-2.8e-3, 1e-6).s, kept * ks * 1e-6, 1e-9 * fc) << "the shear spring has softened too";
  EXPECT_NEAR(kn * point.to(-3e-3, 0.0).n, pressed, 1e-9 * fc) << "back where it left the curve";
  EXPECT_NEAR(point.fracture, lost, 1e-9 * lost);
}

TEST(CompositeLaw, OpensAndClosesWhereItWasCrushedWithoutAKick) {
  Point point(composite_law());
  point.along(-3e-3, 0.0, 3000);
  const double closure = point.memory.closure;
  point.along(4e-3, 3e-3, 7000);
  ASSERT_TRUE(point.memory.broken);
  EXPECT_TRUE(point.last.open);
  EXPECT_EQ(point.memory.n, -closure);
  EXPECT_TRUE(point.to(-closure + 1e-9, 3e-3).open);
  const PointResult r = point.to(-closure - 1e-6, 3e-3 + 1e-8);
  EXPECT_NEAR(r.n, -point.kept() * 1e-6, 1e-15);
  EXPECT_NEAR(r.s, point.kept() * 1e-8, 1e-16);
}

TEST(CompositeLaw, AnEllipseBindsPressureAndShear) {
  JointLaw law = composite_law();
  law.cohesion = 9e6;  // friction is far away
  law.fracture_energy = {mode_1, 1e6};
  for (const double share : {0.2, 1.0, 3.0}) {
    Point point(law);
    for (int i = 1; i <= 4000; ++i) {
      const PointResult r = point.to(-1e-6 * i, share * 1e-6 * i);
      if (r.elastic) continue;
      const double p = -kn * r.n, t = ks * r.s, strength = CrushingCurve(point.law, kn).strength(point.memory.crushed);
      ASSERT_NEAR(std::sqrt(p * p + 9.0 * t * t), strength, 1e-8 * fc) << share << ", step " << i;
    }
    // Associated: plastic jumps go as (p, Css τ); over a path on which both grow alike, to some per cent.
    EXPECT_GT(point.memory.s, 0.0);
    EXPECT_NEAR(point.work, point.stored() + point.friction + point.fracture, 1e-3 * point.work);
  }
}

TEST(CompositeLaw, LargeStepsEndOnTheCap) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    Point point(composite_law());
    const PointResult r = point.to(-0.02 * unit(random), 0.02 * unit(random), -0.02 * unit(random));
    const double p = -kn * r.n, t = ks * std::hypot(r.s, r.t);
    const double strength = CrushingCurve(point.law, kn).strength(point.memory.crushed);
    EXPECT_LE(std::sqrt(p * p + 9.0 * t * t), strength * (1.0 + 1e-9));
    const double bond = 1.0 - point.memory.softening;
    EXPECT_LE(t, c * bond + p * (tan_last + bond * (tan_first - tan_last)) + 1e-4 * c);
    EXPECT_GE(r.s, 0.0);
    EXPECT_LE(r.t, 0.0);
  }
}

TEST(CompositeLaw, NeverGainsEnergyOnAnyPath) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  JointLaw law = composite_law();
  law.dilation_angle = std::atan(0.3), law.dilation_length = 1e-3, law.dilation_pressure = 3e6;
  for (int repeat = 0; repeat < 50; ++repeat) {
    Point point(law);
    for (int leg = 0; leg < 20; ++leg) {
      point.along(-1e-3 + 1.5e-3 * normal(random), 1e-3 * normal(random), 200);
      ASSERT_GE(point.least_loss, -1e-9) << repeat << ", leg " << leg;
      ASSERT_LE(point.memory.softening, 1.0);
    }
  }
}

TEST(CompositeLaw, BalancesOverACycle) {
  Point point(composite_law());
  const int steps = 400000;
  point.along(-1e-3, 0.0, steps);   // hardens
  point.along(-1e-3, 2e-3, steps);  // slides
  point.along(-2e-3, -2e-3, steps);
  point.along(1.5e-3, -2e-3, steps);  // opens
  point.along(-3e-3, -2e-3, steps);
  point.along(-3e-3, 0.0, steps);
  point.along(-0.5e-3, 0.0, steps);
  EXPECT_NEAR(point.work, point.stored() + point.friction + point.fracture, 1e-6 * point.work);
}

TEST(CompositeLaw, CoupletUnderReversalsEndsWhereItsDilationDoes) {
  JointLaw law = without_cap();
  const double p = 1e6, tan_dilation = 0.4, length = 5e-4, none_at = 4e6;
  law.dilation_angle = std::atan(tan_dilation), law.dilation_length = length, law.dilation_pressure = none_at;
  Point point(law);
  point.to(-p / kn, 0.0);
  double swept = 0.0, then = 0.0;
  for (int cycle = 0; cycle < 4; ++cycle)
    for (const double end : {1e-3, -1e-3, 0.0}) {
      const double from = point.us;
      for (int i = 1; i <= 4000; ++i) {
        point.to(point.memory.n - p / kn, from + (end - from) * i / 4000);
        swept += std::abs(point.memory.s - then), then = point.memory.s;
      }
    }
  EXPECT_TRUE(point.memory.broken);
  EXPECT_NEAR(point.memory.slip, swept, 1e-12);
  const double lifted = tan_dilation * (1.0 - p / none_at) * length * (1.0 - std::exp(-swept / length));
  EXPECT_NEAR(point.memory.n, lifted, 2e-3 * lifted);
  EXPECT_NEAR(ks * point.last.s, p * tan_last, 1e-3 * p);
  EXPECT_NEAR(point.fracture, mode_2, 1e-3 * mode_2);
}

TEST(CompositeLaw, WithoutEnergiesAndCapIsTheBrittleLaw) {
  JointLaw law = composite_law();
  law.residual_cohesion = 3e4;
  law.fracture_energy = {1e-9, 1e-9};
  law.compressive_strength = 1e13, law.compressive_energy = 1e16;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int repeat = 0; repeat < 200; ++repeat) {
    Point point(law);
    PointMemory brittle;
    double n = 0.0, s = 0.0, t = 0.0;
    for (int i = 0; i < 300; ++i) {
      n += 5e-6 * normal(random), s += 2e-5 * normal(random), t += 2e-5 * normal(random);
      const PointResult r = point.to(n, s, t), b = BrittleLaw::update(point.law, kn, ks, n, s, t, brittle);
      ASSERT_EQ(point.memory.broken, brittle.broken);
      ASSERT_EQ(r.open, b.open);
      for (const auto& [one, other] : {std::pair{r.n, b.n}, {r.s, b.s}, {r.t, b.t}}) ASSERT_NEAR(one, other, 1e-16);
    }
  }
}

TEST(CompositeLaw, TheLeastEnergyKeepsCrushingStable) {
  JointLaw law = composite_law();
  law.compressive_energy = 1.0001 * least_compressive_energy(law, kn, ks);
  const CrushingCurve curve(law_constants(law), kn);
  double steepest = 0.0;
  for (int i = 0; i < 10000; ++i) steepest = std::max(steepest, -curve.slope(1e-6 * i));
  EXPECT_LT(steepest, kn);
  Point point(law);
  double before = 0.0;
  for (int i = 1; i <= 20000; ++i) {
    const double p = -kn * point.to(-2e-7 * i, 0.0).n;
    ASSERT_GT(p, before - 1.4 * kn * 2e-7) << "0.58 kn over 1 - 0.58 at most: no drop within a step";
    before = p;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
