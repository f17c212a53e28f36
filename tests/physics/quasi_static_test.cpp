// Quasi-static stages against closed forms: springs, a block that slides, one that tips, a support that settles.
#include "solver/run/simulation.h"
#include "tests/restart/copy_state.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"
#include "tools/ladder/fill_models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double weight = 2000.0 * 9.81;  // N, of a cubic metre

/// A cube on a plate that is fixed.
Assembly cube(double friction, double stiffness = 1e9) {
  Assembly assembly = stone(2000.0, 1e9, 0.5);
  add_box(assembly, {-1, -1, -0.5}, {2, 2, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  assembly.groups["plate"] = {0};
  assembly.groups["cube"] = {1};
  return joined(std::move(assembly), stiffness, 0.4 * stiffness, dry_law(friction));
}

StageSettings load_steps(const Vec3& force, std::optional<Vec3> at, int steps) {
  StageSettings stage;
  stage.kind = StageSettings::Kind::quasi_static;
  stage.label = "load steps";
  stage.duration = 1.0;
  stage.loads = Loads{Vec3::Zero(), {{"cube", force, at}}, {}};
  stage.quasi_static.steps = steps;
  return stage;
}

struct Rows {
  std::vector<Sample> all;
  Observers observers() {
    Observers o;
    o.history = [this](const Simulation& run, const Sample& s) {
      if (run.settings().stages[std::size_t(s.stage)].kind == StageSettings::Kind::quasi_static) all.push_back(s);
    };
    return o;
  }
};

Rows rows_of(const Assembly& assembly, const std::vector<StageSettings>& stages) {
  SolverSettings settings;
  settings.stages = stages;
  Rows rows;
  Simulation run(assembly, settings, 1, rows.observers());
  EXPECT_EQ(run.run(), RunEnd::finished) << run.failure();
  return rows;
}

/// Pressed down on its spring: displacement F / k, and the plate bears weight and load at every step. Steps of a second
/// stage begin where the first has left it.
TEST(QuasiStatic, LoadsASpringStepByStep) {
  const double k = 1e9, force = 3.0 * weight;
  StageSettings gravity, more = load_steps({0, 0, -force}, {}, 4), less = load_steps({0, 0, -0.5 * force}, {}, 2);
  const Rows rows = rows_of(cube(0.5), {gravity, more, less});
  ASSERT_EQ(rows.all.size(), 5u + 3u);
  for (std::size_t i = 0; i < 5; ++i) {
    const Sample& s = rows.all[i];
    const double share = 0.25 * double(i);
    EXPECT_EQ(s.step.share, share);
    EXPECT_DOUBLE_EQ(s.time, share);
    EXPECT_NEAR(s.step.force, share * force, 1e-9 * force);
    EXPECT_NEAR(s.step.displacement, share * force / k, 1e-5 * force / k);
    EXPECT_NEAR(s.reactions[0].z(), weight + share * force, 1e-5 * weight);
  }
  EXPECT_NEAR(rows.all[7].step.displacement, 0.5 * force / k, 1e-5 * force / k);  // up, as the change acts
  EXPECT_NEAR(rows.all[7].reactions[0].z(), weight + 0.5 * force, 1e-5 * weight);
}

/// A path with corners: friction that slides one way and the other bears μ W both ways and nothing more, and without
/// load what has slid stays.
TEST(QuasiStatic, PushesABlockToAndFro) {
  const double friction = 0.3, k = 0.4e9;
  StageSettings gravity, push = load_steps({0.1 * weight, 0, 0}, Vec3(0.5, 0.5, 0.0), 40);
  push.quasi_static.path = {1.0, -1.0, 0.0};
  push.quasi_static.push = 2e-3;
  for (const auto method : {StageSettings::Method::newton, StageSettings::Method::relaxation}) {
    push.method = method;
    const Rows rows = rows_of(cube(friction, 1e9), {gravity, push});
    ASSERT_EQ(rows.all.size(), 41u);
    double most = 0.0, least = 0.0;
    for (const Sample& s : rows.all) most = std::max(most, s.step.force), least = std::min(least, s.step.force);
    const bool newton = method == StageSettings::Method::newton;
    measured(std::string("block pushed to and fro: friction, by ") + (newton ? "Newton" : "relaxation"),
             friction * weight, most, "N");
    EXPECT_NEAR(most, friction * weight, 1e-3 * weight * friction);
    EXPECT_NEAR(least, -friction * weight, 1e-3 * weight * friction);
    const Sample &corner = rows.all[10], &next = rows.all[11];
    EXPECT_EQ(corner.step.share, 1.0);
    EXPECT_LT(next.step.force, corner.step.force);  // it turns back at once
    const double slid = corner.step.displacement - corner.step.force / k;
    EXPECT_GT(slid, 0.5e-3);
  }
}

/// Beyond the largest load: a slender block that tips bears F = W (b/2 cos θ − h/2 sin θ) / (h cos θ + b/2 sin θ) at
/// its top, which falls from W b / 2h to nothing at tan θ = b / h.
TEST(QuasiStatic, FollowsATippingBlockBeyondItsLargestLoad) {
  const double b = 0.4, h = 2.0, width = 1.0;
  Assembly assembly = stone(2000.0, 1e9, 0.5);
  add_box(assembly, {-2, -1, -0.5}, {3, 2, 0}, true);
  add_box(assembly, {0, 0, 0}, {b, width, h});
  assembly.groups["cube"] = {1};
  assembly = joined(std::move(assembly), 1e12, 4e11, dry_law(0.9));
  const double w = 2000.0 * 9.81 * b * h * width, most = w * b / (2.0 * h);
  StageSettings gravity, push = load_steps({most, 0, 0}, Vec3(0.5 * b, 0.5, h), 16);
  push.quasi_static.push = 0.32;
  const Rows rows = rows_of(assembly, {gravity, push});
  ASSERT_GE(rows.all.size(), 17u);  // and more where a step had to be halved
  EXPECT_EQ(rows.all.back().step.share, 1.0);
  double worst = 0.0;
  for (const Sample& s : rows.all) {
    if (s.step.share == 0.0) continue;
    // The point is above the middle of the base: x = b/2, at θ to the right about (b, 0).
    double low = 0.0, high = 0.5;
    for (int i = 0; i < 60; ++i) {  // u(θ) = h sin θ + b/2 (1 − cos θ)
      const double t = 0.5 * (low + high);
      (h * std::sin(t) + 0.5 * b * (1.0 - std::cos(t)) < s.step.displacement ? low : high) = t;
    }
    const double c = std::cos(low), sn = std::sin(low);
    const double expected = w * (0.5 * b * c - 0.5 * h * sn) / (h * c + 0.5 * b * sn);
    worst = std::max(worst, std::abs(s.step.force - expected) / most);
  }
  measured("tipping block beyond its largest load: worst difference over the largest", 0.0, worst, "-");
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(rows.all.back().step.force, 0.35 * most);
}

/// Under loads that are given the way ends at the largest, within a step halved four times; the state is the last
/// equilibrium.
TEST(QuasiStatic, EndsAtTheLargestLoad) {
  const double friction = 0.3;
  const StageSettings gravity, push = load_steps({weight, 0, 0}, Vec3(0.5, 0.5, 0.0), 10);
  const Rows rows = rows_of(cube(friction), {gravity, push});
  EXPECT_LE(rows.all.back().step.force, friction * weight * 1.0001);
  EXPECT_GE(rows.all.back().step.force, (friction - 0.1 / 16) * weight * 0.9999);
}

/// … and in a stage that is not the last one that is a failure.
TEST(QuasiStatic, FailsWhereStagesFollow) {
  SolverSettings settings;
  settings.stages = {StageSettings{}, load_steps({weight, 0, 0}, Vec3(0.5, 0.5, 0.0), 10), StageSettings{}};
  const Assembly assembly = cube(0.3);
  Simulation run(assembly, settings, 1, {});
  EXPECT_EQ(run.run(), RunEnd::failed);
  EXPECT_NE(run.failure().find("equilibrium is lost between"), std::string::npos) << run.failure();
}

/// A beam on three pads, of which the middle one settles by δ: u = (W + k δ) / 3 k, and the middle bears k (u − δ).
TEST(QuasiStatic, LetsASupportSettle) {
  Assembly assembly = stone(2000.0, 1e9, 0.5);
  const double k = 0.25 * 1e9;
  for (double x : {0.0, 2.25, 4.5}) add_box(assembly, {x, 0, -0.5}, {x + 0.5, 0.5, 0}, true);
  add_box(assembly, {0, 0, 0}, {5, 0.5, 1});
  assembly.groups["left"] = {0}, assembly.groups["middle"] = {1}, assembly.groups["right"] = {2};
  assembly = joined(std::move(assembly), 1e9, 4e8, dry_law(0.5));
  const double w = 2000.0 * 9.81 * 2.5, settled = 0.4 * w / k;
  StageSettings gravity, steps;
  steps.kind = StageSettings::Kind::quasi_static;
  steps.duration = 1.0;
  steps.drives = {{"middle", Vec3::Zero(), {0, 0, -settled}}};
  steps.quasi_static.steps = 4;
  for (const auto method : {StageSettings::Method::newton, StageSettings::Method::relaxation}) {
    steps.method = method;
    const Rows rows = rows_of(assembly, {gravity, steps});
    ASSERT_EQ(rows.all.size(), 5u);
    for (const Sample& s : rows.all) {
      const double middle = (w - 2.0 * k * s.step.displacement) / 3.0;
      EXPECT_NEAR(s.step.displacement, s.step.share * settled, 1e-12);
      EXPECT_NEAR(s.reactions[1].z(), middle, 1e-3 * w) << s.step.share;  // 0: left, 1: middle
      EXPECT_NEAR(s.step.force, -middle, 1e-3 * w);                       // along the way, which is down
      EXPECT_NEAR(s.reactions[0].z() + s.reactions[1].z() + s.reactions[2].z(), w, 1e-5 * w);
    }
  }
}

/// However far a support goes in one step of relaxation, what it carries along is no loss: the plate lifts the block by
/// a twentieth of its size, which is more than the distance from which a motion is watched.
TEST(QuasiStatic, CarriesABlockFarInOneStep) {
  StageSettings gravity, steps;
  steps.kind = StageSettings::Kind::quasi_static;
  steps.method = StageSettings::Method::relaxation;
  steps.duration = 1.0;
  steps.drives = {{"plate", Vec3::Zero(), {0.0, 0.0, 0.05}}};
  steps.quasi_static.steps = 1;
  const Rows rows = rows_of(cube(0.5), {gravity, steps});
  ASSERT_EQ(rows.all.size(), 2u) << "no step was halved";
  EXPECT_EQ(rows.all.back().step.share, 1.0);
  EXPECT_NEAR(rows.all.back().step.force, weight, 1e-5 * weight);
}

/// A machine on soil: of a Poisson's ratio of zero a column of it is a spring, E A / h, in series with its joints;
/// loaded, unloaded and loaded again by relaxation.
TEST(QuasiStatic, PushesAColumnOfSoil) {
  const double youngs = 80e6, joint = 1e10;
  Assembly assembly = stone();
  add_box(assembly, {-1, -1, -1}, {2, 2, 0}, true);
  add_box(assembly, {0, 0, 1}, {1, 1, 1.5});
  assembly.groups["cube"] = {1};
  assembly = filled(std::move(assembly), box_mesh({0, 0, 0}, {1, 1, 1}, 2, 2, 2),
                    elastic_fill(1500.0, youngs / 3.0, 0.5 * youngs), joint, joint, dry_law(0.7));
  StageSettings gravity, push = load_steps({0, 0, -1e5}, {}, 6);
  push.quasi_static.push = 1e-4;  // m: a strain at which the change of the geometry does not show
  push.quasi_static.path = {1.0, 0.5, 1.0};
  const Rows rows = rows_of(assembly, {gravity, push});
  ASSERT_EQ(rows.all.size(), 8u);                               // three steps, two and two
  const double stiffness = 1.0 / (1.0 / youngs + 2.0 / joint);  // N/m
  for (const Sample& s : rows.all)
    EXPECT_NEAR(s.step.force, stiffness * s.step.displacement, 1e-3 * stiffness * 1e-4) << s.step.share;
  measured("column of soil under a machine: stiffness", stiffness,
           rows.all[3].step.force / rows.all[3].step.displacement, "N/m");
  EXPECT_GT(rows.all[3].step.displacement, 0.5e-4);
}

/// Taken up anew after any step, with other threads, it ends in the same bits.
TEST(QuasiStatic, IsTheSameTakenUpAnywhere) {
  const Assembly assembly = weak_wall(4, 4);
  for (const bool pushed : {false, true}) {
    StageSettings gravity, steps;
    steps.kind = StageSettings::Kind::quasi_static;
    steps.duration = 2.0;
    steps.loads = Loads{Vec3(2.0, 0.0, 0.0), {}, {}};
    steps.quasi_static.steps = 4;
    if (pushed) steps.quasi_static.push = 2e-3;
    SolverSettings settings;
    settings.stages = {gravity, steps};
    Simulation whole(assembly, settings, 1, {});
    ASSERT_EQ(whole.run(), RunEnd::finished) << whole.failure();
    const std::uint64_t hash = hash_arrays(whole.state().arrays());
    for (const double until : {0.5, 1.0, 1.5}) {
      Simulation first(assembly, settings, 2, {}), second(assembly, settings, 1, {});
      ASSERT_EQ(first.run(until), RunEnd::interrupted) << first.failure();
      EXPECT_DOUBLE_EQ(first.state().time(), until);
      copy_state(second.model(), first.state(), second.state());
      second.restore(first.position());
      ASSERT_EQ(second.run(), RunEnd::finished) << second.failure();
      EXPECT_EQ(hash_arrays(second.state().arrays()), hash) << pushed << " " << until;
    }
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
