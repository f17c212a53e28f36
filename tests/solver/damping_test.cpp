// The damping models apart from any structure (the design table: tools/ladder/maxwell_fit.cpp).
#include "solver/step/damping.h"

#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// One branch by hand: k(iω) = 1 + α x/(1 + x), x = iω/ω1; at ω = ω1 it is 1 + α (1 + i)/2.
TEST(MaxwellFit, RatioOfOneBranchHasItsClosedForm) {
  const MaxwellFit fit{{0.1}, {3.0}, 0.0, 0.0};
  EXPECT_NEAR(maxwell_ratio(fit, 3.0), 0.5 * 0.05 / 1.05, 1e-15);
  EXPECT_NEAR(maxwell_stiffening(fit, 3.0), 1.05, 1e-15);
  EXPECT_NEAR(maxwell_stiffening(fit, 1e-6), 1.0, 1e-12);
  EXPECT_NEAR(maxwell_stiffening(fit, 1e6), 1.1, 1e-9);
}

TEST(MaxwellFit, IsFlatForOtherRatiosBandsAndBranches) {
  for (double ratio : {0.005, 0.02, 0.05})
    for (int branches : {3, 4}) {
      const MaxwellFit fit = fit_maxwell(ratio, {1.0, 20.0}, branches);
      EXPECT_GT(fit.lowest, 0.97 * ratio) << ratio << ", " << branches;
      EXPECT_LT(fit.highest, 1.03 * ratio) << ratio << ", " << branches;
    }
  for (int branches : {1, 2}) {
    const MaxwellFit fit = fit_maxwell(0.02, {2.0, 4.0}, branches);
    EXPECT_GT(fit.lowest, 0.9 * 0.02) << branches;
    EXPECT_LT(fit.highest, 1.1 * 0.02) << branches;
  }
}

TEST(StepFactor, IsOneWithoutDamping) {
  DampingSettings settings;
  settings.kind = DampingSettings::Kind::none;
  EXPECT_EQ(damping_step_factor(settings, 1e4), 1.0);
}

/// A force that slows a body down is raised by the coefficient: at worst the assembly is 1 + coefficient times as
/// stiff.
TEST(StepFactor, OfLocalDamping) {
  DampingSettings settings;
  settings.kind = DampingSettings::Kind::local;
  settings.coefficient = 0.8;
  EXPECT_NEAR(damping_step_factor(settings, 1e4), 1.0 / std::sqrt(1.8), 1e-12);
}

/// At high frequency all branches are stiff: ω rises by √(1 + Σα).
TEST(StepFactor, OfMaxwellIsTheHighFrequencyStiffening) {
  const DampingSettings settings;
  const double sum = 0.0611 + 0.0425 + 0.0689;
  EXPECT_NEAR(damping_step_factor(settings, 1e4), 1.0 / std::sqrt(1.0 + sum), 2e-3);
}

/// Damping matrix β K lagging by half a step: dt < 2/ω (√(1 + ξ²) − ξ), ξ = βω/2 (Belytschko 1983).
TEST(StepFactor, OfRayleigh) {
  DampingSettings settings;
  settings.kind = DampingSettings::Kind::rayleigh;
  const double w1 = 2 * pi * 0.5, w2 = 2 * pi * 12.0, beta = 2 * 0.02 / (w1 + w2), xi = 0.5 * beta * 5000.0;
  EXPECT_NEAR(damping_step_factor(settings, 5000.0), std::sqrt(1 + xi * xi) - xi, 1e-12);
}

/// A block on a spring, pushed along it: bounded just below the step that the factor promises.
double largest_after(const DampingSettings& damping, double share, int steps) {
  Assembly assembly = stone(2000.0);
  add_box(assembly, {0, 0, -1}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  SolverSettings settings = undamped();
  settings.damping = damping;
  settings.contact.search = false;
  settings.contact.reclip_slip = settings.contact.reclip_angle = 1e9;
  Bench bench(joined(std::move(assembly), 1e9, 1e7, elastic_law()), settings);
  const double omega = std::sqrt(1e9 / 2000.0);  // axial: the highest (see critical_step_test)
  bench.begin(share * 2.0 / omega * damping_step_factor(damping, omega));
  bench.place(1, {0, 0, 1e-6}, Eigen::Quaterniond::Identity());
  double largest = 0.0;
  for (int i = 0; i < steps; ++i) {
    if (!bench.run(1)) return 1e300;
    largest = std::max(largest, std::abs(bench.displacement(1).z()));
  }
  return largest;
}

TEST(StepFactor, KeepsAnOscillatorStable) {
  for (auto kind : {DampingSettings::Kind::none, DampingSettings::Kind::maxwell, DampingSettings::Kind::rayleigh}) {
    DampingSettings damping;
    damping.kind = kind;
    EXPECT_LT(largest_after(damping, 0.98, 4000), 1e-5) << int(kind);
  }
}

/// Dynamic relaxation runs with a coefficient of 0.8 at the default safety of 0.8.
TEST(StepFactor, KeepsDynamicRelaxationStable) {
  DampingSettings damping;
  damping.kind = DampingSettings::Kind::local;
  for (double coefficient : {0.1, 0.5, 0.8}) {
    damping.coefficient = coefficient;
    EXPECT_LT(largest_after(damping, 0.8, 4000), 1e-5) << coefficient;
  }
}

TEST(StepFactor, IsSharpForNoneAndRayleigh) {
  for (auto kind : {DampingSettings::Kind::none, DampingSettings::Kind::rayleigh}) {
    DampingSettings damping;
    damping.kind = kind;
    EXPECT_GT(largest_after(damping, 1.02, 2000), 1e-3) << int(kind);
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
