// Stiffness and mass of assemblies against closed forms and against the explicit forces.
#include "solver/motion/pulse.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace {

/// Frequencies (Hz) of the modes in which more than 99 % of the kinetic energy is along `axis`.
std::vector<double> frequencies(const Bench& bench, int axis) {
  const DenseSystem system = dense_system(bench);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(system.k, system.m);
  std::vector<double> found;
  for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) {
    const Eigen::VectorXd phi = solver.eigenvectors().col(i);
    double share = 0.0;
    for (Eigen::Index at = axis; at < phi.size(); at += 6) share += phi[at] * phi[at] * system.m(at, at);
    if (share > 0.99) found.push_back(std::sqrt(solver.eigenvalues()[i]) / (2 * pi));
  }
  return found;
}

/// Validation ladder A: N = 10, h = 0.4 m, ρ = 2000, kn = 4e9; ω_j = 2 √(k/m) sin((2j − 1) π/(2 (2N + 1))).
TEST(Modes, OfAnAxialChain) {
  const Bench bench(generated("column", {{"blocks", 10}, {"block_height", 0.4}, {"kn", 4e9}, {"ks", 1.6e9}}));
  const std::vector<double> f = frequencies(bench, 2);
  ASSERT_EQ(f.size(), 10u);
  const double published[3] = {53.190, 158.382, 260.036};
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(f[std::size_t(j)], published[j], 1e-3 * published[j]);
    measured("Axial chain of 10 blocks: mode " + std::to_string(j + 1), published[j], f[std::size_t(j)], "Hz");
  }
  for (int j = 0; j < 10; ++j) {
    const double exact = std::sqrt(4e9 / 800.0) / pi * std::sin((2 * j + 1) * pi / 42);
    EXPECT_NEAR(f[std::size_t(j)], exact, 1e-9 * exact);
  }
}

/// Validation ladder A: width 1, height 8, ρ = 2000, kn h = 1.6e9, ks h = 0.64e9 Pa.
TEST(Modes, OfABendingCantilever) {
  const std::map<int, double> published = {{10, 2.0325}, {20, 2.1287}, {40, 2.1802}};
  for (const auto& [n, expected] : published) {
    const double h = 8.0 / n;
    const Bench bench(generated("column", {{"blocks", n}, {"block_height", h}, {"kn", 1.6e9 / h}, {"ks", 0.64e9 / h}}));
    const DenseSystem system = dense_system(bench);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(system.k, system.m, Eigen::EigenvaluesOnly);
    const double got = std::sqrt(solver.eigenvalues()[0]) / (2 * pi);
    EXPECT_NEAR(got, expected, 0.005 * expected) << n;
    measured("Bending column, N = " + std::to_string(n) + ": mode 1", expected, got, "Hz");
    EXPECT_NEAR(solver.eigenvalues()[1], solver.eigenvalues()[0], 1e-9 * solver.eigenvalues()[0]) << "square section";
  }
}

/// A long wave runs along a chain at h √(k/m) = 894.43 m/s.
TEST(Modes, LongWaveArrivesInTime) {
  Bench bench(generated("column", {{"blocks", 400}, {"block_height", 0.4}, {"kn", 4e9}, {"ks", 1.6e9}}));
  GroundMotion push;  // the base moves up by a smooth step of 40 ms, 36 m of wave
  push.dt = 1e-4;
  for (int i = 0; i <= 400; ++i) push.acceleration.emplace_back(0, 0, std::sin(2 * pi * i / 400.0));
  bench.begin();
  bench.stepper.motion = &push;
  const std::int64_t low = 100, high = 300;
  double peak[2] = {0, 0}, when[2] = {0, 0};
  ASSERT_TRUE(bench.run(std::int64_t(0.19 / bench.stepper.dt), 1, [&](const BodyPass&) {
    for (int i : {0, 1}) {
      const double v = bench.velocity(i == 0 ? low : high).z();
      if (v > peak[i]) peak[i] = v, when[i] = bench.state.time();
    }
  }));
  const double speed = (high - low) * 0.4 / (when[1] - when[0]);
  EXPECT_NEAR(speed, 894.43, 0.01 * 894.43);
  measured("Axial chain of 400 blocks: long wave", 894.43, speed, "m/s");
}

/// A bonded pile of odd blocks.
Assembly odd_pile(bool fixed) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, 0}, {2, 1, 0.5}, fixed);
  add_box(assembly, {0.1, 0, 0.5}, {0.9, 1, 1.2});
  add_box(assembly, {0.9, 0, 0.5}, {1.8, 1, 1.2});
  add_box(assembly, {0.3, 0.2, 1.2}, {1.5, 0.8, 1.6});
  return joined(std::move(assembly), 2e9, 7e8, elastic_law());
}

/// Explicit out-of-balance forces of a small motion from a displaced placement are −K u there.
TEST(Stiffness, IsTheExplicitForceOfASmallMotion) {
  std::mt19937 random(31);
  for (bool shortcut : {true, false}) {
    SolverSettings settings = undamped();
    settings.step.intact_shortcut = shortcut;
    Bench bench(odd_pile(true), settings);
    const Eigen::MatrixXd k = dense_system(bench).k;
    const Unknowns unknowns = number_unknowns(bench.model);
    for (int repeat = 0; repeat < 5; ++repeat) {
      Eigen::VectorXd u = Eigen::VectorXd::Zero(unknowns.count), f = u;
      for (std::size_t i = 0; i < bench.model.bodies.size(); ++i) {
        const std::int32_t at = unknowns.of_body[i];
        if (at < 0) continue;
        const Vec3 move = random_vector(1e-9, random), turn = random_vector(1e-9, random);
        u.segment<3>(at) = move, u.segment<3>(at + 3) = turn;
        double* p = &bench.state.pose[pose_width * i];
        for (int c = 0; c < 3; ++c) p[c] = move[c], p[4 + c] = 0.5 * turn[c];
      }
      bench.stepper.patches_only();
      const BodyPass pass = bench.stepper.body_pass();
      for (std::size_t i = 0; i < bench.model.bodies.size(); ++i) {
        const std::int32_t at = unknowns.of_body[i];
        if (at < 0) continue;
        const BodyUpdate b = pass.update(i);
        f.segment<6>(at) << b.force.x, b.force.y, b.force.z, b.moment.x, b.moment.y, b.moment.z;
      }
      EXPECT_LT((f + k * u).norm(), 1e-8 * f.norm());
    }
  }
}

TEST(Stiffness, OfAFixedPileIsPositive) {
  const Bench bench(odd_pile(true));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense_system(bench).k, Eigen::EigenvaluesOnly);
  EXPECT_GT(solver.eigenvalues()[0], 1e-6 * solver.eigenvalues().maxCoeff());
}

TEST(Stiffness, OfAFreePileHasSixZeroModes) {
  Bench bench(odd_pile(false));
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  for (std::int64_t block = 0; block < 4; ++block) bench.turn_about(block, Vec3(1, 1, 1), q);  // at any placement
  const DenseSystem system = dense_system(bench);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(system.k, system.m, Eigen::EigenvaluesOnly);
  const double highest = solver.eigenvalues().maxCoeff();
  for (int i = 0; i < 6; ++i) EXPECT_LT(std::abs(solver.eigenvalues()[i]), 1e-9 * highest) << i;
  EXPECT_GT(solver.eigenvalues()[6], 1e-5 * highest);
}

/// Where all points stick, the present tangent is the intact stiffness; open points give nothing.
TEST(Stiffness, PresentTangentFollowsTheState) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  SolverSettings settings = undamped({0, 0, -9.81});
  settings.step.intact_shortcut = false;
  Bench bench(joined(std::move(assembly), 1e9, 4e8, dry_law(0.6)), settings);
  ASSERT_TRUE(bench.balance().converged);
  bench.stepper.patches_only();
  const auto present = patch_stiffness(bench.model, bench.state, 0, PatchTangent::present);
  const auto intact = patch_stiffness(bench.model, bench.state, 0, PatchTangent::intact);
  EXPECT_LT((present - intact).norm(), 1e-12 * intact.norm());
  bench.place(1, {0, 0, 0.01}, Eigen::Quaterniond::Identity());
  bench.stepper.patches_only();
  EXPECT_EQ(patch_stiffness(bench.model, bench.state, 0, PatchTangent::present).norm(), 0.0);
}

}  // namespace
}  // namespace voussoir::test
