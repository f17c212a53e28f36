// Guided blocks: fixed ones that may move along some axes but never turn, such as a loading beam kept level.
#include "solver/base/error.h"
#include "solver/run/simulation.h"
#include "solver/statics/construction.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double stiffness = 1e9;         // Pa/m, of joints of 1 m²
constexpr double weight = 2000.0 * 9.81;  // N, of the block of 1 m³
constexpr double beam_weight = 0.5 * weight;
constexpr double load = 3e5;  // N

/// A block of 1 m between a plate and a beam of half its height.
Assembly under_a_beam(const JointLaw& law) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -0.5}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  add_box(assembly, {0, 0, 1}, {1, 1, 1.5}, true);
  assembly.groups["beam"] = {2};
  assembly.groups["block"] = {1};
  return joined(std::move(assembly), stiffness, 0.4 * stiffness, law);
}

/// The load stands off the middle, so that a beam that could turn would.
SolverSettings guided() {
  SolverSettings settings;
  settings.guides = {{"beam", {false, false, true}}};
  StageSettings gravity;
  gravity.loads = Loads{Vec3::Zero(), {{"beam", {0, 0, -load}, Vec3(0.9, 0.2, 1.5)}}, {}};
  settings.stages = {gravity};
  return settings;
}

Vec3 displacement(const Simulation& run, std::int64_t block) {
  const double* pose = &run.state().pose[pose_width * std::size_t(run.model().body_of_block[std::size_t(block)])];
  return {pose[0], pose[1], pose[2]};
}

const double settlement = (load + beam_weight) / stiffness + (load + beam_weight + weight) / stiffness;

class Settles : public testing::TestWithParam<StageSettings::Method> {};

/// Two springs in series under the load and the weights above each; straight down, wherever the load stands.
TEST_P(Settles, StraightDown) {
  SolverSettings settings = guided();
  settings.stages[0].method = GetParam();
  settings.step.equilibrium_tolerance = 1e-9;
  const Assembly assembly = under_a_beam(dry_law(0.6));
  Simulation run(assembly, settings, 1, {});
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  EXPECT_TRUE(run.equilibrium().converged);
  const Vec3 beam = displacement(run, 2);
  measured("guided beam under a load: settlement", -settlement, beam.z(), "m");
  EXPECT_NEAR(beam.z(), -settlement, 1e-7 * settlement);
  EXPECT_EQ(beam.x(), 0.0);
  EXPECT_EQ(beam.y(), 0.0);
  const auto at = pose_width * std::size_t(run.model().body_of_block[2]);
  EXPECT_EQ(run.state().pose[at + 3], 1.0) << "it turned";
}

INSTANTIATE_TEST_SUITE_P(Guide, Settles,
                         testing::Values(StageSettings::Method::newton, StageSettings::Method::relaxation),
                         [](const testing::TestParamInfo<StageSettings::Method>& method) {
                           return method.param == StageSettings::Method::newton ? "Newton" : "Relaxation";
                         });

/// Rotation of the beam under a unit moment, held at its centroid sideways: the block (u, θ) and the beam (θ) between
/// the springs of two joints, in shear and in bending (rad / N m).
double tilt_by_a_moment() {
  Eigen::Matrix<double, 2, 3> shear, bend;
  shear << 1, -0.5, 0, -1, -0.5, -0.25;
  bend << 0, 1, 0, 0, -1, 1;
  const Mat3 k = 0.4 * stiffness * shear.transpose() * shear + stiffness / 12.0 * bend.transpose() * bend;
  return k.inverse()(2, 2);
}

TEST_P(Settles, AndTurnsWhereItMay) {
  SolverSettings settings = guided();
  const Vec3 off(0.10, 0.04, 0.0);
  settings.guides[0].turn = true;
  settings.stages[0].loads->forces[0].at = Vec3(0.5, 0.5, 1.5) + off;
  settings.stages[0].method = GetParam();
  settings.step.equilibrium_tolerance = 1e-9;
  const Assembly assembly = under_a_beam(elastic_law());
  Simulation run(assembly, settings, 1, {});
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  const Eigen::AngleAxisd turned(rotation_of(run.state(), std::size_t(run.model().body_of_block[2])));
  const Vec3 rotation = turned.angle() * turned.axis();
  const double unit = load * tilt_by_a_moment();
  measured("guided beam that may turn: rotation about y", unit * off.x(), rotation.y(), "rad");
  EXPECT_NEAR(rotation.y(), unit * off.x(), 2e-3 * unit * off.x());  // the load leans out as the beam tilts
  EXPECT_NEAR(rotation.x(), -unit * off.y(), 2e-3 * unit * off.x());
  EXPECT_NEAR(displacement(run, 2).z(), -settlement, 1e-4 * settlement);
}

/// The beam alone on its spring, gravity at once: it swings to twice the static settlement at ω² = k/m, no loss. Fixed
/// blocks have no joint between them; the spring is that of the contact that arises, E over the blocks' height.
TEST(Guide, SwingsAsOneMassOnASpring) {
  Assembly assembly = stone(2000.0, 0.5 * stiffness);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});  // free, because a model without such a block is refused; it falls
  add_box(assembly, {5, 0, -0.5}, {6, 1, 0}, true);
  add_box(assembly, {5, 0, 0}, {6, 1, 0.5}, true);
  assembly.groups["beam"] = {2};
  assembly = joined(std::move(assembly), stiffness, 0.4 * stiffness, elastic_law());
  const double mass = 1000.0, omega = std::sqrt(stiffness / mass);
  SolverSettings settings = undamped({0, 0, -load / mass});
  settings.guides = {{"beam", {false, false, true}}};
  StageSettings swing;
  swing.kind = StageSettings::Kind::free;
  swing.duration = 2 * pi / omega;  // one period
  settings.stages = {swing};
  settings.step.time_step = swing.duration / 400;
  settings.output.history_every = settings.step.time_step;
  double lowest = 0.0, worst = 0.0, last = 0.0;
  Observers observers;
  observers.history = [&](const Simulation& run, const Sample& s) {
    lowest = std::min(lowest, displacement(run, 2).z());
    last = displacement(run, 2).z();
    worst = std::max(worst, s.balance_error);
  };
  Simulation run(assembly, settings, 1, observers);
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  measured("guided mass on a spring, gravity at once: lowest", -2 * load / stiffness, lowest, "m");
  EXPECT_NEAR(lowest, -2 * load / stiffness, 1e-4 * load / stiffness);
  EXPECT_NEAR(last, 0.0, 2e-4 * load / stiffness);  // 400 steps, the last sample up to one before the end
  EXPECT_LT(worst, 1e-9);
}

/// Dragged along x over the block, which the plate below holds better: the reaction is the friction under the beam.
TEST(Guide, ReactionIsTheFrictionUnderTheBeam) {
  const Assembly assembly = under_a_beam(dry_law(0.1));
  SolverSettings settings = guided();
  StageSettings drag;
  drag.kind = StageSettings::Kind::free;
  drag.duration = 2.0;
  drag.loads = settings.stages[0].loads;
  drag.drives = {{"beam", Vec3::Zero(), {0.01, 0, 0}}};
  settings.stages.push_back(drag);
  Sample last;
  double worst = 0.0;
  Observers observers;
  observers.history = [&](const Simulation&, const Sample& s) {
    last = s;
    worst = std::max(worst, s.balance_error);
  };
  Simulation run(assembly, settings, 1, observers);
  const auto beam = std::ranges::find(run.held_groups(), "beam");
  ASSERT_NE(beam, run.held_groups().end());
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  const double friction = 0.1 * (load + beam_weight);
  ASSERT_EQ(last.reactions.size(), run.held_groups().size());
  const Vec3 reaction = last.reactions[std::size_t(beam - run.held_groups().begin())];
  measured("guided beam dragged over a block: reaction", friction, reaction.x(), "N");
  EXPECT_NEAR(reaction.x(), friction, 5e-3 * friction);
  EXPECT_EQ(reaction.z(), 0.0);  // free there: nothing holds it
  EXPECT_NEAR(displacement(run, 2).x(), 0.01, 1e-12);
  EXPECT_LT(worst, 1e-3);
}

/// Gravity at once and off the springs' middle: the beam swings and rocks, and no energy is lost or found.
TEST(Guide, KeepsItsEnergyWhileItTurns) {
  Assembly assembly = stone(2000.0, 0.5 * stiffness);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});  // free; it falls
  add_box(assembly, {5, 0, -0.5}, {5.7, 1, 0}, true);
  add_box(assembly, {5, 0, 0}, {6, 1, 0.5}, true);
  assembly.groups["beam"] = {2};
  assembly = joined(std::move(assembly), stiffness, 0.4 * stiffness, elastic_law());
  SolverSettings settings = undamped({0, 0, -9.81});
  settings.guides = {{"beam", {false, false, true}, true}};
  StageSettings swing;
  swing.kind = StageSettings::Kind::free;
  swing.duration = 0.05;
  settings.stages = {swing};
  settings.step.time_step = 2e-5;
  settings.output.history_every = 1e-4;
  double worst = 0.0, turned = 0.0;
  Observers observers;
  observers.history = [&](const Simulation& run, const Sample& s) {
    const Eigen::AngleAxisd turn(rotation_of(run.state(), std::size_t(run.model().body_of_block[2])));
    turned = std::max(turned, turn.angle());
    worst = std::max(worst, s.balance_error);
  };
  Simulation run(assembly, settings, 1, observers);
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  EXPECT_GT(turned, 1e-5);
  EXPECT_LT(worst, 1e-6);
}

TEST(Guide, RefusesWhatCannotBeGuided) {
  const Assembly assembly = under_a_beam(dry_law(0.6));
  const auto refused = [&](const SolverSettings& settings, const std::string& word) {
    try {
      Simulation(assembly, settings, 1, {});
      ADD_FAILURE() << "expected an error about " << word;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  SolverSettings settings = guided();
  settings.guides[0].group = "baem";
  refused(settings, "did you mean 'beam'");
  settings.guides[0].group = "block";
  refused(settings, "Only fixed blocks can be guided");
  settings = guided();
  settings.guides.clear();
  refused(settings, "Only free and guided blocks can be loaded");
  settings = guided();
  StageSettings moved;
  moved.kind = StageSettings::Kind::free;
  moved.duration = 0.1;
  moved.drives = {{"beam", Vec3::Zero(), {0, 0, 0.01}}};
  settings.stages.push_back(moved);
  refused(settings, "leaves it free along this axis");
  StageSettings& shaken = settings.stages.back();
  shaken.kind = StageSettings::Kind::motion;
  shaken.drives[0].displacement.setZero();
  shaken.drives[0].delay = 0.1;
  refused(settings, "differently from the ground ('factor', 'delay'), but a [[guide]] leaves it free along z");
}

/// A stage drives another group that has the guided block in it.
TEST(Guide, AndDriveMeetInABlock) {
  Assembly assembly = under_a_beam(dry_law(0.6));
  assembly.groups["plates"] = {0, 2};
  SolverSettings settings = guided();
  StageSettings moved;
  moved.kind = StageSettings::Kind::free;
  moved.duration = 0.1;
  moved.drives = {{"plates", Vec3::Zero(), {0, 0, 0.01}}};
  settings.stages.push_back(moved);
  EXPECT_THROW(Simulation(assembly, settings, 1, {}), InputError);
}

/// What has not been built yet is held, whatever a guide says.
TEST(Guide, HoldsOnlyWhatIsBuilt) {
  const Assembly assembly = under_a_beam(dry_law(0.6));
  Model model = build_model(assembly, guided());
  const auto beam = std::size_t(model.body_of_block[2]);
  model.bodies[beam].free_ways = 4;  // along z, as the guide says
  model.plan.block = {0, 0, 1}, model.plan.free = {0, 0, 0};
  EXPECT_TRUE(during_step(model, 0).bodies[beam].still());
  model.plan.block[2] = 0;
  EXPECT_FALSE(during_step(model, 0).bodies[beam].still());
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
