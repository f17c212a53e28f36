// Bridges that are built step by step: against closed forms of what each step finds and leaves.
#include "solver/base/error.h"
#include "solver/contact/jump.h"
#include "solver/run/simulation.h"
#include "tests/solver/models.h"
#include "tools/ladder/fill_models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

ConstructionStep adds(std::vector<std::string> names) {
  ConstructionStep step;
  step.add = std::move(names);
  return step;
}

SolverSettings gravity_of(const std::vector<ConstructionStep>& steps, double tolerance = 1e-9) {
  SolverSettings settings;
  settings.damping.kind = DampingSettings::Kind::none;
  settings.step.equilibrium_tolerance = tolerance;
  StageSettings gravity;
  if (!steps.empty()) gravity.construction = ConstructionSettings{steps, 2.0};
  settings.stages = {gravity};
  return settings;
}

std::unique_ptr<Simulation> at_rest(const Assembly& assembly, const SolverSettings& settings) {
  auto simulation = std::make_unique<Simulation>(assembly, settings, 1, Observers{});
  EXPECT_EQ(simulation->run(), RunEnd::finished) << simulation->failure();
  return simulation;
}

double sinks(const Simulation& s, std::int64_t block) {
  return -s.state().pose[pose_width * std::size_t(s.model().body_of_block[std::size_t(block)]) + 2];
}

constexpr int courses = 6;
constexpr double weight = 2000.0 * 9.81, soft = 1e8, stiff = 4e8;  // N of a cube of 1 m, Pa/m

/// Two columns of cubes side by side, one on soft joints and one on stiff ones; head joints that hardly hold.
Assembly two_columns() {
  Assembly assembly = stone();
  add_box(assembly, {-0.5, 0, -1}, {2.5, 1, 0}, true);
  for (int i = 0; i < courses; ++i)
    for (int column = 0; column < 2; ++column)
      add_box(assembly, {double(column), 0, double(i)}, {column + 1.0, 1, i + 1.0});
  assembly = joined(std::move(assembly), soft, soft, elastic_law());
  for (Joint& joint : assembly.joints) {
    const bool head = std::abs(joint.normal.x()) > 0.5;
    const bool second = assembly.blocks[std::size_t(joint.b)].centroid.x() > 1.0;
    joint.kn = joint.ks = head ? 1.0 : second ? stiff : soft;
  }
  for (std::size_t i = 1; i < assembly.blocks.size(); ++i)
    assembly.groups[fmt::format("course {}", (i - 1) / 2 + 1)].push_back(std::int64_t(i));
  return assembly;
}

/// Course i has been laid level and settles by what comes with it and after it, on i joints: i (N − i + 1) w/k. Head
/// joints have only that difference; all at once they have that of the whole weight, i N − i (i − 1)/2 joints.
TEST(Construction, AWallInLiftsHasNoStressFromWhatSettledBefore) {
  const Assembly assembly = two_columns();
  std::vector<ConstructionStep> steps;
  for (int i = 1; i <= courses; ++i) steps.push_back(adds({fmt::format("course {}", i)}));
  const auto built = at_rest(assembly, gravity_of(steps)), at_once = at_rest(assembly, gravity_of({}));
  const double apart = 1.0 / soft - 1.0 / stiff;
  int heads = 0;
  for (std::size_t j = 0; j < built->model().joints.size(); ++j) {
    const Simulation& s = *built;
    const Patch& patch = s.model().joints[j];
    const Joint& joint = assembly.joints[std::size_t(s.model().joint_of_patch[j])];
    if (std::abs(joint.normal.x()) < 0.5) continue;
    const double i = double((joint.a - 1) / 2 + 1);
    const auto slips = [&](const Simulation& of) {
      const Patch& p = of.model().joints[j];
      const Jump<double> jump = patch_jump(p, &of.state().pose[pose_width * std::size_t(p.a)],
                                           &of.state().pose[pose_width * std::size_t(p.b)]);
      return std::hypot(jump.s, jump.t);
    };
    EXPECT_NEAR(slips(s), i * (courses - i + 1) * weight * apart, 1e-3 * weight * apart) << i << " " << patch.a;
    EXPECT_NEAR(slips(*at_once), (i * courses - 0.5 * i * (i - 1)) * weight * apart, 1e-3 * weight * apart) << i;
    ++heads;
  }
  EXPECT_EQ(heads, courses);
  for (int i = 1; i <= courses; ++i)
    EXPECT_NEAR(sinks(*built, 2 * i - 1), i * (courses - i + 1) * weight / soft, 1e-3 * weight / soft);
}

/// While nothing breaks or slides, what an arch carries once its centering is struck is what it carries all at once.
TEST(Construction, AnArchThatIsStruckThrustsAsOneMadeAtOnce) {
  Assembly assembly = generated("arch", {{"mean_radius", 3.0}, {"thickness", 0.5}});
  set_law(assembly, elastic_law());
  ConstructionStep arch = adds({"arch"}), strike;
  arch.centering = true, strike.strike = {"arch"};
  std::vector<Vec3> reactions;
  std::vector<Array<double>> poses;
  for (const auto& steps : {std::vector<ConstructionStep>{}, std::vector<ConstructionStep>{arch, strike}}) {
    Sample last;
    Observers observers;
    observers.history = [&](const Simulation&, const Sample& sample) { last = sample; };
    Simulation simulation(assembly, gravity_of(steps), 1, observers);
    ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
    ASSERT_FALSE(last.reactions.empty());
    reactions.push_back(last.reactions.front());
    poses.push_back(simulation.state().pose);
  }
  EXPECT_GT(std::abs(reactions[0].x()), 0.05 * std::abs(reactions[0].z()));
  EXPECT_LT((reactions[1] - reactions[0]).norm(), 1e-7 * reactions[0].norm());
  double apart = 0.0, most = 0.0;
  for (std::size_t i = 0; i < poses[0].size(); ++i) {
    if (i % pose_width == 3) continue;
    apart = std::max(apart, std::abs(poses[1][i] - poses[0][i])), most = std::max(most, std::abs(poses[0][i]));
  }
  EXPECT_LT(apart, 1e-6 * most);
}

constexpr double lift = 2.0, room = 3.0;  // m: of each of two lifts; from the fixed wall to the other
constexpr double youngs = 20e6, poisson = 0.25, unit_weight = 1800.0 * 9.81;
constexpr double spring = 40e6;  // Pa/m, under the movable wall's back

/// Elastic fill in plane strain between a fixed wall and one that is guided along x and leans on a joint of some
/// softness; smooth all around.
Assembly lifts_behind_a_wall() {
  constexpr double depth = 0.5;
  Assembly assembly = stone();
  add_box(assembly, {-1, -1, -1}, {room + 2, depth + 1, 0}, true);          // floor
  add_box(assembly, {room, -1, 0}, {room + 1, depth + 1, 2 * lift}, true);  // fixed wall
  add_box(assembly, {0, -1, 0}, {room, 0, 2 * lift}, true);                 // sides
  add_box(assembly, {0, depth, 0}, {room, depth + 1, 2 * lift}, true);
  add_box(assembly, {-1, 0, 0.0}, {0, depth, 2 * lift}, true);  // the wall that moves
  add_box(assembly, {-2, 0, 0.0}, {-1, depth, 2 * lift});       // what it leans on, between joints of which one is soft
  add_box(assembly, {-3, 0, 0.0}, {-2, depth, 2 * lift}, true);
  Material soil = elastic_fill(1800.0, youngs / (3.0 - 6.0 * poisson), youngs / (2.0 + 2.0 * poisson));
  FillMesh mesh = box_mesh({0, 0, 0}, {room, depth, 2 * lift}, 6, 1, 8);
  JointLaw smooth = elastic_law();
  assembly = filled(std::move(assembly), std::move(mesh), soil, 1e11, 1.0, smooth);
  assembly.groups["wall"] = {4};
  for (Joint& joint : assembly.joints) {
    const bool back = std::max(joint.a, joint.b) == 6 && std::min(joint.a, joint.b) == 5;
    const bool front = std::max(joint.a, joint.b) == 5 && std::min(joint.a, joint.b) == 4;
    joint.kn = back ? spring : front ? 1e12 : 1.0, joint.ks = back ? 1e10 : 1.0;
  }
  return assembly;
}

/// The wall's way out. A lift presses with K0 σv less E' ε, σv what lies above, ε the wall's way since the lift was
/// laid over the length, E' = E/(1 − ν²); springs of k A answer. All at once: one equation; in lifts: two.
TEST(Construction, FillInLiftsPressesByItsHistory) {
  const Assembly assembly = lifts_behind_a_wall();
  ConstructionStep lower = adds({"fill", "block"}), upper = adds({"fill"});
  lower.below = lift + 1e-6;
  std::vector<double> ways;
  for (const auto& steps : {std::vector<ConstructionStep>{}, std::vector<ConstructionStep>{lower, upper}}) {
    SolverSettings settings = gravity_of(steps, 1e-6);
    Guide guide;
    guide.group = "wall", guide.free = {true, false, false};
    settings.guides = {guide};
    const auto s = at_rest(assembly, settings);
    ways.push_back(-s->state().pose[pose_width * std::size_t(s->model().body_of_block[4])]);
  }
  const double k0 = poisson / (1.0 - poisson), stiffness = youngs / (1.0 - poisson * poisson), all = 2.0 * lift;
  const double at_once = k0 * unit_weight * all * all / 2.0 / (spring * all + stiffness * all / room);
  // The first lift is a wall of its own height for the springs; they are there over the whole of it.
  const double first = k0 * unit_weight * lift * lift / 2.0 / (spring * all + stiffness * lift / room);
  const double second = (k0 * unit_weight * 2.0 * lift * lift + stiffness * lift * first / room) /
                        (spring * all + stiffness * all / room);
  EXPECT_GT(second, 1.02 * at_once);
  EXPECT_NEAR(ways[0], at_once, 5e-3 * at_once);
  EXPECT_NEAR(ways[1], second, 5e-3 * second);
}

/// What a plan refuses, and how it says so.
TEST(Construction, RefusesOrdersThatLeaveSomethingOut) {
  const Assembly assembly = two_columns();
  const auto refusal = [&](std::vector<ConstructionStep> steps) -> std::string {
    try {
      construction_plan(assembly, {std::move(steps), 2.0});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  ConstructionStep strike;
  strike.strike = {"block"};
  ConstructionStep held = adds({"block"});
  held.centering = true;
  ConstructionStep low = adds({"block"});
  low.below = 3.0;
  EXPECT_EQ(refusal({adds({"block"})}), "");
  EXPECT_NE(refusal({adds({"vault"})}).find("this assembly has no \"vault\""), std::string::npos);
  EXPECT_NE(refusal({low}).find("no step adds 6 of block"), std::string::npos) << refusal({low});
  EXPECT_NE(refusal({adds({"block"}), adds({"course 1"})}).find("step 2 adds nothing"), std::string::npos);
  EXPECT_NE(refusal({held}).find("never struck"), std::string::npos);
  EXPECT_NE(refusal({adds({"block"}), strike}).find("no part of it stands on centering"), std::string::npos);
  EXPECT_NE(refusal({adds({"course 2"}), adds({"block"})}).find("has no support"), std::string::npos);
  EXPECT_EQ(refusal({held, strike}), "");
}

/// The masons' order of a whole bridge puts everything somewhere, vaults on centering.
/// A retaining wall: no vault, and a fill that lies on one level only.
TEST(Construction, TheUsualOrderHoldsForAWallWithFill) {
  Assembly assembly = stone();
  add_box(assembly, {-1, 0, -1}, {3, 1, 0}, true);
  add_box(assembly, {-1, 0, 0}, {0, 1, 1});
  assembly = filled(std::move(assembly), box_mesh({0, 0, 0}, {2, 1, 1}, 2, 1, 1), elastic_fill(1500.0, 80e6, 50e6), 1e9,
                    0.4e9, dry_law(0.6));
  const ConstructionPlan plan = construction_plan(assembly, ConstructionSettings{{}, 2.0});
  EXPECT_GE(plan.steps(), 2);
}

TEST(Construction, TheUsualOrderHoldsForBridges) {
  for (const char* name : {"cs1", "cs2"}) {
    const Assembly assembly = generated(name, {{"block_scale", 3.0}});
    const ConstructionPlan plan = construction_plan(assembly, {});
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
      const Block& block = assembly.blocks[i];
      EXPECT_GE(plan.block[i], 0);
      EXPECT_EQ(plan.free[i] > plan.block[i], block.component == Component::arch)
          << block_label(assembly, std::int64_t(i));
    }
    EXPECT_GT(plan.steps(), 8);
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
