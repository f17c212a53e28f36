// What an accelerometer on a stone shows: the solver's own change of velocity.
#include "solver/base/constants.h"
#include "solver/run/simulation.h"
#include "solver/step/make_snapshot.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Accelerations and velocities of the assembly's sensors at every step of free or shaken motion.
struct Shown {
  std::vector<std::vector<double>> accelerations, velocities;  // by step, then by sensor
  double dt = 0.0;

  void run(const Assembly& assembly, SolverSettings settings) {
    Observers observers;
    observers.history = [this](const Simulation& run, const Sample& s) {
      if (run.position().stage == 0) return;
      dt = run.position().dt;
      accelerations.push_back(s.accelerations);
      velocities.emplace_back();
      for (const Sensor& sensor : run.assembly().sensors)
        velocities.back().push_back(
            sensor.direction.dot(point_velocity(run.model(), run.state(), sensor.block, sensor.position)));
    };
    settings.output.history_every = 1e-9;  // every step
    Simulation run(assembly, settings, 1, observers);
    ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  }
  /// Largest difference of a sensor's acceleration from the change of its velocity until the next step, and the largest
  /// of both.
  std::pair<double, double> error(std::size_t sensor) const {
    double worst = 0.0, most = 0.0;
    for (std::size_t i = 0; i + 2 < velocities.size(); ++i) {
      const double change = (velocities[i + 1][sensor] - velocities[i][sensor]) / dt;
      worst = std::max(worst, std::abs(change - accelerations[i][sensor]));
      most = std::max(most, std::abs(change));
    }
    return {worst, most};
  }
};

SolverSettings shaken(double amplitude, double frequency) {
  StageSettings gravity, motion;
  motion.kind = StageSettings::Kind::motion;
  motion.duration = 0.3;
  motion.motion.dt = 0.005;
  for (int i = 0; i <= 60; ++i)
    motion.motion.acceleration.push_back({amplitude * std::sin(2.0 * pi * frequency * 0.005 * i), 0.0, 0.0});
  SolverSettings settings;
  settings.stages = {gravity, motion};
  return settings;
}

/// A block on a fixed one, with sensors at its centroid, at a corner and on the fixed one.
Assembly instrumented() {
  Assembly assembly = stone(2000.0, 1e9, 0.5);
  add_box(assembly, {0, 0, -0.5}, {1, 1, 0}, true);
  add_box(assembly, {0.35, 0.35, 0}, {0.65, 0.65, 1.2});
  assembly.sensors = {{"middle", {0.5, 0.5, 0.6}, Vec3::UnitX(), 1},
                      {"corner x", {0.65, 0.65, 1.2}, Vec3::UnitX(), 1},
                      {"corner z", {0.65, 0.65, 1.2}, Vec3::UnitZ(), 1},
                      {"ground", {0.5, 0.5, -0.25}, Vec3::UnitX(), 0}};
  return joined(std::move(assembly), 1e9, 4e8, dry_law(0.6));
}

TEST(SensorAcceleration, IsWhatTheStepDoesToTheVelocity) {
  const Assembly assembly = instrumented();
  SolverSettings settings = shaken(5.0, 3.0);  // the slender block rocks
  Shown shown, finer;
  shown.run(assembly, settings);
  settings.step.time_step = 0.5 * shown.dt;
  finer.run(assembly, settings);
  ASSERT_GT(shown.velocities.size(), 100u);
  const char* names[] = {"middle", "corner x", "corner z", "ground"};
  for (std::size_t s = 0; s < 4; ++s) {
    const auto [worst, most] = shown.error(s);
    const auto [less, same] = finer.error(s);
    measured(std::string("acceleration against change of velocity, ") + names[s] + ", share", 0.0, worst / most, "-");
    EXPECT_GT(most, 0.1);
    // Of the corner the history's velocities are taken with arms a step apart: first order in the step.
    const bool corner = s == 1 || s == 2;
    EXPECT_LT(worst, (corner ? 5e-3 : 1e-9) * most) << names[s];
    if (corner) {
      EXPECT_LT(less / same, 0.7 * worst / most) << names[s];
    }
  }
}

/// A stone in free fall: −g everywhere on it; turning, with what its turning adds.
TEST(SensorAcceleration, OfAFallingStoneIsThatOfGravity) {
  Assembly assembly = stone(2000.0, 1e9, 0.5);
  add_box(assembly, {0, 0, -1.0}, {1, 1, -0.5}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  assembly.sensors = {{"a", {0.1, 0.2, 0.9}, Vec3::UnitZ(), 1}, {"b", {0.1, 0.2, 0.9}, Vec3::UnitX(), 1}};
  StageSettings free;
  free.kind = StageSettings::Kind::free;
  free.duration = 0.05;
  SolverSettings settings;
  settings.stages = {free};
  settings.step.time_step = 1e-3;
  settings.output.history_every = 1e-3;
  std::vector<std::vector<double>> seen;
  Observers observers;
  observers.history = [&](const Simulation&, const Sample& s) { seen.push_back(s.accelerations); };
  const Assembly whole = joined(std::move(assembly), 1e9, 4e8, dry_law(0.6));
  Simulation run(whole, settings, 1, observers);
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  ASSERT_GT(seen.size(), 40u);
  for (const auto& row : seen) {
    EXPECT_NEAR(row[0], -9.81, 1e-9);
    EXPECT_NEAR(row[1], 0.0, 1e-9);
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
