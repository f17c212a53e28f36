// The same bits for any number of threads, and as the plain serial loop.
#include "solver/run/simulation.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Strong from the first instant.
GroundMotion strong_motion(double duration) {
  GroundMotion motion;
  motion.dt = 0.01;
  for (double t = 0.0; t < duration; t += motion.dt)
    motion.acceleration.emplace_back(9 * std::sin(2 * pi * 3 * t), 8 * std::sin(2 * pi * 4 * t),
                                     4 * std::sin(2 * pi * 5 * t));
  return motion;
}

/// A wall that is shaken to pieces by a stepper with so many threads, contacts looked for as a run does.
std::uint64_t shaken_wall(int threads, DampingSettings::Kind damping, bool shortcut, std::int64_t steps,
                          std::size_t* contacts = nullptr) {
  SolverSettings settings = undamped({0, 0, -9.81});
  settings.damping.kind = damping;
  settings.step.intact_shortcut = shortcut;
  Bench bench(weak_wall(4, 5), settings);
  EXPECT_TRUE(bench.balance(1e-8).converged);
  bench.begin();
  const GroundMotion motion = strong_motion(2.0);
  bench.stepper.motion = &motion;
  bench.stepper.threads = threads;
  EXPECT_TRUE(bench.run(steps));
  if (contacts) *contacts = bench.state.contacts.size();
  return hash_arrays(bench.state.arrays());
}

TEST(Threads, GiveTheSameBits) {
  int runs = 0, equal = 0;
  for (auto damping : {DampingSettings::Kind::maxwell, DampingSettings::Kind::rayleigh, DampingSettings::Kind::local}) {
    for (bool shortcut : {true, false}) {
      if (!shortcut && damping != DampingSettings::Kind::maxwell) continue;
      std::size_t contacts = 0;
      const std::uint64_t one = shaken_wall(1, damping, shortcut, 2500, &contacts);
      if (damping == DampingSettings::Kind::maxwell) {
        EXPECT_GT(contacts, 0u) << "blocks must have met anew for this to mean anything";
      }
      const bool often = damping == DampingSettings::Kind::maxwell && shortcut;
      for (int threads : often ? std::vector<int>{2, 3} : std::vector<int>{2}) {
        const std::uint64_t many = shaken_wall(threads, damping, shortcut, 2500);
        EXPECT_EQ(many, one) << threads << " threads";
        ++runs, equal += many == one;
      }
    }
  }
  measured("2 or 3 threads against 1, wall of 4 x 5, 2500 steps: runs with equal state_hash", runs, equal, "runs");
}

/// Crushing is in the state, and its joints change places with the others of their tile.
TEST(Threads, GiveTheSameBitsWithCompositeJoints) {
  const auto hash = [](int threads, double& crushed) {
    SolverSettings settings = undamped({0, 0, -9.81});
    settings.damping.kind = DampingSettings::Kind::maxwell;
    Bench bench(crushing_wall(6, 6), settings);
    EXPECT_TRUE(bench.balance(1e-8).converged);
    bench.begin();
    const GroundMotion motion = strong_motion(2.0);
    bench.stepper.motion = &motion;
    bench.stepper.threads = threads;
    EXPECT_TRUE(bench.run(2500));
    const Array<double>& crush = bench.state.joint.point_crush;
    crushed = *std::max_element(crush.begin(), crush.end());
    return hash_arrays(bench.state.arrays());
  };
  double crushed = 0.0;
  const std::uint64_t one = hash(1, crushed);
  EXPECT_GT(crushed, 1e-5);
  for (const int threads : {2, 3}) EXPECT_EQ(hash(threads, crushed), one) << threads;
}

/// How far tiles may go ahead of each other is nobody's business: not that of the contacts found either.
TEST(Threads, GiveTheSameBitsHoweverFarTilesGoAhead) {
  const auto hash = [](int ahead, int threads, std::int64_t piece) {
    Bench bench(weak_wall(24, 8), undamped({0, 0, -9.81}));
    EXPECT_TRUE(bench.balance(1e-8).converged);
    bench.begin();
    const GroundMotion motion = strong_motion(2.0);
    bench.stepper.motion = &motion;
    bench.stepper.threads = threads;
    bench.stepper.most_ahead = ahead;
    EXPECT_GT(bench.model.tiles.size(), 2u);
    for (std::int64_t step = 0; step < 1500; step += piece) EXPECT_TRUE(bench.run(std::min(piece, 1500 - step)));
    EXPECT_GT(bench.state.counters[1], 1) << "nothing was looked for";
    return hash_arrays(bench.state.arrays());
  };
  const std::uint64_t alone = hash(1, 1, 1500);
  for (const int ahead : {3, 8, 20}) EXPECT_EQ(hash(ahead, 1, 1500), alone) << ahead;
  EXPECT_EQ(hash(8, 2, 1500), alone);
  EXPECT_EQ(hash(8, 3, 7), alone) << "in pieces of 7 steps";
}

/// Eight threads on fewer cores take turns: fewer steps, and more threads than some passes have work for.
TEST(Threads, GiveTheSameBitsWhenThereAreManyMoreThanCores) {
  const std::uint64_t one = shaken_wall(1, DampingSettings::Kind::maxwell, true, 150);
  int equal = 0;
  for (int threads : {8, 13}) {
    const std::uint64_t many = shaken_wall(threads, DampingSettings::Kind::maxwell, true, 150);
    EXPECT_EQ(many, one) << threads;
    equal += many == one;
  }
  measured("8 and 13 threads against 1, 150 steps: runs with equal state_hash", 2, equal, "runs");
}

/// serial_step(): patch by patch into the sums of both bodies, then body by body; no teams, shares or incidence.
TEST(Threads, EqualTheSerialLoop) {
  if (kernels_are_compiled_apart())
    GTEST_SKIP() << "the kernels for " << kernels().instructions << " are compiled apart";
  std::int64_t compared = 0, equal = 0;
  for (bool shortcut : {true, false})
    for (auto damping : {DampingSettings::Kind::none, DampingSettings::Kind::maxwell, DampingSettings::Kind::local}) {
      SolverSettings settings = undamped({0, 0, -9.81});
      settings.damping.kind = damping;
      settings.step.intact_shortcut = shortcut;
      Bench oracle(weak_wall(4, 5), settings), team(weak_wall(4, 5), settings);
      const GroundMotion motion = strong_motion(2.0);
      for (Bench* bench : {&oracle, &team}) {
        ASSERT_TRUE(bench->balance(1e-8).converged);
        bench->begin();
        bench->stepper.motion = &motion;
      }
      team.stepper.threads = 2;
      // Both go from one decision of the contact search to the next: the team says where, the oracle steps there one by
      // one.
      std::int64_t broken = 0;
      while (team.state.step() < 2500) {
        const Advance a = team.stepper.advance(2500, 1, nullptr, nullptr);
        ASSERT_NE(a.outcome, StepOutcome::runaway);
        while (oracle.state.step() < team.state.step()) serial_step(oracle.stepper);
        ++compared;
        ASSERT_EQ(hash_arrays(oracle.state.arrays()), hash_arrays(team.state.arrays())) << "step " << team.state.step();
        ++equal;
        if (a.outcome != StepOutcome::contacts) continue;
        for (Bench* bench : {&oracle, &team}) {
          update_contacts(bench->model, bench->state, bench->stepper.damping.branches);
          bench->stepper.prepare();
        }
      }
      for (std::uint8_t b : team.state.joint.broken) broken += b;
      EXPECT_GT(broken, 0);
    }
  measured("Two passes, 2 threads, against the serial loop: equal states", double(compared), double(equal), "states");
}

/// Large models have larger tiles. A blow from below breaks joints within a few steps.
TEST(Threads, EqualTheSerialLoopInALargeModel) {
  if (kernels_are_compiled_apart())
    GTEST_SKIP() << "the kernels for " << kernels().instructions << " are compiled apart";
  const Assembly wall = weak_wall(130, 130);
  GroundMotion motion;
  motion.dt = 1.0;
  motion.acceleration = {{300, 300, -300}, {300, 300, -300}};
  const auto hash = [&](int threads) {  // 0: the serial loop
    Bench bench(wall, undamped({0, 0, -9.81}));
    EXPECT_EQ(bench.model.tile_bodies, 128) << bench.model.bodies.size() << " bodies";
    bench.stepper.dt = 1e-4;
    bench.stepper.motion = &motion;
    bench.stepper.threads = threads;
    for (int step = 0; threads == 0 && step < 60; ++step) serial_step(bench.stepper);
    if (threads > 0) {
      EXPECT_TRUE(bench.run(60));
    }
    const auto left_alone = std::count(bench.state.joint.mode.begin(), bench.state.joint.mode.end(), 0);
    EXPECT_LT(left_alone + 100, std::ptrdiff_t(bench.state.joint.mode.size()))
        << "joints must break, or go point by point";
    return hash_arrays(bench.state.arrays());
  };
  const std::uint64_t serial = hash(0);
  EXPECT_EQ(hash(1), serial);
  EXPECT_EQ(hash(2), serial);
}

/// A whole run by Simulation, of a wall large enough that it does share its work.
TEST(Threads, OfASimulationGiveTheSameBits) {
  const Assembly assembly = weak_wall(24, 24);
  std::uint64_t first = 0;
  int equal = 0;
  for (int threads : {1, 2, 3}) {
    SolverSettings settings;
    StageSettings gravity, shaking;
    shaking.kind = StageSettings::Kind::motion;
    shaking.motion = strong_motion(0.3);
    shaking.duration = 0.3;
    settings.stages = {gravity, shaking};
    Simulation simulation(assembly, settings, threads, {});
    EXPECT_EQ(simulation.threads(), threads);
    ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
    const std::uint64_t hash = hash_arrays(simulation.state().arrays());
    if (threads == 1) first = hash;
    EXPECT_EQ(hash, first) << threads << " threads";
    equal += hash == first;
  }
  measured("1, 2 and 3 threads, wall of 24 x 24, whole run: equal state_hash", 3, equal, "runs");
}

/// The same model twice in one process: no memory of the first run is left anywhere.
TEST(Threads, TheSameRunTwiceGivesTheSameBits) {
  EXPECT_EQ(shaken_wall(2, DampingSettings::Kind::maxwell, true, 2000),
            shaken_wall(2, DampingSettings::Kind::maxwell, true, 2000));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
