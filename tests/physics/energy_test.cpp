// The energy ledger of whole runs.
#include "solver/motion/pulse.h"
#include "solver/motion/synthesis.h"
#include "solver/run/simulation.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

SolverSettings shaken(const GroundMotion& motion, double duration) {
  SolverSettings settings;
  StageSettings gravity, shaking;
  shaking.kind = StageSettings::Kind::motion;
  shaking.motion = motion;
  shaking.duration = duration;
  settings.stages = {gravity, shaking};
  settings.output.history_every = 1e-9;  // every step
  return settings;
}

JointLaw bond(double strength) {
  JointLaw law = dry_law(0.6);
  law.tension = strength;
  law.cohesion = 1.5 * strength;
  return law;
}

Assembly bonded_column() {
  Assembly assembly = generated("column", {{"blocks", 10}, {"block_height", 0.4}, {"kn", 4e9}, {"ks", 1.6e9}});
  set_law(assembly, bond(1e9));
  return assembly;
}

GroundMotion eight_waves() {
  PulseSettings pulse;
  pulse.amplitude = 3.0;
  pulse.frequency = 4.0;
  pulse.length = 2.0;
  return make_pulse(pulse);
}

/// Undamped and bonded: nothing is lost, and the ledger closes to 0.1 %.
TEST(EnergyBalance, OfAnElasticColumn) {
  const Assembly assembly = bonded_column();
  SolverSettings settings = shaken(eight_waves(), 3.0);
  settings.damping.kind = DampingSettings::Kind::none;
  Energies last;
  double largest_kinetic = 0.0;
  Observers observers;
  observers.history = [&](const Simulation&, const Sample& s) {
    last = s.energies;
    largest_kinetic = std::max(largest_kinetic, s.energies.kinetic);
  };
  Simulation simulation(assembly, settings, 1, observers);
  ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  EXPECT_LT(simulation.worst_balance(), 1e-3);
  EXPECT_GT(largest_kinetic, 100.0);
  EXPECT_EQ(last.lost(), 0.0);
}

/// The same with damping: what the base puts in is stored or booked as lost.
TEST(EnergyBalance, OfADampedColumn) {
  const Assembly assembly = bonded_column();
  for (auto kind : {DampingSettings::Kind::maxwell, DampingSettings::Kind::rayleigh, DampingSettings::Kind::local}) {
    SolverSettings settings = shaken(eight_waves(), 3.0);
    settings.damping.kind = kind;
    Energies last;
    Observers observers;
    observers.history = [&](const Simulation&, const Sample& s) { last = s.energies; };
    Simulation simulation(assembly, settings, 1, observers);
    ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
    EXPECT_LT(simulation.worst_balance(), 1e-3) << int(kind);
    EXPECT_GT(last.joint_damping + last.body_damping, 0.0);
  }
}

struct Damaged {
  double worst = 0.0;
  Energies last;
  std::int64_t contacts = 0;
};

/// A weakly bonded wall under strong synthetic shaking across and along.
Damaged shake_a_wall(DampingSettings::Kind kind, bool shortcut) {
  Assembly assembly = generated("wall", {{"length_blocks", 4}, {"courses", 5}, {"kn", 4e9}, {"ks", 1.6e9}});
  set_law(assembly, bond(2e4));
  SyntheticSettings motion;
  motion.seed = 3;
  motion.peak = 6.0;
  motion.duration = 3.0;
  motion.axes = {true, true, false};
  SolverSettings settings = shaken(synthesize(motion), 3.5);
  settings.damping.kind = kind;
  settings.step.intact_shortcut = shortcut;
  Damaged d;
  Observers observers;
  observers.history = [&](const Simulation&, const Sample& s) {
    d.last = s.energies;
    d.contacts = std::max(d.contacts, s.contacts);
  };
  Simulation simulation(assembly, settings, 1, observers);
  EXPECT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  d.worst = simulation.worst_balance();
  return d;
}

TEST(EnergyBalance, OfADamagedWall) {
  for (auto kind : {DampingSettings::Kind::maxwell, DampingSettings::Kind::none, DampingSettings::Kind::rayleigh}) {
    const Damaged d = shake_a_wall(kind, true);
    EXPECT_LT(d.worst, 0.01) << int(kind);
    EXPECT_GT(d.last.friction, 0.0);
    EXPECT_GT(d.last.fracture, 0.0);
    EXPECT_GT(d.contacts, 0);
  }
  EXPECT_LT(shake_a_wall(DampingSettings::Kind::maxwell, false).worst, 0.01);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
