// Fixed blocks that a stage drives: what stands on them goes along, and the ledger knows who did the work.
#include "solver/base/error.h"
#include "solver/step/simulation.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace {

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

/// The plate's place is in the state: a run stopped on the way goes on with the same bits.
TEST(Drive, SurvivesARestart) {
  const Assembly assembly = on_a_plate();
  const SolverSettings settings = driven(steady, 0.2, 0.1);
  Simulation whole(assembly, settings, 1, {}), first(assembly, settings, 1, {}), second(assembly, settings, 1, {});
  ASSERT_EQ(whole.run(), RunEnd::finished);
  ASSERT_EQ(first.run(0.1), RunEnd::interrupted);
  const auto from = first.state().arrays();
  const auto to = second.state().arrays();
  for (std::size_t i = 0; i < from.size(); ++i)
    std::visit([&](auto* values) { *values = *std::get<std::remove_const_t<decltype(values)>>(from[i].data); },
               to[i].data);
  second.state().unpack_contacts();
  second.restore(first.position());
  ASSERT_EQ(second.run(), RunEnd::finished);
  EXPECT_EQ(hash_arrays(second.state().arrays()), hash_arrays(whole.state().arrays()));
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

}  // namespace
}  // namespace voussoir::test
