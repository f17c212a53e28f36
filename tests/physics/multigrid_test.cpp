// Multigrid for tangents of large assemblies, against factors and a hand solution.
#include "solver/linear/multigrid.h"

#include "solver/linear/factor.h"
#include "solver/linear/stiffness.h"
#include "solver/statics/equilibrium.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double g = 9.81;

Assembly wall(int length, int courses) {
  return generated("wall", {{"length_blocks", double(length)}, {"courses", double(courses)}});
}

std::vector<Vec3> places_of(const Model& model) {
  std::vector<Vec3> places;
  for (const Body& body : model.bodies) places.push_back(body.centroid);
  return places;
}

/// The weights of all that may move.
Eigen::VectorXd weights(const Model& model, const Unknowns& unknowns) {
  Eigen::VectorXd b(unknowns.count);
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    set_part(b, unknowns, i, (Vector6() << 0, 0, -model.bodies[i].mass * g, 0, 0, 0).finished());
  return b;
}

void expect_factors_solution(BlockMatrix k, const Unknowns& unknowns, const Model& model, int most_iterations) {
  const Eigen::VectorXd b = weights(model, unknowns);
  k.hold(unknowns);
  Multigrid multigrid;
  ASSERT_TRUE(multigrid.compute(k, unknowns, places_of(model)));
  EXPECT_GE(multigrid.levels(), 2u);
  const auto x = multigrid.solve(k, unknowns, b, 1e-10, most_iterations);
  ASSERT_TRUE(x.has_value());
  Factor factor;
  const SparseMatrix matrix = k.over(unknowns);
  ASSERT_TRUE(factor.compute(matrix));
  const Eigen::VectorXd exact = factor.solve(b);
  EXPECT_LT((*x - exact).norm(), 1e-7 * exact.norm());
  EXPECT_LT((matrix.selfadjointView<Eigen::Lower>() * *x - b).norm(), 1.01e-10 * b.norm());
}

TEST(Multigrid, SolvesWhatAFactorSolves) {
  const Bench bench(wall(20, 20), undamped({0, 0, -g}));
  expect_factors_solution(stiffness_blocks(bench.model, bench.state, PatchTangent::intact),
                          number_unknowns(bench.model), bench.model, 40);
}

/// Sites of which some components are prescribed, and some wholly.
TEST(Multigrid, LeavesOutWhatIsHeld) {
  const Bench bench(wall(20, 20), undamped({0, 0, -g}));
  Unknowns unknowns = number_unknowns(bench.model);
  unknowns.count = 0;
  for (std::size_t site = 0; site < unknowns.of.size(); ++site)
    for (std::size_t c = 0; c < 6; ++c) {
      std::int32_t& of = unknowns.of[site][c];
      const bool held = site % 7 == 0 && (c == 0 || c == 4);
      of = of < 0 || held || site % 31 == 3 ? -1 : unknowns.count++;
    }
  expect_factors_solution(stiffness_blocks(bench.model, bench.state, PatchTangent::intact), unknowns, bench.model, 40);
}

/// With a joint in five gone, blocks hang on few others, and some on nothing but what is added to the diagonal.
TEST(Multigrid, HoldsWhereJointsAreGone) {
  Bench bench(wall(20, 20), undamped({0, 0, -g}));
  for (std::size_t i = 0; i < bench.model.joints.size(); ++i)
    if (i * 2654435761u % 5u == 0) bench.state.joint.mode[i] |= mode_gone;
  const auto& joints = bench.model.joints;
  const std::int32_t alone = joints[joints.size() / 2].a;
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (joints[i].a == alone || joints[i].b == alone) bench.state.joint.mode[i] |= mode_gone;
  BlockMatrix k = stiffness_blocks(bench.model, bench.state, PatchTangent::intact);
  for (std::size_t site = 0; site < k.sites(); ++site)
    k.diagonal(std::int32_t(site)).diagonal().array() += 1e-7 * joints[0].kn * joints[0].area;
  expect_factors_solution(k, number_unknowns(bench.model), bench.model, 100);
}

/// Of a fine bridge it takes longer than relaxation, and gigabytes.
TEST(Factor, IsNotBegunWhereItWouldTakeTooLong) {
  const Bench bench(wall(10, 10), undamped({0, 0, -g}));
  const SparseMatrix k =
      assemble_stiffness(bench.model, bench.state, number_unknowns(bench.model), PatchTangent::intact);
  Factor factor;
  EXPECT_FALSE(factor.compute(k, 1e3));
  EXPECT_FALSE(factor.lacked_memory());
  EXPECT_GT(factor.operations(), 1e3);
  EXPECT_TRUE(factor.compute(k, factor.operations()));
}

int iterations_of(int side) {
  const Bench bench(wall(side, side), undamped({0, 0, -g}));
  const Unknowns unknowns = number_unknowns(bench.model);
  BlockMatrix k = stiffness_blocks(bench.model, bench.state, PatchTangent::intact);
  k.hold(unknowns);
  Multigrid multigrid;
  EXPECT_TRUE(multigrid.compute(k, unknowns, places_of(bench.model)));
  EXPECT_TRUE(multigrid.solve(k, unknowns, weights(bench.model, unknowns), 1e-6, 100).has_value());
  return multigrid.iterations();
}

/// What coarse levels are for.
TEST(Multigrid, TakesHardlyMoreIterationsForAWallOfEightTimesTheHeight) {
  const int low = iterations_of(10), high = iterations_of(80);
  EXPECT_LE(low, 12);
  EXPECT_LE(high, 2 * low);
}

/// A wall settles course by course, whatever its bond: joint j carries all courses above it.
TEST(Multigrid, FindsHowALargeWallSettles) {
  constexpr int courses = 72;
  Bench bench(wall(72, courses), undamped({0, 0, -g}));
  ASSERT_GT(bench.model.bodies.size(), 5000u) << "fewer are left to a factor";
  const Equilibrium e = bench.balance(1e-8);
  ASSERT_TRUE(e.converged) << e.account;
  const Patch* bed = nullptr;
  for (const Patch& p : bench.model.joints)
    if (std::abs(axes_matrix(patch_jump(p, &bench.state.pose[pose_width * std::size_t(p.a)],
                                        &bench.state.pose[pose_width * std::size_t(p.b)]))(2, 0)) > 0.9)
      bed = &p;
  ASSERT_NE(bed, nullptr);
  double lowest = 1e300, highest = -1e300;
  for (const Body& b : bench.model.bodies)
    if (!b.fixed) lowest = std::min(lowest, b.centroid.z()), highest = std::max(highest, b.centroid.z());
  const double height = (highest - lowest) / (courses - 1);
  double density = 0.0;
  for (const Block& block : bench.assembly.blocks)
    if (!block.fixed) density = bench.assembly.materials[std::size_t(block.material)].density;
  double settled = 0.0;
  for (int j = 0; j < courses; ++j) settled += (courses - j) * density * g * height / bed->kn;
  double worst = 0.0;
  for (std::size_t i = 0; i < bench.model.bodies.size(); ++i) {
    const Body& b = bench.model.bodies[i];
    if (b.centroid.z() < highest - 0.1 * height) continue;
    worst = std::max(worst, std::abs(bench.state.pose[pose_width * i + 2] + settled));
  }
  EXPECT_LT(worst, 1e-4 * settled) << settled;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
