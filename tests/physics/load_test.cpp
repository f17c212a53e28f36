// Dead loads of a stage: static and eased, and the ledger's account of their work.
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

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
