// A run stopped and taken up again, with another number of threads, ends with the same bits as one that never stopped.
#include <unistd.h>

#include <filesystem>

#include "io/hdf5/checkpoint_file.h"
#include "solver/motion/synthesis.h"
#include "solver/run/simulation.h"
#include "solver/step/make_snapshot.h"
#include "tests/restart/copy_state.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Gravity, a strong motion, a pause, a second motion: damage and new contacts in every part.
SolverSettings shaken(DampingSettings::Kind damping) {
  SyntheticSettings synthetic;
  synthetic.seed = 5;
  synthetic.peak = 9.0;
  synthetic.duration = 0.8;
  synthetic.axes = {true, true, true};
  StageSettings gravity, first, pause, second;
  first.kind = second.kind = StageSettings::Kind::motion;
  first.motion = synthesize(synthetic);
  first.duration = 0.8;
  pause.kind = StageSettings::Kind::free;
  pause.duration = 0.1;
  synthetic.seed = 6;
  second.motion = synthesize(synthetic);
  second.duration = 0.5;
  SolverSettings settings;
  settings.damping.kind = damping;
  settings.stages = {gravity, first, pause, second};
  return settings;
}

std::uint64_t in_one_go(const Assembly& assembly, const SolverSettings& settings, int threads) {
  Simulation simulation(assembly, settings, threads, {});
  EXPECT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  EXPECT_FALSE(simulation.state().contacts.empty()) << "too tame a run to be a test";
  return hash_arrays(simulation.state().arrays());
}

/// Stops at each of the times, hands the state to a new simulation with another number of threads.
std::uint64_t in_pieces(const Assembly& assembly, const SolverSettings& settings, const std::vector<double>& stops) {
  auto simulation = std::make_unique<Simulation>(assembly, settings, 1, Observers{});
  int threads = 1;
  for (double stop : stops) {
    EXPECT_EQ(simulation->run(stop), RunEnd::interrupted);
    threads = threads % 3 + 1;
    auto next = std::make_unique<Simulation>(assembly, settings, threads, Observers{});
    copy_state(next->model(), simulation->state(), next->state());
    next->restore(simulation->position());
    simulation = std::move(next);
  }
  EXPECT_EQ(simulation->run(), RunEnd::finished) << simulation->failure();
  return hash_arrays(simulation->state().arrays());
}

TEST(Restart, GivesTheSameBits) {
  const Assembly assembly = weak_wall(4, 5);
  int runs = 0, equal = 0;
  for (auto damping : {DampingSettings::Kind::maxwell, DampingSettings::Kind::rayleigh, DampingSettings::Kind::none}) {
    const SolverSettings settings = shaken(damping);
    const std::uint64_t whole = in_one_go(assembly, settings, 2);
    for (const std::vector<double>& stops : {std::vector<double>{0.3}, std::vector<double>{0.1, 0.55, 0.85, 1.0}}) {
      const std::uint64_t pieces = in_pieces(assembly, settings, stops);
      EXPECT_EQ(pieces, whole) << int(damping);
      ++runs, equal += pieces == whole;
    }
  }
  measured("Stopped 1 or 4 times and resumed with 1 to 3 threads: equal state_hash", runs, equal, "runs");
}

/// Large enough for the threads to share.
TEST(Restart, GivesTheSameBitsWithOtherThreads) {
  const Assembly assembly = weak_wall(24, 24);
  SolverSettings settings = shaken(DampingSettings::Kind::maxwell);
  settings.stages.resize(2);
  settings.stages[1].duration = 0.35;
  Simulation whole(assembly, settings, 1, {});
  ASSERT_EQ(whole.run(), RunEnd::finished) << whole.failure();
  const std::uint64_t pieces = in_pieces(assembly, settings, {0.12, 0.25}), hash = hash_arrays(whole.state().arrays());
  EXPECT_EQ(pieces, hash);
  measured("Wall of 24 x 24, stopped twice and resumed with 1 to 3 threads: equal state_hash", 1, pieces == hash,
           "runs");
}

/// The state stands in the order of the model's bodies, and nothing but the version of a checkpoint says which that is.
TEST(Restart, AnotherOrderOfBodiesNeedsAnotherVersion) {
  Assembly assembly = stone();
  for (int x = 0; x < 9; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 3; ++z) add_box(assembly, Vec3(1.1 * x, y, z), Vec3(1.1 * (x + 1), y + 1, z + 1), z == 0);
  finish_blocks(assembly);
  const std::vector<std::int64_t> of_version_10 = {
      0,  6,  3,  9,  1,  7,  4,  10, 12, 15, 13, 16, 2,  8,  5,  11, 14, 17, 18, 21, 19, 22, 24, 27, 25, 28, 20,
      23, 26, 29, 30, 33, 31, 34, 32, 35, 36, 39, 37, 40, 38, 41, 42, 45, 43, 46, 48, 51, 49, 52, 44, 47, 50, 53};
  const Model model = build_model(assembly, SolverSettings{});
  EXPECT_EQ(model.block_of_body, of_version_10) << "with another order raise the format_version of checkpoints";
}

/// What has been crushed is in the state.
TEST(Restart, GivesTheSameBitsWithCompositeJoints) {
  const Assembly assembly = crushing_wall(4, 5);
  const SolverSettings settings = shaken(DampingSettings::Kind::maxwell);
  Simulation whole(assembly, settings, 1, {});
  ASSERT_EQ(whole.run(), RunEnd::finished) << whole.failure();
  const Array<double>& crush = whole.state().joint.point_crush;
  ASSERT_FALSE(crush.empty());
  EXPECT_GT(*std::max_element(crush.begin(), crush.end()), 1e-5);
  EXPECT_EQ(in_pieces(assembly, settings, {0.1, 0.55, 0.85}), hash_arrays(whole.state().arrays()));
}

/// What ties have yielded is in the state.
TEST(Restart, GivesTheSameBitsWithTies) {
  Assembly assembly = weak_wall(4, 5);
  const std::int64_t base = assembly.groups.at("base")[0];
  for (const std::int64_t top : assembly.groups.at("top")) {
    const Vec3 head = assembly.blocks[std::size_t(top)].centroid;
    add_tie(assembly, base, {head.x(), -0.5, 0.0}, top, head, 1e7, 4e3, 1e3);
  }
  sort_joints(assembly);
  const SolverSettings settings = shaken(DampingSettings::Kind::maxwell);
  Simulation whole(assembly, settings, 1, {});
  ASSERT_EQ(whole.run(), RunEnd::finished) << whole.failure();
  std::int64_t yielded = 0, taut = 0;
  for (const PatchSnapshot& patch : make_snapshot(whole.model(), whole.state()).patches)
    if (patch.tie) yielded += patch.yielded > 0.0, taut += patch.normal_traction > 0.0;
  EXPECT_GT(yielded, 0);
  EXPECT_LT(taut, 4) << "some are slack in the end";
  const std::uint64_t hash = hash_arrays(whole.state().arrays());
  EXPECT_EQ(in_one_go(assembly, settings, 2), hash);
  EXPECT_EQ(in_pieces(assembly, settings, {0.1, 0.55, 0.85, 1.0}), hash);
}

/// Mass scaling is not in the state: it must come out the same again.
TEST(Restart, GivesTheSameBitsUnderMassScaling) {
  const Assembly assembly = weak_wall(4, 5);
  SolverSettings settings = shaken(DampingSettings::Kind::maxwell);
  const CriticalStep critical = [&] {
    const Bench bench(weak_wall(4, 5));
    return critical_step(bench.model, bench.state);
  }();
  const std::uint64_t unscaled = in_one_go(assembly, settings, 1);
  for (const auto& [step, limit] : {std::pair{1.3 * critical.step, 2.0}, std::pair{0.0, 0.05}}) {
    settings.step.mass_scaling_step = step;
    settings.step.mass_scaling_limit = limit;
    const std::uint64_t whole = in_one_go(assembly, settings, 1);
    EXPECT_EQ(in_pieces(assembly, settings, {0.3}), whole);
    EXPECT_NE(whole, unscaled);
  }
}

/// Checkpoints taken by the run itself, at their times and at the ends of stages, are all good to go on from.
TEST(Restart, FromEveryCheckpointOfARun) {
  const Assembly assembly = weak_wall(4, 5);
  SolverSettings settings = shaken(DampingSettings::Kind::maxwell);
  settings.output.checkpoint_every = 0.25;
  struct Kept {
    std::unique_ptr<Simulation> simulation;
    double time;
  };
  std::vector<Kept> kept;
  Observers observers;
  observers.checkpoint = [&](Simulation& s, bool) {
    auto next = std::make_unique<Simulation>(assembly, settings, 1, Observers{});
    copy_state(next->model(), s.state(), next->state());
    next->restore(s.position());
    kept.push_back({std::move(next), s.state().time()});
  };
  Simulation whole(assembly, settings, 1, observers);
  ASSERT_EQ(whole.run(), RunEnd::finished) << whole.failure();
  const std::uint64_t hash = hash_arrays(whole.state().arrays());
  ASSERT_GE(kept.size(), 8u);  // five within the stages, four at their ends
  int equal = 0;
  for (const Kept& k : kept) {
    EXPECT_EQ(k.simulation->run(), RunEnd::finished) << k.time;
    const std::uint64_t resumed = hash_arrays(k.simulation->state().arrays());
    EXPECT_EQ(resumed, hash) << "from t = " << k.time << ", stage " << k.simulation->position().stage;
    equal += resumed == hash;
  }
  measured("Resumed at every checkpoint of a run: equal state_hash", double(kept.size()), equal, "checkpoints");
}

/// A stop flag set in the middle of a step's piece.
TEST(Restart, AfterAnInterruption) {
  const Assembly assembly = weak_wall(4, 5);
  const SolverSettings settings = shaken(DampingSettings::Kind::maxwell);
  std::atomic<bool> stop{false};
  Observers observers;
  observers.stop = &stop;
  observers.history = [&](const Simulation&, const Sample& s) {
    if (s.time > 0.4) stop = true;
  };
  Simulation first(assembly, settings, 1, observers);
  ASSERT_EQ(first.run(), RunEnd::interrupted);
  EXPECT_NEAR(first.state().time(), 0.4, 0.02);
  Simulation second(assembly, settings, 2, {});
  copy_state(second.model(), first.state(), second.state());
  second.restore(first.position());
  ASSERT_EQ(second.run(), RunEnd::finished);
  EXPECT_EQ(hash_arrays(second.state().arrays()), in_one_go(assembly, settings, 1));
}

/// Through a file.
TEST(Restart, FromACheckpointFile) {
  const auto folder = std::filesystem::temp_directory_path() / ("voussoir_restart_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const Assembly assembly = weak_wall(4, 5);
  const SolverSettings settings = shaken(DampingSettings::Kind::maxwell);
  Simulation first(assembly, settings, 1, {});
  ASSERT_EQ(first.run(0.5), RunEnd::interrupted);
  const RunPosition p = first.position();
  CheckpointHeader header;
  header.time = first.state().time();
  header.step = first.state().step();
  header.stage = p.stage;
  header.numbers = {{"stage_start", p.stage_start},
                    {"dt", p.dt},
                    {"highest", p.highest},
                    {"stiffest", p.stiffest},
                    {"stage_begun", p.stage_begun}};
  const std::string path = (folder / "checkpoint.h5").string();
  const std::uint64_t written = write_checkpoint(path, header, first.state().arrays());
  EXPECT_EQ(written, hash_arrays(first.state().arrays()));

  Simulation second(assembly, settings, 2, {});
  CheckpointHeader read;
  read_checkpoint(path, read, second.state().arrays());
  second.state().unpack(second.model());
  EXPECT_EQ(hash_arrays(second.state().arrays()), written);
  RunPosition q;
  q.stage = read.stage;
  q.stage_start = read.numbers.at("stage_start");
  q.dt = read.numbers.at("dt");
  q.highest = read.numbers.at("highest");
  q.stiffest = read.numbers.at("stiffest");
  q.stage_begun = read.numbers.at("stage_begun");
  second.restore(q);
  ASSERT_EQ(second.run(), RunEnd::finished);
  const std::uint64_t resumed = hash_arrays(second.state().arrays()), whole = in_one_go(assembly, settings, 1);
  EXPECT_EQ(resumed, whole);
  measured("Resumed from a checkpoint file: equal state_hash", 1, resumed == whole, "runs");
  std::filesystem::remove_all(folder);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
