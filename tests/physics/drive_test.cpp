// Fixed blocks that a stage drives: what stands on them goes along, and the ledger knows who did the work.
#include "solver/base/error.h"
#include "solver/run/simulation.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// A block on a plate, and beside the plate another one that stays.
Assembly on_a_plate() {
  Assembly assembly = stone(2000.0, 1e9, 0.5);
  add_box(assembly, {0, 0, -0.5}, {1, 1, 0}, true);
  add_box(assembly, {2, 0, -0.5}, {3, 1, 0}, true);
  add_box(assembly, {0.25, 0.25, 0}, {0.75, 0.75, 0.5});
  add_box(assembly, {2.25, 0.25, 0}, {2.75, 0.75, 0.5});
  assembly.groups["plate"] = {0};
  return joined(std::move(assembly), 1e9, 4e8, dry_law(0.6));
}

SolverSettings driven(const Drive& drive, double duration, double rest) {
  StageSettings gravity, moving, after;
  moving.kind = after.kind = StageSettings::Kind::free;
  moving.duration = duration, after.duration = rest;
  moving.drives = {drive};
  SolverSettings settings;
  settings.stages = {gravity, moving, after};
  return settings;
}

const Drive steady = {"plate", {0.02, 0.0, 0.05}, Vec3::Zero()};
const Drive eased = {"plate", Vec3::Zero(), {0.004, 0.0, 0.010}};

Vec3 displacement(const Simulation& run, std::int64_t block) {
  const double* pose = &run.state().pose[pose_width * std::size_t(run.model().body_of_block[block])];
  return {pose[0], pose[1], pose[2]};
}

/// What the ledger says at the end of a run, and the worst it said of itself.
struct Ledger {
  double worst = 0.0, work = 0.0;

  Observers observers() {
    Observers all;
    all.history = [this](const Simulation&, const Sample& s) {
      worst = std::max(worst, std::abs(s.balance_error));
      work = s.energies.external_work;
    };
    return all;
  }
};

/// From rest to rest so gently (1.7 m/s2 upwards, 0.7 m/s2 sideways at most) that the block neither parts nor slides:
/// it ends where the plate carries it, and the work is weight times height.
TEST(Drive, TakesAlongWhatStandsOnIt) {
  const Assembly assembly = on_a_plate();
  Ledger ledger;
  Simulation run(assembly, driven(eased, 0.2, 0.1), 1, ledger.observers());
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  EXPECT_LT((displacement(run, 0) - eased.displacement).norm(), 1e-12);
  EXPECT_EQ(displacement(run, 1), Vec3(0, 0, 0));
  const Vec3 rest = displacement(run, 3);  // what the weight pressed the springs by
  const double drift = (displacement(run, 2) - rest - eased.displacement).norm();
  measured("block carried by its plate: drift", 0.0, drift, "m");
  EXPECT_LT(drift, 1e-6);
  const double lifting = 2000.0 * 0.125 * 9.81 * eased.displacement.z();
  measured("block carried by its plate: work", lifting, ledger.work, "J");
  EXPECT_NEAR(ledger.work, lifting, 1e-4 * lifting);
  EXPECT_LT(ledger.worst, 1e-5);
}

/// At constant velocity the plate goes exactly as far, whatever the block does meanwhile.
TEST(Drive, GoesAsFarAsItsVelocityTakesIt) {
  const Assembly assembly = on_a_plate();
  Ledger ledger;
  SolverSettings settings = driven(steady, 0.2, 0.1);
  settings.step.time_step = 1e-4;  // the block bounces: at the critical step a bounce takes three steps
  Simulation run(assembly, settings, 1, ledger.observers());
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  EXPECT_LT((displacement(run, 0) - 0.2 * steady.velocity).norm(), 1e-12);
  EXPECT_LT(ledger.worst, 1e-3);
}

/// A block held by springs between two plates, one of which goes d: the springs are in series, so the force is k d / 2,
/// the work k d² / 4 and the block goes d / 2.
TEST(Drive, StretchesSpringsInSeries) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -0.5}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  add_box(assembly, {0, 0, 1}, {1, 1, 1.5}, true);
  assembly.groups["plate"] = {2};
  assembly = joined(std::move(assembly), 1e8, 4e7, elastic_law());
  const double d = 1e-3;
  SolverSettings settings = driven({"plate", Vec3::Zero(), {0, 0, d}}, 0.5, 0.1);
  settings.gravity = Vec3::Zero();
  settings.damping.kind = DampingSettings::Kind::none;
  Ledger ledger;
  Simulation run(assembly, settings, 1, ledger.observers());
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  EXPECT_NEAR(displacement(run, 1).z(), 0.5 * d, 1e-4 * d);
  const double stored = 0.25 * 1e8 * d * d;
  measured("springs in series, one end driven: work", stored, ledger.work, "J");
  EXPECT_NEAR(ledger.work, stored, 1e-3 * stored);
  EXPECT_LT(ledger.worst, 1e-5);
}

/// The hash of the state after a run that was stopped at this time (s) and taken up by another simulation.
std::uint64_t in_two_pieces(const Assembly& assembly, const SolverSettings& settings, double stop) {
  Simulation first(assembly, settings, 1, {}), second(assembly, settings, 1, {});
  EXPECT_EQ(first.run(stop), RunEnd::interrupted);
  const auto from = first.state().arrays();
  const auto to = second.state().arrays();
  for (std::size_t i = 0; i < from.size(); ++i)
    std::visit([&](auto* values) { *values = *std::get<std::remove_const_t<decltype(values)>>(from[i].data); },
               to[i].data);
  second.state().unpack(second.model());
  second.restore(first.position());
  EXPECT_EQ(second.run(), RunEnd::finished);
  return hash_arrays(second.state().arrays());
}

/// The plate's place is in the state: a run stopped on the way goes on with the same bits.
TEST(Drive, SurvivesARestart) {
  const Assembly assembly = on_a_plate();
  const SolverSettings settings = driven(steady, 0.2, 0.1);
  Simulation whole(assembly, settings, 1, {});
  ASSERT_EQ(whole.run(), RunEnd::finished);
  EXPECT_EQ(in_two_pieces(assembly, settings, 0.1), hash_arrays(whole.state().arrays()));
}

constexpr double sampling = 0.01;  // s

/// One wave of 2 m/s² and 2 Hz along x, times a factor, that begins at this sample.
GroundMotion wave(double factor, int begin) {
  GroundMotion motion = {sampling, std::vector<Vec3>(std::size_t(begin + 51), Vec3::Zero())};
  for (int i = 0; i <= 50; ++i)
    motion.acceleration[std::size_t(begin + i)].x() = factor * 2.0 * std::sin(2.0 * pi * 2.0 * sampling * i);
  motion.acceleration.back().setZero();
  return motion;
}

/// A block that springs hold on a fixed one; it sways at some 4 Hz.
Assembly on_springs() {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -0.5}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  assembly.groups["support"] = {0};
  return joined(std::move(assembly), 1e7, 4e6, elastic_law());
}

SolverSettings shaken(const GroundMotion& motion, const std::vector<Drive>& drives, double time_step) {
  StageSettings stage;
  stage.kind = StageSettings::Kind::motion;
  stage.duration = 1.0;
  stage.motion = motion;
  stage.drives = drives;
  SolverSettings settings = undamped();
  settings.step.time_step = time_step;
  settings.stages = {stage};
  return settings;
}

Drive otherwise(double factor, double delay) {
  Drive drive;
  drive.group = "support";
  drive.factor = factor, drive.delay = delay;
  return drive;
}

struct Ways {
  std::vector<double> time;
  std::vector<Vec3> support, block;
};

Ways ways(const GroundMotion& motion, const std::vector<Drive>& drives, double time_step) {
  const Assembly assembly = on_springs();
  Ways found;
  Observers observers;
  observers.history = [&](const Simulation& run, const Sample& s) {
    found.time.push_back(s.time);
    found.support.push_back(displacement(run, 0));
    found.block.push_back(displacement(run, 1));
    EXPECT_LT(std::abs(s.balance_error), 1e-5);
  };
  Simulation run(assembly, shaken(motion, drives, time_step), 1, observers);
  EXPECT_EQ(run.run(), RunEnd::finished) << run.failure();
  return found;
}

/// A support that makes `factor` of the ground's motion, `late` samples later, against the same on a ground that itself
/// moves so; returns how much the block's distance from its support differs, as a share of the largest.
/// What the leapfrog makes of an accelerogram that begins with zero, at steps Δt that divide its sampling, is
/// u − Δt² a/6: for a = c t, Δt² Σ (N − n) c n Δt = c t³/6 − c t Δt²/6, and a is a sum of such ramps. The drive takes
/// the exact u, so the supports differ by Δt² (f a(t − τ) − a(t))/6.
double difference(double factor, int late, double time_step) {
  const GroundMotion ground = wave(1.0, 20), own = wave(factor, 20 + late);
  const double delay = sampling * late;
  const Ways driven = ways(ground, {otherwise(factor, delay)}, time_step), moved = ways(own, {}, time_step);
  EXPECT_EQ(driven.time, moved.time);
  double worst = 0.0, way = 0.0, most = 0.0, apart = 0.0;
  for (std::size_t i = 0; i < driven.time.size(); ++i) {
    const double t = driven.time[i];
    const Vec3 law = time_step * time_step / 6.0 * (base_acceleration(&own, t) - base_acceleration(&ground, t));
    worst = std::max(worst, (driven.support[i] - moved.support[i] - law).norm());
    way = std::max(way, moved.support[i].norm());
    const Vec3 one = driven.block[i] - driven.support[i], other = moved.block[i] - moved.support[i];
    most = std::max(most, other.norm());
    apart = std::max(apart, (one - other).norm());
  }
  EXPECT_GT(way, 0.01);
  EXPECT_GT(most, 1e-3);
  EXPECT_LT(worst, 1e-12);
  return apart / most;
}

TEST(Drive, OtherwiseThanTheGroundIsAnotherGround) {
  for (const auto& [factor, late] : {std::pair{0.5, 10}, std::pair{1.5, -10}}) {
    SCOPED_TRACE(factor);
    const double coarse = difference(factor, late, 4e-5), fine = difference(factor, late, 2e-5);
    measured("support that makes its own share of the motion, against another ground: difference of the block's way",
             0.0, fine, "of the largest");
    EXPECT_LT(fine, 1e-6);
    EXPECT_NEAR(coarse / fine, 4.0, 0.2) << "second order in the time step";
  }
}

/// With factor 0 the support stays where it is in space while the ground goes away from under it.
TEST(Drive, WithoutAShareOfTheGroundStays) {
  const Ways found = ways(wave(1.0, 20), {otherwise(0.0, 0.0)}, 1e-4);
  for (const Vec3& support : found.support) EXPECT_LT(support.norm(), 1e-4 * 1e-4 / 6.0 * 2.0 * 1.001);
  for (const Vec3& block : found.block) EXPECT_LT(block.norm(), 1e-7);
}

TEST(Drive, WithTheGroundChangesNoBits) {
  const Assembly assembly = on_springs();
  const GroundMotion motion = wave(1.0, 20);
  Simulation plain(assembly, shaken(motion, {}, 1e-3), 1, {}),
      with(assembly, shaken(motion, {otherwise(1.0, 0.0)}, 1e-3), 1, {});
  ASSERT_EQ(plain.run(), RunEnd::finished);
  ASSERT_EQ(with.run(), RunEnd::finished);
  EXPECT_EQ(hash_arrays(with.state().arrays()), hash_arrays(plain.state().arrays()));
}

/// The ground's path is made of the motion and the time alone: stopped in the midst of it, a run ends with the same
/// bits.
TEST(Drive, OtherwiseThanTheGroundSurvivesARestart) {
  const Assembly assembly = on_springs();
  SolverSettings settings = shaken(wave(1.0, 20), {otherwise(0.5, 0.1)}, 1e-3);
  StageSettings before;
  before.kind = StageSettings::Kind::free;
  before.duration = 0.1;
  settings.stages.insert(settings.stages.begin(), before);
  const std::uint64_t whole = [&] {
    Simulation run(assembly, settings, 1, {});
    EXPECT_EQ(run.run(), RunEnd::finished) << run.failure();
    return hash_arrays(run.state().arrays());
  }();
  for (const double stop : {0.05, 0.45, 0.83}) EXPECT_EQ(in_two_pieces(assembly, settings, stop), whole) << stop;
}

TEST(Drive, RefusesWhatIsNotThereOrNotFixed) {
  Assembly assembly = on_a_plate();
  assembly.groups["block"] = {2};
  assembly.groups["again"] = {0};
  const auto refused = [&](std::vector<Drive> drives) {
    SolverSettings settings = driven(steady, 0.2, 0.1);
    settings.stages[1].drives = std::move(drives);
    EXPECT_THROW(Simulation(assembly, settings, 1, {}), InputError) << settings.stages[1].drives[0].group;
  };
  refused({{"beam", {1, 0, 0}, Vec3::Zero()}});
  refused({{"block", {1, 0, 0}, Vec3::Zero()}});
  refused({steady, {"again", {1, 0, 0}, Vec3::Zero()}});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
