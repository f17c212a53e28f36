// What joint patches carry, against statics and Navier's formula.
#include "solver/statics/joint_stresses.h"

#include "solver/run/simulation.h"
#include "solver/step/make_snapshot.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double b = 0.8, d = 0.5;  // m, sides of the joint along x and y
constexpr double N = 2e5;           // N

/// A block of b × d × 1 m without weight on a fixed one, pressed by N at (x, y) on its top and pushed by `across` (N)
/// along x at the joint itself, where it has no lever.
RestForces pressed(const JointLaw& law, double x, double y, double across) {
  Assembly assembly = stone();
  add_box(assembly, {-1, -1, -1}, {1, 1, 0}, true);
  add_box(assembly, {-b / 2, -d / 2, 0}, {b / 2, d / 2, 1});
  assembly.groups["block"] = {1};
  assembly = joined(std::move(assembly), 1e12, 4e11, law);
  SolverSettings settings = undamped();
  settings.step.equilibrium_tolerance = 1e-8;
  StageSettings stage;
  stage.loads = Loads{};
  stage.loads->forces = {{"block", Vec3(across, 0, -N), Vec3(x, y, 0)}};
  settings.stages = {stage};
  Simulation run(assembly, settings, 1, {});
  EXPECT_EQ(run.run(), RunEnd::finished) << run.failure();
  return forces_at_rest(run.model(), run.state());
}

JointStress only(const RestForces& rest) {
  const std::vector<JointStress> all = joint_stresses(rest, 1);
  EXPECT_EQ(all.size(), 1u);
  return all.at(0);
}

JointLaw mortar() {
  JointLaw law = dry_law(0.6);
  law.tension = 3e5, law.cohesion = 2e5;
  return law;
}

TEST(JointStresses, OfAnEccentricForceWithinTheKern) {
  const double x = 0.06, y = -0.03, across = 4e4;
  const RestForces rest = pressed(mortar(), x, y, across);
  const JointStress s = only(rest);
  EXPECT_NEAR(s.normal, N, 1e-6 * N);
  EXPECT_NEAR(s.shear, across, 1e-6 * N);
  EXPECT_NEAR(s.mean_compression, N / (b * d), 1e-6 * N / (b * d));
  EXPECT_NEAR(s.mean_shear, across / (b * d), 1e-6 * N / (b * d));
  EXPECT_NEAR((s.eccentricity - Vec3(x, y, 0)).norm(), 0.0, 1e-5) << "less what the block has moved";
  EXPECT_NEAR(s.eccentricity_over_depth, x / b + -y / d, 1e-4);
  const double most = N / (b * d) * (1.0 + 6.0 * x / b + 6.0 * -y / d);
  EXPECT_NEAR(s.largest_compression, most, 1e-4 * most);
  EXPECT_NEAR(s.utilisation, across / (N * 0.6 + 2e5 * b * d), 1e-6);
  EXPECT_EQ(s.condition, JointCondition::bonded);
  const PatchSnapshot& frame = rest.snapshot.patches.at(0);
  EXPECT_NEAR(frame.eccentricity, s.eccentricity_over_depth, 1e-5) << "as frames have it";
  EXPECT_NEAR(frame.utilisation, s.utilisation, 1e-6);
}

/// A dry joint opens: the force stays where it is, and the frames know it from the points that still press.
TEST(JointStresses, OfAnEccentricForceBeyondTheKern) {
  const double x = 0.3;
  const RestForces rest = pressed(dry_law(0.6), x, 0.0, 3e4);
  const JointStress s = only(rest);
  EXPECT_NEAR(s.normal, N, 1e-6 * N);
  EXPECT_NEAR(s.eccentricity_over_depth, x / b, 1e-4);
  EXPECT_NEAR(s.utilisation, 3e4 / (N * 0.6), 1e-5);
  EXPECT_EQ(s.condition, JointCondition::closed);
  const PatchSnapshot& frame = rest.snapshot.patches.at(0);
  EXPECT_GT(frame.opening, 0.0);
  EXPECT_NEAR(frame.eccentricity, s.eccentricity_over_depth, 1e-5);
}

/// What frames have from the tractions is what the resultants give, of whole joints and of open ones.
TEST(JointStresses, OfFramesAreTheSame) {
  Bench bench(generated("arch", {{"rows", 3}, {"width", 1.5}, {"voussoirs", 15}}), undamped({0, 0, -9.81}));
  ASSERT_TRUE(bench.balance(1e-8).converged);
  const RestForces rest = forces_at_rest(bench.model, bench.state);
  int by_points = 0, whole = 0;
  for (const JointStress& s : joint_stresses(rest, bench.assembly.joints.size())) {
    const PatchSnapshot& frame = rest.snapshot.patches[s.patch];
    if (s.normal < 1.0) continue;  // N: of some hundred thousand
    (frame.opening > 0.0 ? by_points : whole) += 1;
    EXPECT_NEAR(-frame.normal_traction, s.mean_compression, 1e-6 * s.mean_compression + 1e-3);
    EXPECT_NEAR(frame.eccentricity, s.eccentricity_over_depth, 1e-4) << s.patch;
    EXPECT_NEAR(frame.utilisation, s.utilisation, 1e-4) << s.patch;
  }
  EXPECT_GT(by_points, 0) << "some joints have opened";
  EXPECT_GT(whole, 0);
}

/// A square joint of one square metre in the plane z = 0, its block b above; `force` and moment act on a below.
RestForces by_hand(const Vec3& force, double capacity) {
  RestForces rest;
  PatchSnapshot patch;
  patch.b = 1;
  patch.polygon = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  patch.normal = Vec3::UnitZ();
  patch.area = 1.0;
  rest.snapshot.patches = {patch};
  rest.forces = {{.force = force, .moment = Vec3(0.7, 0.5, 0).cross(force), .shear_capacity = capacity}};
  return rest;
}

TEST(JointStresses, TellHowAJointStands) {
  const auto condition = [](RestForces rest, double bonded, bool had_bond) {
    rest.snapshot.patches[0].bonded = bonded, rest.snapshot.patches[0].had_bond = had_bond;
    return std::string(condition_word(only(rest).condition));
  };
  const RestForces pressed_joint = by_hand({10, 0, -100}, 50.0);
  EXPECT_EQ(condition(pressed_joint, 1.0, true), "bonded");
  EXPECT_EQ(condition(pressed_joint, 0.7, true), "cracked");
  EXPECT_EQ(condition(pressed_joint, 0.0, false), "closed");
  EXPECT_EQ(condition(by_hand({30, 40, -100}, 50.0), 0.7, true), "sliding");
  EXPECT_EQ(condition(by_hand(Vec3::Zero(), 0.0), 0.0, true), "open");
  EXPECT_NEAR((only(pressed_joint).eccentricity - Vec3(0.2, 0, 0)).norm(), 0.0, 1e-12);
}

TEST(JointStresses, WithoutCompressionThereIsNoEccentricity) {
  const JointStress s = only(by_hand({0, 0, 5}, 0.0));
  EXPECT_EQ(s.normal, -5.0);
  EXPECT_FALSE(std::isfinite(s.eccentricity_over_depth));
  EXPECT_FALSE(std::isfinite(s.utilisation));
}

TEST(JointStresses, LeaveOutWhatIsNoJoint) {
  RestForces rest = by_hand({0, 0, -5}, 1.0);
  EXPECT_EQ(joint_stresses(rest, 0).size(), 1u) << "a contact that bears";
  rest.snapshot.patches[0].tie = true;
  EXPECT_TRUE(joint_stresses(rest, 1).empty());
  rest.snapshot.patches[0].tie = false, rest.snapshot.patches[0].replaced = true;
  EXPECT_TRUE(joint_stresses(rest, 1).empty());
  EXPECT_TRUE(joint_stresses(by_hand(Vec3::Zero(), 0.0), 0).empty()) << "a contact that bears nothing";
}

/// Pressed past its strength a composite joint has lost stiffness; its snapshot shows the traction that is left.
TEST(JointStresses, OfACrushedJointAreWhatItStillBears) {
  JointLaw law = mortar();
  law.kind = JointLaw::Kind::composite;
  law.fracture_energy = {50.0, 200.0};
  law.compressive_strength = 3e6, law.compressive_energy = 4e3;
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  Bench bench(joined(std::move(assembly), 1e10, 4e9, law));
  for (int i = 1; i <= 20; ++i) {
    bench.place(1, {0, 0, -5e-5 * i}, Eigen::Quaterniond::Identity());
    bench.stepper.patches_only();
  }
  const double force = bench.wrench_on(1, 0, Vec3::Zero()).first.z();
  ASSERT_LT(force, 0.5 * 1e10 * 1e-3) << "it has crushed";
  EXPECT_NEAR(-make_snapshot(bench.model, bench.state).patches[0].normal_traction, force, 1e-6 * force);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
