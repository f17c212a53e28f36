// Gravity equilibrium against hand solutions, by Newton and by dynamic relaxation.
#include "solver/statics/equilibrium.h"

#include "solver/run/simulation.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double g = 9.81;

Assembly column() {
  return generated("column", {{"blocks", 10}, {"block_height", 0.4}, {"kn", 4e9}, {"ks", 1.6e9}});
}

/// Joint j carries the N − j blocks above it: u_i = −Σ_{j ≤ i} (N − j) w/(kn A).
double hand_solution(int i) {
  double u = 0.0;
  for (int j = 0; j <= i; ++j) u -= (10 - j) * 800.0 * g / 4e9;
  return u;
}

TEST(Equilibrium, OfAColumnByNewton) {
  for (bool shortcut : {true, false}) {
    SolverSettings settings = undamped({0, 0, -g});
    settings.step.intact_shortcut = shortcut;
    Bench bench(column(), settings);
    const Equilibrium e = bench.balance(1e-9);
    EXPECT_TRUE(e.converged);
    EXPECT_NEAR(e.first_residual, 1.0, 1e-9) << "in the reference placement each block's weight is out of balance";
    for (int i = 0; i < 10; ++i) {
      EXPECT_NEAR(bench.displacement(i).z(), hand_solution(i), 1e-8 * std::abs(hand_solution(9))) << i;
      EXPECT_LT(bench.displacement(i).head<2>().norm(), 1e-12);
    }
    EXPECT_LT(out_of_balance(bench.stepper), 1e-9);
  }
}

/// Of a step a diagonal raised by a share s leaves 2 s k u at a block, at the top of N blocks s N² weights.
TEST(Equilibrium, AStepLeavesLittleOfAHighColumn) {
  Bench bench(generated("column", {{"blocks", 700}, {"block_height", 0.4}, {"kn", 4e9}, {"ks", 1.6e9}}),
              undamped({0, 0, -g}));
  bench.begin();
  std::vector<double> residuals;
  newton_equilibrium(bench.stepper, 1e-6, nullptr, [&](int, double largest) { residuals.push_back(largest); });
  ASSERT_FALSE(residuals.empty());
  EXPECT_LT(residuals.front(), 1e-3);
}

TEST(Equilibrium, OfAColumnByRelaxation) {
  Bench bench(column(), undamped({0, 0, -g}));
  bench.begin();
  const Equilibrium e = relax(bench.stepper, 1e-6, {}, nullptr, nullptr);
  EXPECT_TRUE(e.converged);
  for (int i = 0; i < 10; ++i)
    EXPECT_NEAR(bench.displacement(i).z(), hand_solution(i), 1e-4 * std::abs(hand_solution(9))) << i;
  EXPECT_EQ(bench.state.time(), 0.0);
  EXPECT_EQ(bench.state.step(), 0);
}

/// The simulation's own relaxation, at the step it chooses itself, whatever damping the run has.
TEST(Equilibrium, RelaxationWorksWithEveryDampingOfTheRun) {
  for (auto kind : {DampingSettings::Kind::maxwell, DampingSettings::Kind::none, DampingSettings::Kind::rayleigh,
                    DampingSettings::Kind::local}) {
    SolverSettings settings;
    settings.damping.kind = kind;
    StageSettings gravity;
    gravity.method = StageSettings::Method::relaxation;
    settings.stages = {gravity};
    const Assembly assembly = column();
    Simulation simulation(assembly, settings, 1, {});
    EXPECT_EQ(simulation.run(), RunEnd::finished) << int(kind) << ": " << simulation.failure();
    const double z = simulation.state().pose[pose_width * std::size_t(simulation.model().body_of_block[9]) + 2];
    EXPECT_NEAR(z, hand_solution(9), 1e-4 * std::abs(hand_solution(9))) << int(kind);
    EXPECT_NE(simulation.equilibrium().account.find(" iterations: out-of-balance force"), std::string::npos)
        << simulation.equilibrium().account;
  }
}

/// Where joints keep changing state it says so before it has tried seven times, and hands on nothing half-broken.
TEST(Equilibrium, NewtonGivesUpOnABridgeOfDryFill) {
  const Generator& generator = find_generator("cs1");
  GeneratorInput input = default_input(generator);
  input.choices.at("abutments") = "restrained";
  input.values.at("block_scale") = 2.5;
  Bench bench(generator.build(input), undamped({0, 0, -g}));
  const std::uint64_t before = hash_arrays({{"mode", 1, "-", &bench.state.joint.mode}});
  const Equilibrium e = bench.balance();
  EXPECT_FALSE(e.converged);
  EXPECT_GE(e.iterations, 3);
  EXPECT_LT(e.iterations, 7);
  EXPECT_EQ(hash_arrays({{"mode", 1, "-", &bench.state.joint.mode}}), before);
}

/// Newton's result does not depend on unneeded history: what stands before is broken nowhere afterwards.
TEST(Equilibrium, LeavesBondsAlone) {
  Assembly assembly = column();
  JointLaw law = dry_law(0.6);
  law.tension = law.cohesion = 1e5;
  set_law(assembly, law);
  Bench bench(std::move(assembly), undamped({0, 0, -g}));
  ASSERT_TRUE(bench.balance().converged);
  for (std::uint8_t mode : bench.state.joint.mode) EXPECT_EQ(mode, 0);
  for (double v : bench.state.motion) EXPECT_EQ(v, 0.0);
}

/// A block that overhangs: the dry joint opens at its heel, Navier's triangle of no-tension (e > b/6): contact length
/// 3 (b/2 − e), largest pressure 2 W/(3 (b/2 − e) depth).
TEST(Equilibrium, OfAnEccentricBlockOnADryJoint) {
  Assembly assembly = stone();
  add_box(assembly, {-3, -0.5, -1}, {0, 0.5, 0}, true);
  add_box(assembly, {-1, -0.5, 0}, {0.6, 0.5, 0.5});  // centroid at −0.2; joint from −1 to 0: e = 0.3 > 1/6
  SolverSettings settings = undamped({0, 0, -g});
  settings.contact.points_per_side = 5;
  Bench bench(joined(std::move(assembly), 1e9, 4e8, dry_law(0.6)), settings);
  const Equilibrium e = bench.balance(1e-9);
  ASSERT_TRUE(e.converged) << e.account;
  bench.stepper.patches_only();
  const double weight = bench.assembly.blocks[1].mass * g;
  const auto [force, moment] = bench.wrench_on(1, 0, bench.assembly.blocks[1].centroid + bench.displacement(1));
  EXPECT_NEAR(force.z(), weight, 1e-8 * weight);
  EXPECT_LT(moment.norm(), 1e-8 * weight);
  // The toe sinks, the heel lifts.
  const double turn = 2 * bench.rotation(1).y();
  EXPECT_GT(turn, 0.0);
  const double exact = 2 * weight / (3 * 0.2 * 1e9) / (3 * 0.2);  // largest pressure/kn over contact length
  EXPECT_NEAR(turn, exact, 0.35 * exact) << "five points a side";
}

TEST(Equilibrium, AnArchStands) {
  const Assembly assembly = generated("arch", {});
  SolverSettings settings;
  StageSettings gravity, free;
  free.kind = StageSettings::Kind::free;
  free.duration = 1.0;
  settings.stages = {gravity, free};
  Simulation simulation(assembly, settings, 1, {});
  ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  EXPECT_FALSE(simulation.equilibrium().relaxed) << simulation.equilibrium().account;
  EXPECT_LT(simulation.equilibrium().residual, 1e-6);
  double most = 0.0;
  for (std::size_t i = 0; i < simulation.model().bodies.size(); ++i)
    for (int c = 0; c < 3; ++c)
      most = std::max(most, std::abs(simulation.state().pose[pose_width * i + std::size_t(c)] -
                                     simulation.state().baseline[pose_width * i + std::size_t(c)]));
  EXPECT_LT(most, 1e-6);
}

/// Horizontal thrust and vertical reactions of the springings add up to the weight.
TEST(Equilibrium, AnArchStandsOnItsReactions) {
  Bench bench(generated("arch", {}), undamped({0, 0, -g}));
  ASSERT_TRUE(bench.balance(1e-8).converged);
  bench.stepper.patches_only();
  const BodyPass pass = bench.stepper.body_pass();
  Vec3 reaction = Vec3::Zero();
  double weight = 0.0;
  for (std::size_t i = 0; i < bench.model.bodies.size(); ++i) {
    if (!bench.model.bodies[i].fixed) {
      weight += bench.model.bodies[i].mass * g;
      continue;
    }
    const BodyUpdate u = pass.update(i);
    reaction += Vec3(u.force.x, u.force.y, u.force.z);
  }
  EXPECT_NEAR(reaction.z(), -weight, 1e-7 * weight);
  EXPECT_LT(reaction.head<2>().norm(), 1e-7 * weight);
}

TEST(Equilibrium, AWallStaysAtRest) {
  const Assembly assembly = generated("wall", {{"length_blocks", 20}, {"courses", 20}});
  SolverSettings settings;
  StageSettings gravity, free;
  free.kind = StageSettings::Kind::free;
  free.duration = 1.0;
  settings.stages = {gravity, free};
  settings.output.history_every = 0.05;
  double most = 0.0;
  Observers observers;
  observers.history = [&](const Simulation&, const Sample& s) {
    most = std::max(most, s.energies.kinetic / std::abs(s.energies.gravitational));
  };
  Simulation simulation(assembly, settings, 2, observers);
  ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  EXPECT_FALSE(simulation.equilibrium().relaxed);
  EXPECT_GT(most, 0.0);
  EXPECT_LT(most, 1e-9);
}

/// A mechanism is told from a structure: a block on a slope steeper than its friction has no equilibrium.
TEST(Equilibrium, OfASlidingBlockIsRefused) {
  Assembly assembly = stone();
  add_box(assembly, {-2, -1, -1}, {2, 1, 0}, true);
  add_box(assembly, {-0.5, -0.5, 0}, {0.5, 0.5, 0.5});
  Bench bench(joined(std::move(assembly), 1e9, 4e8, dry_law(0.3)),
              undamped(g * Vec3(std::sin(0.5), 0, -std::cos(0.5))));
  EXPECT_FALSE(bench.balance(1e-6).converged);
  for (std::uint8_t mode : bench.state.joint.mode) EXPECT_EQ(mode & mode_points, 0) << "nothing half-done is handed on";
  for (double energy : bench.state.joint.energy) EXPECT_EQ(energy, 0.0);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
