// Stiffness and mass of assemblies against the explicit forces (closed forms: tools/ladder).
#include "solver/linear/dense_eigen.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

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
        if (!unknowns.any(i)) continue;
        const Vec3 move = random_vector(1e-9, random), turn = random_vector(1e-9, random);
        set_part(u, unknowns, i, (Vector6() << move, turn).finished());
        double* p = &bench.state.pose[pose_width * i];
        for (int c = 0; c < 3; ++c) p[c] = move[c], p[4 + c] = 0.5 * turn[c];
      }
      bench.stepper.patches_only();
      const BodyPass pass = bench.stepper.body_pass();
      for (std::size_t i = 0; i < bench.model.bodies.size(); ++i) {
        const BodyUpdate b = pass.update(i);
        Vector6 force;
        force << b.force.x, b.force.y, b.force.z, b.moment.x, b.moment.y, b.moment.z;
        set_part(f, unknowns, i, force);
      }
      EXPECT_LT((f + k * u).norm(), 1e-8 * f.norm());
    }
  }
}

/// Symmetric and positive semi-definite as it is summed, over a whole bridge; held pairs included.
TEST(Stiffness, OfABridgeIsSymmetricAndPositive) {
  const Bench bench(generated("cs2", {{"block_scale", 4.0}}));
  const BlockMatrix k = stiffness_blocks(bench.model, bench.state, PatchTangent::intact);
  std::int64_t coupled = 0;
  k.for_each([&](std::int32_t row, std::int32_t column, const Matrix6& block) {
    coupled += row != column;
    if (row == column) {
      EXPECT_LT((block - block.transpose()).norm(), 1e-12 * block.norm()) << row;
    }
  });
  EXPECT_GT(coupled, 500);
  const Eigen::MatrixXd lower = k.over(number_unknowns(bench.model));
  EXPECT_GT(eigenvalues(lower)[0], 0.0);  // reads the lower half
}

TEST(Stiffness, OfAFixedPileIsPositive) {
  const Bench bench(odd_pile(true));
  const Eigen::VectorXd values = eigenvalues(dense_system(bench).k);
  EXPECT_GT(values[0], 1e-6 * values.maxCoeff());
}

TEST(Stiffness, OfAFreePileHasSixZeroModes) {
  Bench bench(odd_pile(false));
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  for (std::int64_t block = 0; block < 4; ++block) bench.turn_about(block, Vec3(1, 1, 1), q);  // at any placement
  const DenseSystem system = dense_system(bench);
  const Eigen::VectorXd values = eigenvalues(system.k, system.m);
  const double highest = values.maxCoeff();
  for (int i = 0; i < 6; ++i) EXPECT_LT(std::abs(values[i]), 1e-9 * highest) << i;
  EXPECT_GT(values[6], 1e-5 * highest);
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

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
