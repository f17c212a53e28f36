// What a gravity stage leaves: where displacements count from, stones that did not stay, rows of the history.
#include "solver/motion/pulse.h"
#include "solver/run/simulation.h"
#include "solver/step/make_snapshot.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// A pier on a soft joint that leans under the cap on one of its sides.
Assembly leaning_pier() {
  Assembly assembly = stone();
  add_box(assembly, {-1, -1, -0.5}, {2, 2, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 4});
  add_box(assembly, {0.3, 0, 4}, {1.3, 1, 4.6});
  assembly.groups["ground"] = {0};
  return joined(std::move(assembly), 5e7, 2e7, dry_law(0.6));
}

StageSettings pushed(double duration) {
  StageSettings stage;
  stage.kind = StageSettings::Kind::motion;
  stage.duration = duration;
  PulseSettings pulse;
  pulse.kind = PulseSettings::Kind::half_sine;
  pulse.amplitude = 0.05;
  pulse.frequency = 2.0;
  stage.motion = make_pulse(pulse);
  return stage;
}

TEST(GravityStage, EveryPointCountsFromItsEnd) {
  const Assembly assembly = leaning_pier();
  StageSettings again;
  again.method = StageSettings::Method::relaxation;
  SolverSettings settings;
  settings.stages = {StageSettings{}, pushed(0.5), again};
  Simulation run(assembly, settings, 1, {});
  const Vec3 head(0.5, 0.5, 3.95), corner(1.3, 1.0, 4.6);
  ASSERT_EQ(run.run(0.0), RunEnd::interrupted) << run.failure();
  const auto body = std::size_t(run.model().body_of_block[1]);
  ASSERT_GT(rotation_of(run.state(), body).angularDistance(Eigen::Quaterniond::Identity()), 1e-4) << "it leans";
  for (const auto& [block, point] : {std::pair<std::int64_t, Vec3>{1, head}, {2, corner}}) {
    EXPECT_LT(relative_displacement(run.model(), run.state(), block, point).norm(), 1e-15);
    EXPECT_LT(relative_rotation(run.model(), run.state(), block).norm(), 1e-15);
  }
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  ASSERT_GT(run.state().base_displacement().norm(), 1e-3) << "the ground has gone elsewhere";
  for (const auto& [block, point] : {std::pair<std::int64_t, Vec3>{1, head}, {2, corner}}) {
    EXPECT_LT(relative_displacement(run.model(), run.state(), block, point).norm(), 1e-12);
    EXPECT_LT(relative_rotation(run.model(), run.state(), block).norm(), 1e-12);
  }
}

/// A block turned by θ about its foot from there: a point of it has moved by θ × its height.
TEST(GravityStage, APointShowsTheRotationSinceThen) {
  const Assembly assembly = leaning_pier();
  SolverSettings settings;
  settings.stages = {StageSettings{}};
  Simulation run(assembly, settings, 1, {});
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  double* pose = &run.state().pose[pose_width * std::size_t(run.model().body_of_block[1])];
  const double theta = 1e-3;
  const Eigen::Quaterniond turned = Eigen::Quaterniond(Eigen::AngleAxisd(theta, Vec3::UnitY())) *
                                    Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6]);
  pose[3] = turned.w(), pose[4] = turned.x(), pose[5] = turned.y(), pose[6] = turned.z();
  const Vec3 u = relative_displacement(run.model(), run.state(), 1, {0.5, 0.5, 4.0});
  EXPECT_NEAR(u.x(), theta * 2.0, 2e-6) << "two metres above the centroid";
  EXPECT_NEAR(relative_rotation(run.model(), run.state(), 1).y(), theta, 1e-9);
}

/// A pillar out of plumb by more than its half-width: it falls over and comes to rest on the floor.
Assembly pillar(double lean) {
  Assembly assembly = stone(2000.0, 1e9, 0.7);
  add_box(assembly, {-5, -5, -0.5}, {5, 5, 0}, true);
  for (int i = 0; i < 4; ++i) {
    const double x = lean * i;
    add_box(assembly, {x - 0.25, -0.25, 0.5 * i}, {x + 0.25, 0.25, 0.5 * (i + 1)});
  }
  return joined(std::move(assembly), 2e9, 8e8, dry_law(0.7));
}

TEST(GravityStage, APillarThatFallsOverDoesNotStand) {
  for (const bool allowed : {false, true}) {
    const Assembly assembly = pillar(0.2);
    StageSettings gravity;
    gravity.allow_motion = allowed;
    SolverSettings settings;
    settings.stages = {gravity};
    std::string said;
    Observers observers;
    observers.log = [&](const std::string& text) { said += text + "\n"; };
    Simulation run(assembly, settings, 1, observers);
    EXPECT_EQ(run.run(), allowed ? RunEnd::finished : RunEnd::failed) << run.failure();
    const std::string& words = allowed ? said : run.failure();
    for (const char* piece : {"moved away", "block 4", "turned by", "down"})
      EXPECT_NE(words.find(piece), std::string::npos) << piece << " in\n" << words;
    if (allowed) continue;
    EXPECT_TRUE(run.equilibrium().converged) << "it lies";
    EXPECT_NE(words.find("allow_motion = true"), std::string::npos) << words;
    EXPECT_FALSE(run.moving().empty());
  }
}

/// Stones that turn as they fall meet the floor with other faces, about which they are stiffer: the relaxation has to
/// give them the inertia for that, or they shake for ever.
TEST(GravityStage, HeapsComeToRestHoweverTheyFall) {
  for (int i = 0; i < 24; ++i) {
    const Assembly assembly = pillar(0.2 + 4e-4 * i);
    StageSettings gravity;
    gravity.allow_motion = true;
    SolverSettings settings;
    settings.stages = {gravity};
    Simulation run(assembly, settings, 1, {});
    EXPECT_EQ(run.run(), RunEnd::finished) << "lean " << 0.2 + 4e-4 * i << " m a block: " << run.failure();
  }
}

/// The same on elastic joints that give way by a twentieth of a block in all, but none by itself.
TEST(GravityStage, ASoftPillarStands) {
  Assembly assembly = pillar(0.0);
  const double weight = 4 * 2000.0 * 0.125 * 9.81;  // N, on the lowest joint
  for (Joint& joint : assembly.joints) joint.kn = weight / 0.25 / 0.02, joint.ks = 0.4 * joint.kn;  // 20 mm at the foot
  SolverSettings settings;
  settings.stages = {StageSettings{}};
  Simulation run(assembly, settings, 1, {});
  EXPECT_EQ(run.run(), RunEnd::finished) << run.failure();
  EXPECT_LT(run.state().pose[pose_width * std::size_t(run.model().body_of_block[4]) + 2], -0.04);
}

/// Under 1 g sideways a block of 0.5 x 2 m never comes to rest on a friction of 2: it overturns over its toe.
TEST(GravityStage, WithoutEquilibriumItNamesTheStonesOnTheirWay) {
  Assembly assembly = stone(2000.0, 1e9, 0.7);
  add_box(assembly, {-1, -1, -0.5}, {1, 1, 0}, true);
  for (int i = 0; i < 3; ++i) add_box(assembly, {-0.25, -0.25, 0.5 * i}, {0.25, 0.25, 0.5 * (i + 1)});
  const Assembly stack = joined(std::move(assembly), 2e9, 8e8, dry_law(2.0));
  StageSettings gravity;
  gravity.loads = Loads{Vec3(9.81, 0.0, 0.0), {}, {}};
  SolverSettings settings;
  settings.stages = {gravity};
  Simulation run(stack, settings, 1, {});
  ASSERT_EQ(run.run(), RunEnd::failed);
  for (const char* piece : {"block 3", "+x", "on block"})
    EXPECT_NE(run.failure().find(piece), std::string::npos) << piece << " in\n" << run.failure();
}

/// A stage that takes no time has a row: the ground bears the weight.
TEST(GravityStage, HasARowWithTheReactionsOfAllFixedGroups) {
  const Assembly assembly = leaning_pier();
  StageSettings loaded;
  loaded.loads = Loads{Vec3(0.1, 0.0, 0.0), {}, {}};
  SolverSettings settings;
  settings.stages = {StageSettings{}, loaded};
  std::vector<Sample> rows;
  Observers observers;
  observers.history = [&](const Simulation&, const Sample& s) { rows.push_back(s); };
  Simulation run(assembly, settings, 1, observers);
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  ASSERT_EQ(run.held_groups(), std::vector<std::string>{"ground"});
  ASSERT_EQ(rows.size(), 2u);
  const double mass = assembly.blocks[1].mass + assembly.blocks[2].mass;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(rows[i].stage, std::int64_t(i));
    EXPECT_NEAR(rows[i].reactions.at(0).z(), 9.81 * mass, 1e-5 * 9.81 * mass);
    EXPECT_NEAR(rows[i].reactions.at(0).x(), i == 0 ? 0.0 : -0.1 * mass, 1e-5 * 9.81 * mass);
    EXPECT_GT(rows[i].energies.elastic, 0.0);
    EXPECT_LT(rows[i].energies.gravitational, 0.0);
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
