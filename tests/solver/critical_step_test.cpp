// The critical step against closed forms.
#include "solver/step/critical_step.h"

#include "solver/base/error.h"
#include "solver/linear/dense_eigen.h"
#include "solver/run/step_report.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

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

/// The iteration stops early; the safety factor of 0.8 must cover what it misses.
TEST(CriticalStep, OfAWallIsThatOfTheDenseEigenvalue) {
  const Bench bench(generated("wall", {{"length_blocks", 5}, {"courses", 6}}));
  const DenseSystem system = dense_system(bench);
  const double omega = std::sqrt(eigenvalues(system.k, system.m).maxCoeff());
  const CriticalStep critical = critical_step(bench.model, bench.state);
  EXPECT_NEAR(critical.highest, omega, 1e-3 * omega);
  EXPECT_LE(critical.highest, omega * (1 + 1e-9)) << "the quotient comes from below";
}

/// Along z alone, where a guide leaves it free; sway and rocking would be faster.
TEST(CriticalStep, OfWhatAGuideLeavesFree) {
  Bench bench(block_on_joint(1e7, 1e9));
  Body& block = bench.model.bodies[std::size_t(bench.body(1))];
  block.fixed = true, block.free_ways = 1 << 2;
  const double omega = std::sqrt(1e7 / 2000.0);
  EXPECT_NEAR(critical_step(bench.model, bench.state).highest, omega, 1e-6 * omega);
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

Eigen::VectorXd dense_eigenvalues(const Bench& bench) {
  const DenseSystem system = dense_system(bench);
  return eigenvalues(system.k, system.m);
}

double largest_bound(const Bench& bench) {
  double largest = 0.0;
  for (const LocalRate& rate : local_rates(bench.model, bench.state)) largest = std::max(largest, rate.bound);
  return largest;
}

/// Blocks of 1 × 1 m on a fixed one: 1 m, then 0.1 m, then 1 m high; 2000, 200 and 2000 kg.
Assembly light_between_heavy() {
  Assembly assembly = stone(2000.0);
  add_box(assembly, {0, 0, -1}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  add_box(assembly, {0, 0, 1}, {1, 1, 1.1});
  add_box(assembly, {0, 0, 1.1}, {1, 1, 2.1});
  return joined(std::move(assembly), 1e9, 1e5, elastic_law());
}

/// An inner block of a chain has own rate 2 k/m and, with equal neighbours, the bound 4 k/m, which is the rate of an
/// endless chain; beside an end the weights are 1 (fixed) or the ratio of the own rates.
TEST(LocalRates, OfAChain) {
  const Bench bench(generated("column", {{"blocks", 6}, {"kn", 4e9}, {"ks", 1e5}}));
  const std::vector<LocalRate> rates = local_rates(bench.model, bench.state);
  const double one = 4e9 / 800.0;
  std::vector<double> own, bound;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (bench.model.bodies[i].fixed) {
      EXPECT_EQ(rates[i].bound, 0.0);
      continue;
    }
    EXPECT_NEAR(rates[i].displacement, rates[i].own, 1e-3 * one);
    own.push_back(rates[i].own / one), bound.push_back(rates[i].bound / one);
  }
  std::sort(own.begin(), own.end());
  std::sort(bound.begin(), bound.end());
  const std::vector<double> expected_own = {1, 2, 2, 2, 2, 2}, expected_bound = {3, 3, 3.5, 4, 4, 4};
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_NEAR(own[i], expected_own[i], 1e-3);
    EXPECT_NEAR(bound[i], expected_bound[i], 1e-3);
  }
}

/// Two free masses on one spring: 1/m_a + 1/m_b times k, exactly.
TEST(LocalRates, OfTwoFreeBlocksAreExact) {
  Assembly assembly = stone(2000.0);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  add_box(assembly, {0, 0, 1}, {1, 1, 1.1});
  add_box(assembly, {5, 0, 0}, {6, 1, 1}, true);
  const Bench bench(joined(std::move(assembly), 1e9, 1e5, elastic_law()));
  const double exact = 1e9 * (1 / 2000.0 + 1 / 200.0);
  EXPECT_NEAR(largest_bound(bench), exact, 1e-3 * exact);
  EXPECT_NEAR(dense_eigenvalues(bench).maxCoeff(), exact, 1e-3 * exact);
}

TEST(LocalRates, BoundTheDenseEigenvalue) {
  for (const Assembly& assembly :
       {generated("wall", {{"length_blocks", 4}, {"courses", 4}}), light_between_heavy(), generated("arch", {})}) {
    const Bench bench(assembly);
    const double highest = dense_eigenvalues(bench).maxCoeff(), bound = largest_bound(bench);
    EXPECT_GE(bound, highest * (1 - 1e-9));
    EXPECT_LE(bound, 1.7 * highest) << "of no use";
  }
}

/// With the light block held, the lower heavy one hangs between two springs: ω² = 2 k/m.
TEST(StepReport, NamesTheLightBlock) {
  const Bench bench(light_between_heavy());
  const StepReport report = report_step(bench.model, bench.state, 2);
  ASSERT_EQ(report.stiffest.size(), 2u);
  EXPECT_EQ(report.critical.body, bench.body(2));
  EXPECT_EQ(report.stiffest[0].body, bench.body(2));
  EXPECT_NEAR(report.stiffest[0].step, 2 / std::sqrt(1.075e7), 2e-6);  // k/m (1 + 0.1 + 1 + 0.05)
  EXPECT_LE(report.stiffest[0].step, report.critical.step);
  EXPECT_NEAR(report.stiffest[0].without, 2 / std::sqrt(1e6), 1e-3 * 2e-3);
  EXPECT_LT(report.stiffest[1].without, 1.1 * report.critical.step);
  EXPECT_NEAR(least_thickness(bench.model, bench.body(2)), 0.1, 1e-12);
  ASSERT_EQ(report.raised.size(), 1u);  // of three bodies: the stiffest, to the rate of the next
  EXPECT_GT(report.raised[0].step, 2 * report.critical.step);
  EXPECT_NE(describe_stiff_body(bench.assembly, bench.model, bench.body(2)).find("200 kg"), std::string::npos);
}

double added_share(const Bench& bench) {
  double added = 0.0, total = 0.0;
  for (const Body& body : bench.model.bodies) {
    if (body.fixed) continue;
    added += body.inertial_mass - body.mass;
    total += body.mass;
    EXPECT_LT((body.inertia * body.inverse_inertia - Mat3::Identity()).norm(), 1e-12);
  }
  return added / total;
}

TEST(MassScaling, ReachesItsStepAndKeepsTheWeight) {
  for (double gain : {1.02, 1.5, 4.0}) {
    Bench bench(generated("column", {{"blocks", 10}, {"kn", 4e9}, {"ks", 1.6e9}}));
    const double before = critical_step(bench.model, bench.state).step;
    const MassScaling scaling = scale_mass(bench.model, bench.state, gain * before, 100.0);
    const double after = critical_step(bench.model, bench.state).step;
    EXPECT_GE(after, gain * before);
    EXPECT_LE(after, 1.006 * gain * before);
    for (const Body& body : bench.model.bodies) EXPECT_TRUE(body.fixed || std::abs(body.mass - 800.0) < 1e-9);
    EXPECT_NEAR(scaling.share, added_share(bench), 1e-12);
    EXPECT_GT(scaling.bodies, 0);
  }
}

/// What the light block is given makes the chain k (2 −1 0; −1 2 −1; 0 −1 1) as slow as wanted; its neighbours keep
/// what they have.
TEST(MassScaling, RaisesOnlyTheBlockThatNeedsIt) {
  Bench bench(light_between_heavy());
  const double wanted = 2 * critical_step(bench.model, bench.state).step;
  const MassScaling scaling = scale_mass(bench.model, bench.state, wanted, 1.0);
  EXPECT_EQ(scaling.bodies, 1);
  const auto inertial = [&](int block) { return bench.model.bodies[std::size_t(bench.body(block))].inertial_mass; };
  EXPECT_NEAR(inertial(1), 2000.0, 1e-9);
  EXPECT_NEAR(inertial(2), 200.0 * scaling.largest, 1e-9);
  EXPECT_NEAR(inertial(3), 2000.0, 1e-9);
  Mat3 k;
  k << 2, -1, 0, -1, 2, -1, 0, -1, 1;
  const Mat3 m = Vec3(inertial(1), inertial(2), inertial(3)).asDiagonal();
  const double rate = 1e9 * largest_eigenvalue(k, m);
  EXPECT_NEAR(2 / std::sqrt(rate), wanted, 0.006 * wanted);
}

TEST(MassScaling, WithoutAStepUsesItsLimitUp) {
  double last = 0.0;
  for (double limit : {1e-4, 1e-2, 0.3}) {
    Bench bench(light_between_heavy());
    const MassScaling scaling = scale_mass(bench.model, bench.state, 0.0, limit);
    EXPECT_LE(scaling.share, limit);
    EXPECT_GE(scaling.share, 0.99 * limit);
    EXPECT_NEAR(scaling.share, added_share(bench), 1e-12);
    const double step = critical_step(bench.model, bench.state).step;
    EXPECT_GT(step, last);
    last = step;
  }
}

TEST(MassScaling, DoesNothingWhenTheStepIsThere) {
  Bench bench(light_between_heavy());
  const double before = critical_step(bench.model, bench.state).step;
  EXPECT_FALSE(scale_mass(bench.model, bench.state, 0.9 * before, 0.1).at_work());
  EXPECT_EQ(added_share(bench), 0.0);
}

TEST(MassScaling, BoundsTheShiftOfTheFrequencies) {
  Bench bench(generated("wall", {{"length_blocks", 4}, {"courses", 5}}));
  const Eigen::VectorXd before = dense_eigenvalues(bench);
  const MassScaling scaling = scale_mass(bench.model, bench.state, 0.0, 0.05);
  const Eigen::VectorXd after = dense_eigenvalues(bench);
  const std::vector<double> shifts = frequency_shifts(bench.model, bench.state, scaling, 6);
  ASSERT_EQ(shifts.size(), 6u);
  for (int i = 0; i < 6; ++i) {
    const double shift = 1.0 - std::sqrt(after[i] / before[i]);
    EXPECT_GE(shift, -1e-9);
    EXPECT_LE(shift, shifts[std::size_t(i)] + 1e-9);
  }
  EXPECT_NEAR(1.0 - std::sqrt(after[0] / before[0]), shifts[0], 0.1 * shifts[0]);
}

TEST(MassScaling, RefusesToPassItsLimit) {
  Bench bench(generated("column", {{"blocks", 10}, {"kn", 4e9}, {"ks", 1.6e9}}));
  EXPECT_THROW(scale_mass(bench.model, bench.state, 1.0, 0.05), InputError);
  EXPECT_EQ(added_share(bench), 0.0);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
