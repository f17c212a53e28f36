// Stages in any order: an uninterrupted run ends with the same bits as one that is taken up anew at any stage's end,
// and every gravity stage finds its own equilibrium.
#include <random>

#include "solver/motion/synthesis.h"
#include "solver/run/simulation.h"
#include "tests/restart/copy_state.h"
#include "tests/solver/models.h"
#include "tools/ladder/fill_models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Three loose stones on soil in a trough.
Assembly stones_on_soil() {
  Assembly assembly = stone();
  add_box(assembly, {-1, -1, -1}, {4, 2, 0}, true);
  for (int i = 0; i < 3; ++i) add_box(assembly, {1.0 * i, 0, 1}, {1.0 * i + 1, 1, 1.5});
  assembly.groups["base"] = {0};
  assembly.groups["top"] = {1, 2, 3};
  Material soil = elastic_fill(1500.0, 80e6, 50e6);
  soil.cohesion = 5e3, soil.friction_angle = radians(35.0);
  return filled(std::move(assembly), box_mesh({0, 0, 0}, {3, 1, 1}, 3, 2, 2), soil, 5e8, 2e8, dry_law(0.7));
}

class StageMaker {
 public:
  explicit StageMaker(unsigned seed) : random_(seed) {}

  std::vector<StageSettings> stages(bool with_fill) {
    std::vector<StageSettings> all;
    const int count = 2 + pick(4);
    for (int i = 0; i < count; ++i) {
      const bool at_rest = i == 0 || !all.back().timed();
      all.push_back(pick(5) < (with_fill ? 3 : 2) ? gravity() : timed(at_rest));
      if (pick(3) == 0) all.back().loads = loads();
      if (pick(3) == 0) all.push_back(steps());
    }
    if (pick(4) == 0) all.push_back(collapse());
    return all;
  }

 private:
  int pick(int of) { return int(random_() % unsigned(of)); }

  StageSettings gravity() {
    StageSettings stage;
    stage.method = StageSettings::Method(pick(3));
    if (stage.method == StageSettings::Method::newton) stage.method = StageSettings::Method::automatic;
    stage.allow_motion = true;
    return stage;
  }
  StageSettings timed(bool at_rest) {
    StageSettings stage;
    stage.kind = pick(2) ? StageSettings::Kind::motion : StageSettings::Kind::free;
    stage.duration = 0.04 + 0.02 * pick(3);
    if (stage.kind == StageSettings::Kind::motion) {
      SyntheticSettings synthetic;
      synthetic.seed = 1 + unsigned(pick(9));
      synthetic.peak = 3.0 + 3.0 * pick(3);
      synthetic.duration = 0.1;  // cut by the stage
      synthetic.axes = {true, true, true};
      stage.motion = synthesize(synthetic);
    }
    if (pick(3) == 0) {
      Drive drive;
      drive.group = "base";
      drive.displacement = Vec3(1e-3 * pick(3), 0.0, -1e-3 * pick(3));
      stage.drives.push_back(drive);
    }
    if (at_rest && pick(3) == 0) {
      Placement place;
      place.group = "top";
      place.move = Vec3(0.0, 0.0, 2e-3 * pick(3));
      stage.placements.push_back(place);
    }
    return stage;
  }
  StageSettings steps() {
    StageSettings stage;
    stage.kind = StageSettings::Kind::quasi_static;
    stage.duration = 0.3;
    stage.quasi_static.steps = 1 + pick(3);
    stage.quasi_static.path = {1.0, 0.5 * pick(2)};
    if (pick(2) == 0) {
      stage.loads = loads();
    } else {
      stage.drives = {{"base", Vec3::Zero(), Vec3(1e-4 * pick(3), 0.0, -1e-4)}};
    }
    return stage;
  }
  StageSettings collapse() {
    StageSettings stage;
    stage.kind = StageSettings::Kind::collapse;
    stage.loads = Loads{Vec3(9.81, 0.0, 0.0), {}, {}};
    stage.collapse.tolerance = 0.2;
    stage.collapse.confirm = 0.0;
    return stage;
  }
  Loads loads() { return {Vec3(0.4 * pick(3), 0.0, -0.4 * pick(3)), {}, {}}; }

  std::mt19937 random_;
};

std::string text_of(const std::vector<StageSettings>& stages) {
  std::string text;
  for (const StageSettings& stage : stages)
    text += fmt::format("{}{}{}{} ", "gmfcs"[int(stage.kind)], stage.loads ? "l" : "", stage.drives.empty() ? "" : "d",
                        stage.placements.empty() ? "" : "p");
  return text;
}

/// Runs the stages whole; at each stage's end another simulation takes the state up and goes on to the end.
int compare(const Assembly& assembly, const SolverSettings& settings, unsigned seed) {
  std::vector<std::unique_ptr<Simulation>> resumed;
  Observers observers;
  observers.checkpoint = [&](Simulation& s, bool stage_end) {
    if (!stage_end) return;
    auto next = std::make_unique<Simulation>(assembly, settings, 1 + int(resumed.size()) % 3, Observers{});
    copy_state(next->model(), s.state(), next->state());
    next->restore(s.position());
    resumed.push_back(std::move(next));
  };
  Simulation whole(assembly, settings, 1, observers);
  const RunEnd end = whole.run();
  const std::uint64_t hash = hash_arrays(whole.state().arrays());
  int compared = 0;
  for (std::size_t i = 0; i < resumed.size(); ++i) {
    EXPECT_EQ(resumed[i]->run(), end) << "seed " << seed << ": " << text_of(settings.stages) << "from stage " << i + 1;
    EXPECT_EQ(hash_arrays(resumed[i]->state().arrays()), hash)
        << "seed " << seed << ": " << text_of(settings.stages) << "from stage " << i + 1;
    ++compared;
  }
  return compared;
}

/// Resumed runs compared, over the seeds from `first` on.
int compare_all(const Assembly& assembly, bool with_fill, unsigned first, unsigned seeds) {
  int compared = 0;
  for (unsigned seed = first; seed < first + seeds; ++seed) {
    SolverSettings settings;
    settings.stages = StageMaker(seed).stages(with_fill);
    compared += compare(assembly, settings, seed);
  }
  return compared;
}

TEST(StageOrders, OfAWallEndTheSameWhereverTheyAreTakenUp) {
  EXPECT_GT(compare_all(weak_wall(3, 3), false, 0, 24), 60);
}

TEST(StageOrders, OfStonesOnSoilEndTheSameWhereverTheyAreTakenUp) {
  EXPECT_GT(compare_all(stones_on_soil(), true, 100, 8), 16);
}

/// Whichever stage brings a load: by relaxation in a second stage what Newton's method finds at once.
TEST(StageOrders, TheSecondGravityStageFindsItsOwnEquilibrium) {
  const Assembly assembly = generated("column", {{"blocks", 3}, {"kn", 1e9}, {"ks", 1e9}});
  const auto top_after = [&](int stages, StageSettings::Method method) {
    SolverSettings settings;
    settings.stages.resize(std::size_t(stages));
    for (StageSettings& stage : settings.stages) stage.method = method;
    settings.stages.back().loads = Loads{Vec3(0.2, 0.0, 0.0), {}, {}};
    Simulation run(assembly, settings, 1, {});
    EXPECT_EQ(run.run(), RunEnd::finished) << run.failure();
    return run.state().pose[pose_width * std::size_t(run.model().body_of_block[2])];
  };
  const double expected = top_after(1, StageSettings::Method::newton);
  EXPECT_GT(expected, 1e-7);
  EXPECT_NEAR(top_after(2, StageSettings::Method::newton), expected, 1e-5 * expected);
  EXPECT_NEAR(top_after(2, StageSettings::Method::relaxation), expected, 1e-3 * expected);
}

/// Two g sideways topple a dry stack, in the first gravity stage and in any later one.
TEST(StageOrders, NoStackStandsUnderTwoGSideways) {
  const Assembly assembly = generated("column", {{"blocks", 3}, {"kn", 1e9}, {"ks", 1e9}});
  StageSettings first, second;
  first.method = second.method = StageSettings::Method::relaxation;
  second.loads = Loads{Vec3(20.0, 0.0, 0.0), {}, {}};
  SolverSettings settings;
  settings.stages = {first, second};
  Simulation run(assembly, settings, 1, {});
  EXPECT_EQ(run.run(), RunEnd::failed);
  EXPECT_EQ(run.position().stage, 1);
  EXPECT_FALSE(run.moving().empty());
}

/// The steps of a relaxation are no time: whoever moves afterwards is looked for at the next step, not hundreds later.
TEST(StageOrders, ContactsAreLookedForAfterARelaxation) {
  StageSettings gravity;
  gravity.method = StageSettings::Method::relaxation;
  SolverSettings settings;
  settings.stages = {gravity};
  const Assembly assembly = generated("column", {{"blocks", 3}, {"kn", 1e9}, {"ks", 1e9}});
  Simulation run(assembly, settings, 1, {});
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  ASSERT_GT(run.equilibrium().steps, 100);
  EXPECT_EQ(run.state().step(), 0);
  EXPECT_LE(run.state().look_at(), 1);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
