// Loads on the road: what reaches the bases, the ledger, loads that move, restarts and threads.
#include "geometry/generator.h"
#include "solver/base/error.h"
#include "solver/run/simulation.h"
#include "tests/restart/copy_state.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// One small span with walls, its fill blocks or a continuum; joints never open.
Assembly bridge(const std::string& backfill) {
  const Generator& generator = find_generator("bridge");
  GeneratorInput in = default_input(generator);
  in.choices["backfill"] = backfill;
  for (const auto& [key, value] : std::map<std::string, double>{{"width", 4.0},
                                                                {"block_scale", 2.0},
                                                                {"fill_edge", 1.0},
                                                                {"span.1.clear_span", 4.0},
                                                                {"abutment.left.length", 2.0},
                                                                {"abutment.right.length", 2.0},
                                                                {"abutment.left.height", 1.0},
                                                                {"abutment.right.height", 1.0}})
    in.values[key] = value;
  for (auto& [name, material] : in.materials) material.cohesion = 1e9, material.tensile_strength = 1e9;
  return generator.build(in);
}

constexpr double whole_load = 80e3;  // N

RoadLoad wheel_at(double x) {
  const RoadArea area = {x - 0.3, x + 0.3, -0.5, 0.7};
  return {area, whole_load / area.area(), "a wheel"};
}

StageSettings standing(double x) {
  StageSettings stage;
  stage.loads = Loads{};
  stage.loads->road = {wheel_at(x)};
  return stage;
}

/// Sum of the vertical reactions of fixed blocks, N.
double reaction(const Assembly& assembly, const std::vector<StageSettings>& stages) {
  SolverSettings settings;
  settings.stages = stages;
  settings.step.equilibrium_tolerance = 1e-8;
  double sum = 0.0;
  Observers observers;
  observers.history = [&](const Simulation&, const Sample& s) {
    sum = 0.0;
    for (const auto& group : s.reactions) sum += group.z();
  };
  Simulation run(assembly, settings, 1, observers);
  EXPECT_EQ(run.run(), RunEnd::finished) << run.failure();
  return sum;
}

TEST(RoadLoad, ReachesTheBasesAsAWhole) {
  for (const char* backfill : {"rigid", "deformable"}) {
    const Assembly assembly = bridge(backfill);
    const double dead = reaction(assembly, {StageSettings{}}), all = reaction(assembly, {standing(3.2)});
    measured(std::string("load on the road, fill ") + backfill, whole_load, std::abs(all - dead), "N");
    EXPECT_NEAR(std::abs(all - dead), whole_load, 1e-4 * whole_load);
  }
}

TEST(RoadLoad, BesideTheRoadIsRefused) {
  const Assembly assembly = bridge("deformable");
  SolverSettings settings;
  settings.stages = {standing(3.2)};
  settings.stages[0].loads->road[0].area.y1 = 1.9;  // under the parapet
  EXPECT_THROW((Simulation{assembly, settings, 1, {}}), InputError);
}

/// Slowly over the bridge and off it again.
std::vector<StageSettings> drive_over(double duration) {
  StageSettings stage;
  stage.kind = StageSettings::Kind::free;
  stage.duration = duration;
  stage.moving = {{wheel_at(-1.0), 10.0 / duration}};
  return {StageSettings{}, stage};
}

/// Height of a keystone, as samples.
struct Followed {
  std::vector<double> time, place;  // s, m
  double balance = 0.0;

  double at(double t) const {  // between two samples
    std::size_t k = 1;
    while (k + 1 < time.size() && time[k] < t) ++k;
    const double share = (t - time[k - 1]) / (time[k] - time[k - 1]);
    return (1.0 - share) * place[k - 1] + share * place[k];
  }
};
Followed follow(const Assembly& assembly, const std::vector<StageSettings>& stages) {
  SolverSettings settings;
  settings.stages = stages;
  settings.damping.kind = DampingSettings::Kind::local;
  settings.output.history_every = 0.02;
  settings.step.equilibrium_tolerance = 1e-8;
  const std::int64_t keystone = assembly.groups.at("keystone 0").front();
  Followed followed;
  Observers observers;
  observers.history = [&](const Simulation& run, const Sample& s) {
    followed.time.push_back(s.time);
    followed.place.push_back(run.state().pose[pose_width * std::size_t(run.model().body_of_block[keystone]) + 2]);
  };
  Simulation run(assembly, settings, 1, observers);
  EXPECT_EQ(run.run(), RunEnd::finished) << run.failure();
  followed.balance = run.worst_balance();
  return followed;
}

/// With joints that never slide nothing remembers where the load has been.
TEST(RoadLoad, ThatMovesSlowlyIsWhereItStands) {
  Assembly assembly = bridge("deformable");
  for (JointLaw& law : assembly.laws) law = elastic_law();
  const double duration = 8.0;
  const Followed moving = follow(assembly, drive_over(duration));
  const double dead = moving.place.front();
  for (const double x : {2.5, 4.0, 5.5}) {
    const double still = follow(assembly, {standing(x)}).place.back() - dead, at = duration * (x + 1.0) / 10.0;
    const double got = moving.at(at) - dead;
    measured("keystone under a slow load at x = " + std::to_string(x), still, got, "m");
    EXPECT_NEAR(got, still, 0.01 * std::abs(still));
  }
  EXPECT_LT(moving.balance, 1e-3);
  EXPECT_NEAR(moving.place.back(), dead, 5e-3 * std::abs(moving.place[moving.place.size() / 2] - dead));
}

TEST(RoadLoad, HasTheSameBitsAfterARestart) {
  const Assembly assembly = bridge("deformable");
  SolverSettings settings;
  settings.stages = drive_over(0.4);
  Simulation whole(assembly, settings, 1, {});
  ASSERT_EQ(whole.run(), RunEnd::finished);
  Simulation first(assembly, settings, 2, {});
  ASSERT_EQ(first.run(0.137), RunEnd::interrupted);
  Simulation second(assembly, settings, 1, {});
  copy_state(second.model(), first.state(), second.state());
  second.restore(first.position());
  ASSERT_EQ(second.run(), RunEnd::finished);
  EXPECT_EQ(hash_arrays(second.state().arrays()), hash_arrays(whole.state().arrays()));
}

/// An acceleration acts on the fill as on stones: the whole bridge weighs sideways what it weighs.
TEST(RoadLoad, AccelerationActsOnTheFill) {
  const Assembly assembly = bridge("deformable");
  StageSettings sideways;
  sideways.loads = Loads{};
  sideways.loads->acceleration = Vec3(0.0, 0.0, -0.981);
  const double dead = reaction(assembly, {StageSettings{}}), more = reaction(assembly, {sideways});
  EXPECT_NEAR(more / dead, 1.1, 1e-5);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
