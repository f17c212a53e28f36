// Dead loads of a stage: static and eased, and the ledger's account of their work; forces that a caller decides on
// while time passes (Simulation::push()).
#include "solver/base/error.h"
#include "solver/run/simulation.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double kn = 1e8, ks = 4e7;

/// A cube of 1 m on elastic springs.
Assembly on_springs() {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  assembly.groups["plate"] = {0};
  assembly.groups["cube"] = {1};
  assembly.groups["both"] = {0, 1};
  return joined(std::move(assembly), kn, ks, elastic_law());
}

SolverSettings without_weight(std::vector<StageSettings> stages) {
  SolverSettings settings = undamped();
  settings.stages = std::move(stages);
  return settings;
}

StageSettings loaded(StageSettings::Kind kind, const Loads& loads, double duration) {
  StageSettings stage;
  stage.kind = kind;
  stage.duration = duration;
  stage.loads = loads;
  return stage;
}

const double* pose_of_cube(const Simulation& run) {
  return &run.state().pose[pose_width * std::size_t(run.model().body_of_block[1])];
}

/// A force at the middle of the top presses, pushes and tips: u = F/k, θ = M/(k I), in equilibrium and eased alike;
/// eased, the work is half force times displacement, and a following stage without loads of its own keeps it.
TEST(Load, OnSpringsIsLinear) {
  const Vec3 force(1000.0, 0.0, -500.0);
  Loads loads;
  loads.forces = {{"cube", force, Vec3(0.5, 0.5, 1.0)}};
  // About the joint's centre the force has the moment 1 m × 1000 N, that tips the cube by M / (kn A³/12).
  const double tip = 1000.0 * 1.0 / (kn / 12.0);
  const double u = 1000.0 / ks + 0.5 * tip, w = -500.0 / kn;
  const double work = 0.5 * (1000.0 * (1000.0 / ks + tip) + 500.0 * 500.0 / kn);
  const auto check = [&](const Simulation& run, double share) {
    const double* p = pose_of_cube(run);
    EXPECT_NEAR(p[0], u, share * u);
    EXPECT_NEAR(p[2], w, share * std::abs(w) + 0.5 * tip * tip);
    EXPECT_NEAR(2.0 * p[5], tip, share * tip);
  };
  const Assembly assembly = on_springs();
  Simulation statics(assembly, without_weight({loaded(StageSettings::Kind::gravity, loads, 0.0)}), 1, {});
  ASSERT_EQ(statics.run(), RunEnd::finished) << statics.failure();
  check(statics, 1e-4);

  double done = 0.0;
  Observers observers;
  observers.history = [&](const Simulation&, const Sample& s) { done = s.energies.external_work; };
  StageSettings rest;
  rest.kind = StageSettings::Kind::free;
  rest.duration = 0.2;
  Simulation eased(assembly, without_weight({loaded(StageSettings::Kind::free, loads, 1.0), rest}), 1, observers);
  ASSERT_EQ(eased.run(), RunEnd::finished) << eased.failure();
  check(eased, 1e-3);
  measured("eased force on springs: work", work, done, "J");
  EXPECT_NEAR(done, work, 1e-3 * work);
  EXPECT_LT(eased.worst_balance(), 1e-5);
}

/// An acceleration acts on mass; an empty list of loads takes it away again.
TEST(Load, AccelerationIsWeight) {
  Loads sideways;
  sideways.acceleration = Vec3(0, 3.0, 0);
  const Assembly assembly = on_springs();
  Simulation run(assembly, without_weight({loaded(StageSettings::Kind::gravity, sideways, 0.0)}), 1, {});
  ASSERT_EQ(run.run(), RunEnd::finished);
  const double tip = 2000.0 * 3.0 * 0.5 / (kn / 12.0), u = 2000.0 * 3.0 / ks + 0.5 * tip;
  EXPECT_NEAR(pose_of_cube(run)[1], u, 1e-4 * u);
  Simulation back(assembly,
                  without_weight({loaded(StageSettings::Kind::gravity, sideways, 0.0),
                                  loaded(StageSettings::Kind::free, Loads{}, 1.0)}),
                  1, {});
  ASSERT_EQ(back.run(), RunEnd::finished);
  EXPECT_NEAR(pose_of_cube(back)[1], 0.0, 1e-3 * u);
}

TEST(Load, RefusesWhatCannotBeLoaded) {
  const Assembly assembly = on_springs();
  const auto refused = [&](const ForceLoad& load) {
    Loads loads;
    loads.forces = {load};
    EXPECT_THROW(Simulation(assembly, without_weight({loaded(StageSettings::Kind::gravity, loads, 0.0)}), 1, {}),
                 InputError)
        << load.group;
  };
  refused({"cub", {1, 0, 0}, {}});
  refused({"plate", {1, 0, 0}, {}});
  refused({"both", {1, 0, 0}, {}});
  refused({"both", {1, 0, 0}, Vec3(0, 0, 0)});
}

/// Pulled up by a force, which then stays.
SolverSettings pulled_and_left(double force, double duration) {
  StageSettings gravity, free;
  Loads loads;
  loads.forces = {{"cube", {0, 0, force}, std::nullopt}};
  gravity.loads = loads;
  free.kind = StageSettings::Kind::free;
  free.duration = duration;
  SolverSettings settings = undamped();
  settings.stages = {gravity, free};
  return settings;
}

double height(const Simulation& run) {
  return run.state().pose[pose_width * std::size_t(run.model().body_of_block[1]) + 2];
}
double upward_velocity(const Simulation& run) {
  return run.state().motion[motion_width * std::size_t(run.model().body_of_block[1]) + 2];
}

/// A force against the velocity is a dashpot: the vibration decays by exp(−ξ ω t), and what it takes out of the cube is
/// in the ledger as external work.
TEST(Push, AForceAgainstTheVelocityIsADashpot) {
  const Assembly assembly = on_springs();
  const double mass = assembly.blocks[1].mass, omega = std::sqrt(kn / mass), ratio = 0.02;
  const double dashpot = 2.0 * ratio * std::sqrt(kn * mass), force = 1e5;
  const int cycles = 5;
  double last_peak = 0.0;
  std::int64_t asked = 0;
  Observers observers;
  observers.control = [&](Simulation& run) {
    ++asked;
    PointLoad push;  // also what takes the pull away, which the stages keep
    push.body = run.model().body_of_block[1];
    push.from = push.to = Vec3(0, 0, -force - dashpot * upward_velocity(run));
    run.push({push});
  };
  observers.history = [&](const Simulation& run, const Sample& sample) {
    const double periods = sample.time * omega / (2.0 * pi);
    if (periods > cycles - 0.5) last_peak = std::max(last_peak, height(run));
  };
  SolverSettings settings = pulled_and_left(force, (cycles + 0.5) * 2.0 * pi / omega);
  settings.step.time_step = settings.output.history_every = 1e-4;
  Simulation run(assembly, settings, 1, observers);
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  const double expected = force / kn * std::exp(-ratio * 2.0 * pi * cycles);
  EXPECT_NEAR(last_peak, expected, 0.01 * expected);
  EXPECT_EQ(asked, run.state().step());
  EXPECT_LT(run.worst_balance(), 2e-3);
  measured("cube on springs, pushed against its velocity, 5 periods: amplitude", last_peak, expected, "m");
}

/// Whoever only looks changes nothing, however often.
TEST(Push, LookingChangesNothing) {
  const Assembly assembly = on_springs();
  const auto hash = [&](double every, int& looks) {
    Observers observers;
    observers.control = [&](Simulation&) { ++looks; };
    observers.control_every = every;
    Simulation run(assembly, pulled_and_left(1e5, 0.2), 1, observers);
    EXPECT_EQ(run.run(), RunEnd::finished);
    return hash_arrays(run.state().arrays());
  };
  int often = 0, seldom = 0;
  Simulation plain(assembly, pulled_and_left(1e5, 0.2), 1, {});
  ASSERT_EQ(plain.run(), RunEnd::finished);
  EXPECT_EQ(hash(0.0, often), hash_arrays(plain.state().arrays()));
  EXPECT_EQ(hash(0.05, seldom), hash_arrays(plain.state().arrays()));
  EXPECT_EQ(often, plain.state().step());
  EXPECT_EQ(seldom, 4);
}

TEST(Push, AFixedBlockCannotBePushed) {
  const Assembly assembly = on_springs();
  Simulation run(assembly, pulled_and_left(1e5, 0.2), 1, {});
  PointLoad push;
  push.body = run.model().body_of_block[0];
  push.from = push.to = Vec3(1, 0, 0);
  try {
    run.push({push});
    FAIL() << "a push on a fixed block was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("block 0"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("fixed"), std::string::npos) << error.what();
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
