// The critical step against closed forms.
#include "solver/step/critical_step.h"

#include "tests/solver/models.h"

namespace voussoir::test {
namespace {

/// A block of side 1 m on a fixed one.
Assembly block_on_joint(double kn, double ks) {
  Assembly assembly = stone(2000.0);
  add_box(assembly, {0, 0, -1}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  return joined(std::move(assembly), kn, ks, elastic_law());
}

/// ω² = kn A/m where translation along the normal is the highest mode (rocking has kn/(2 m) when ks is small).
TEST(CriticalStep, OfOneBlockAlongTheNormal) {
  const Bench bench(block_on_joint(1e9, 1e7));
  const double omega = std::sqrt(1e9 / 2000.0);
  const CriticalStep critical = critical_step(bench.model, bench.state);
  EXPECT_NEAR(critical.highest, omega, 1e-3 * omega);
  EXPECT_NEAR(critical.step, 2.0 / omega, 1e-3 * critical.step);
  EXPECT_EQ(critical.body, bench.body(1));
  EXPECT_EQ(critical.patch, 0);
}

/// Sway and rocking of a cube together: K = [ks A, ks A h/2; ks A h/2, ks A h²/4 + kn I], M = diag(m, m/6).
TEST(CriticalStep, OfOneBlockThatRocks) {
  const double kn = 1e9, ks = 1e9, m = 2000.0, a = ks / m, d = (ks / 4 + kn / 12) / (m / 6),
               c2 = (ks / 2) * (ks / 2) / (m * m / 6);
  const double omega = std::sqrt(0.5 * (a + d) + std::sqrt(0.25 * (a - d) * (a - d) + c2));
  const Bench bench(block_on_joint(kn, ks));
  EXPECT_NEAR(critical_step(bench.model, bench.state).highest, omega, 2e-3 * omega);
}

/// N equal blocks on a fixed one: ω_N = 2 √(k/m) sin((2N − 1) π/(2 (2N + 1))) (Rayleigh 1894, section 120).
TEST(CriticalStep, OfAChainAlongItsAxis) {
  for (int n : {2, 10, 100}) {
    const Bench bench(generated("column", {{"blocks", n}, {"kn", 4e9}, {"ks", 1e7}}));
    const double omega = 2 * std::sqrt(4e9 / 800.0) * std::sin((2 * n - 1) * pi / (2 * (2 * n + 1)));
    EXPECT_NEAR(critical_step(bench.model, bench.state).highest, omega, 0.01 * omega) << n;
  }
}

/// The power iteration stops early; the safety factor of 0.8 must cover what it misses.
TEST(CriticalStep, OfAWallIsWithinTwoPercentOfTheDenseEigenvalue) {
  const Bench bench(generated("wall", {{"length_blocks", 5}, {"courses", 6}}));
  const DenseSystem system = dense_system(bench);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(system.k, system.m, Eigen::EigenvaluesOnly);
  const double omega = std::sqrt(solver.eigenvalues().maxCoeff());
  const CriticalStep critical = critical_step(bench.model, bench.state);
  EXPECT_NEAR(critical.highest, omega, 0.02 * omega);
  EXPECT_LE(critical.highest, omega * (1 + 1e-9)) << "the quotient comes from below";
}

TEST(CriticalStep, NamesTheStiffJoint) {
  Assembly assembly = generated("column", {{"blocks", 6}, {"kn", 1e9}, {"ks", 4e8}});
  std::size_t stiff = 0;
  for (std::size_t i = 0; i < assembly.joints.size(); ++i)
    if (std::minmax(assembly.joints[i].a, assembly.joints[i].b) == std::minmax<std::int64_t>(2, 3)) stiff = i;
  assembly.joints[stiff].kn *= 50, assembly.joints[stiff].ks *= 50;
  const Bench bench(std::move(assembly));
  const CriticalStep critical = critical_step(bench.model, bench.state);
  EXPECT_EQ(bench.model.joint_of_patch[critical.patch], std::int64_t(stiff));
}

TEST(CriticalStep, WithoutJointsThereIsNone) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  const Bench bench(joined(std::move(assembly), 1e9, 1e9, elastic_law()));
  const CriticalStep critical = critical_step(bench.model, bench.state);
  EXPECT_EQ(critical.highest, 0.0);
  EXPECT_EQ(critical.body, -1);
}

TEST(MassScaling, ReachesItsStepAndKeepsTheWeight) {
  Bench bench(generated("column", {{"blocks", 10}, {"kn", 4e9}, {"ks", 1.6e9}}));
  const double before = critical_step(bench.model, bench.state).step;
  const MassScaling scaling = scale_mass(bench.model, bench.state, 1.5 * before, 10.0);
  EXPECT_GE(critical_step(bench.model, bench.state).step, 1.5 * before);
  double added = 0.0, total = 0.0;
  for (const Body& body : bench.model.bodies) {
    if (body.fixed) continue;
    EXPECT_NEAR(body.mass, 800.0, 1e-9);
    added += body.inertial_mass - body.mass;
    total += body.mass;
    EXPECT_LT((body.inertia * body.inverse_inertia - Mat3::Identity()).norm(), 1e-12);
  }
  EXPECT_NEAR(scaling.share, added / total, 1e-12);
  EXPECT_GT(scaling.bodies, 0);
}

TEST(MassScaling, RefusesToPassItsLimit) {
  Bench bench(generated("column", {{"blocks", 10}, {"kn", 4e9}, {"ks", 1.6e9}}));
  EXPECT_ANY_THROW(scale_mass(bench.model, bench.state, 1.0, 0.05));
}

}  // namespace
}  // namespace voussoir::test
