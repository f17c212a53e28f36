// Ties: bars between two stones that only pull and yield. Their forces against closed forms.
#include <numbers>

#include "solver/step/make_snapshot.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double length = 4.0, axial = 2e8, yield_force = 2e5;  // m, N (E A), N
constexpr double k = axial / length;                            // N/m

/// Two blocks of 1 m a side whose inner faces are 4 m apart along y, held by a tie between the middles of these faces;
/// the first is fixed.
Assembly two_blocks(double pretension = 0.0) {
  Assembly assembly = stone();
  add_box(assembly, {0, -1, 0}, {1, 0, 1}, true);
  add_box(assembly, {0, 4, 0}, {1, 5, 1});
  finish_blocks(assembly);
  add_tie(assembly, 0, {0.5, 0, 0.5}, 1, {0.5, 4, 0.5}, axial, yield_force, pretension);
  return assembly;
}

/// What the tie does to the second block where that is put.
struct Pulled {
  Bench bench;
  explicit Pulled(const Assembly& assembly) : bench(assembly) { bench.begin(); }
  /// Force, and moment about the block's centroid as built.
  std::pair<Vec3, Vec3> at(const Vec3& move, const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) {
    bench.place(1, move, turn);
    bench.stepper.patches_only();
    return bench.wrench_on(1, 0, bench.assembly.blocks[1].centroid);
  }
  double pull(double opening) { return -at({0, opening, 0}).first.y(); }
  PatchSnapshot tie() const { return make_snapshot(bench.model, bench.state).patches.at(0); }
};

TEST(Ties, PullElasticallyYieldUnloadAndGoSlack) {
  Pulled tie(two_blocks());
  const double limit = yield_force / k;  // m, 4 mm
  EXPECT_NEAR(tie.pull(0.5 * limit), 0.5 * yield_force, 1e-9 * yield_force);
  EXPECT_EQ(tie.pull(-0.01), 0.0) << "they may come nearer";
  EXPECT_NEAR(tie.pull(0.5 * limit), 0.5 * yield_force, 1e-9 * yield_force) << "as before";
  EXPECT_NEAR(tie.pull(3.0 * limit), yield_force, 1e-9 * yield_force) << "plateau";
  EXPECT_NEAR(tie.pull(2.5 * limit), 0.5 * yield_force, 1e-9 * yield_force) << "unloads along k";
  EXPECT_EQ(tie.pull(1.9 * limit), 0.0) << "longer by two limits now";
  EXPECT_EQ(tie.pull(-1.0 * limit), 0.0);
  EXPECT_NEAR(tie.pull(2.25 * limit), 0.25 * yield_force, 1e-9 * yield_force) << "what has yielded stays";
  EXPECT_NEAR(tie.pull(4.0 * limit), yield_force, 1e-9 * yield_force);
  ASSERT_TRUE(tie.tie().tie);
  EXPECT_NEAR(tie.tie().yielded, 3.0 * limit, 1e-12);
  EXPECT_NEAR(tie.tie().largest_tension * tie.tie().area, yield_force, 1e-9 * yield_force);
  EXPECT_EQ(tie.tie().largest_opening, 0.0) << "no crack";
}

TEST(Ties, PretensionActsInThePlacementAsBuilt) {
  Pulled tie(two_blocks(0.25 * yield_force));
  const double limit = yield_force / k;
  EXPECT_NEAR(tie.pull(0.0), 0.25 * yield_force, 1e-9 * yield_force);
  EXPECT_NEAR(tie.pull(-0.125 * limit), 0.125 * yield_force, 1e-9 * yield_force);
  EXPECT_EQ(tie.pull(-0.3 * limit), 0.0);
  EXPECT_NEAR(tie.pull(1.0 * limit), yield_force, 1e-9 * yield_force) << "yields sooner by what it had";
}

/// The force acts along the line through the anchors, wherever they have gone: exact at any turn.
TEST(Ties, PullAlongTheLineBetweenTheirAnchors) {
  Pulled tie(two_blocks());
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.2, Vec3(0.3, -0.5, 0.7).normalized()));
  const Vec3 move(0.3, 0.1, -0.4), centroid(0.5, 4.5, 0.5), from(0.5, 0, 0.5);
  const auto [pull, moment] = tie.at(move, turn);
  const Vec3 to = centroid + move + turn * (Vec3(0.5, 4, 0.5) - centroid);
  const double force = std::min(yield_force, k * ((to - from).norm() - length));
  ASSERT_GT(force, 0.0);
  const Vec3 expected = -force * (to - from).normalized();
  EXPECT_LT((pull - expected).norm(), 1e-9 * yield_force);
  EXPECT_LT((moment - (to - centroid).cross(expected)).norm(), 1e-9 * yield_force);
  const Polygon strip = tie.tie().polygon;
  EXPECT_LT((0.5 * (strip[0] + strip[1]) - from).norm(), 1e-9);
  EXPECT_LT((0.5 * (strip[2] + strip[3]) - to).norm(), 1e-9);
}

/// A block thrown outwards at v yields the tie by m v²/(2 F) − F/(2 k) and bounces back; no energy gets lost from the
/// ledger.
TEST(Ties, YieldingTakesTheEnergyThatItShould) {
  Bench bench(two_blocks());
  bench.begin(2e-5);
  const double mass = bench.assembly.blocks[1].mass, v = 2.0;
  bench.push(1, {0, v, 0});
  ASSERT_TRUE(bench.run(2500));  // 0.05 s: past the farthest point
  const PatchSnapshot tie = make_snapshot(bench.model, bench.state).patches.at(0);
  const double stretched = 0.5 * mass * v * v / yield_force - 0.5 * yield_force / k;
  ASSERT_GT(stretched, 0.005);
  EXPECT_NEAR(tie.yielded, stretched, 1e-3 * stretched);
  bench.stepper.patches_only();
  const Energies e = compute_energies(bench.stepper, bench.stepper.body_pass());
  EXPECT_NEAR(e.friction, yield_force * stretched, 2e-3 * yield_force * stretched);
  EXPECT_NEAR(e.total(), 0.5 * mass * v * v, 1e-3 * 0.5 * mass * v * v);
}

/// A block between two pretensioned ties is a mass on a string: across them it swings at √(2 T/(L m)).
TEST(Ties, PretensionHoldsAStringAcross) {
  Assembly assembly = stone();
  add_box(assembly, {0, -1, 0}, {1, 0, 1}, true);
  add_box(assembly, {0.25, 3.75, 0.25}, {0.75, 4.25, 0.75});
  add_box(assembly, {0, 8, 0}, {1, 9, 1}, true);
  finish_blocks(assembly);
  const Vec3 middle(0.5, 4, 0.5);
  const double pretension = 5e4;
  add_tie(assembly, 0, {0.5, 0, 0.5}, 1, middle, axial, 1e9, pretension);
  add_tie(assembly, 1, middle, 2, {0.5, 8, 0.5}, axial, 1e9, pretension);
  const double stiffness = 2.0 * pretension / length;
  Bench bench(assembly);
  bench.begin(1e-4);
  bench.stepper.patches_only();
  const DenseSystem system = dense_system(bench, PatchTangent::present, &bench.stepper.wrenches);
  EXPECT_NEAR(system.k(0, 0), stiffness, 1e-6 * stiffness);
  EXPECT_NEAR(system.k(1, 1), 2.0 * k, 1e-6 * k);
  EXPECT_NEAR(system.k(2, 2), stiffness, 1e-6 * stiffness);
  const double omega = std::sqrt(stiffness / bench.assembly.blocks[1].mass), v = 1e-3;
  bench.push(1, {0, 0, v});
  double most = 0.0;
  ASSERT_TRUE(bench.run(int(0.5 * std::numbers::pi / omega / 1e-4), 1,
                        [&](const BodyPass&) { most = std::max(most, bench.displacement(1).z()); }));
  EXPECT_NEAR(most, v / omega, 1e-3 * v / omega);
}

/// Their tangents agree with differences of the forces, turned and moved.
TEST(Ties, GeometricStiffnessIsTheDerivativeOfTheForces) {
  Assembly assembly = two_blocks(0.5 * yield_force);
  Pulled tie(assembly);
  tie.bench.stepper.patches_only();
  const DenseSystem system = dense_system(tie.bench, PatchTangent::present, &tie.bench.stepper.wrenches);
  const double h = 1e-6;
  for (int c = 0; c < 3; ++c) {
    Vec3 step = Vec3::Zero();
    step[c] = h;
    const Vec3 slope = (tie.at(-step).first - tie.at(step).first) / (2.0 * h);
    for (int r = 0; r < 3; ++r) EXPECT_NEAR(system.k(r, c), slope[r], 1e-5 * k) << r << c;
    const auto moment = [&](double angle) {  // about the centroid, which stays
      return tie.at(Vec3::Zero(), Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::Unit(c)))).second[c];
    };
    const double turning = (moment(-h) - moment(h)) / (2.0 * h);
    EXPECT_NEAR(system.k(3 + c, 3 + c), turning, 1e-5 * k) << c;
  }
}

/// A tie draws two stones together over a gap of 10 mm: they meet, and bounce, as they would without it.
TEST(Ties, TiedStonesStillTouch) {
  Assembly assembly = stone(2000.0, 1e9, 0.5);
  add_box(assembly, {0, 0, 0}, {1, 1, 1}, true);
  add_box(assembly, {0, 1.01, 0}, {1, 2.01, 1});
  finish_blocks(assembly);
  add_tie(assembly, 0, {0.5, 0.0, 0.5}, 1, {0.5, 2.01, 0.5}, 1e7, 1e9, 2e4);
  Bench bench(assembly);
  bench.begin(1e-5);
  double nearest = 0.0;
  ASSERT_TRUE(bench.run(30000, 10, [&](const BodyPass&) { nearest = std::min(nearest, bench.displacement(1).y()); }));
  EXPECT_LT(nearest, -0.01);
  EXPECT_GT(nearest, -0.0106) << "they pass through each other";
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
