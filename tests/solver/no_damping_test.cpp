// A damping ratio of zero is no damping, whatever kind it is of: no branch without stiffness, no energy that is 0 / 0.
#include "solver/run/runaway.h"
#include "solver/run/simulation.h"
#include "solver/step/energy.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

TEST(NoDamping, IsWhatARatioOfZeroIs) {
  const Assembly assembly = weak_wall(2, 3);
  for (const auto kind : {DampingSettings::Kind::maxwell, DampingSettings::Kind::rayleigh})
    for (const double ratio : {0.0, 1e-300, 1e-12, 1e-8}) {
      SolverSettings settings;
      settings.damping.kind = kind;
      settings.damping.ratio = ratio;
      StageSettings free;
      free.kind = StageSettings::Kind::free;
      free.duration = 0.05;
      settings.stages = {free};
      int rows = 0;
      Observers observers;
      observers.history = [&](const Simulation&, const Sample& s) {
        ++rows;
        for (const auto& [name, term] : energy_terms()) EXPECT_TRUE(std::isfinite(s.energies.*term)) << name;
      };
      Simulation run(assembly, settings, 1, observers);
      EXPECT_EQ(run.run(), RunEnd::finished) << ratio << ": " << run.failure();
      EXPECT_GT(rows, 5);
      EXPECT_LT(run.worst_balance(), 1e-3) << ratio;
    }
}

TEST(NoDamping, WhatIsNotFiniteIsNamedWithItsPlace) {
  Bench bench(weak_wall(2, 3));
  Energies energies;
  EXPECT_EQ(not_finite_text(bench.assembly, bench.stepper, energies), "");
  energies.elastic = std::nan("");
  energies.external_work = std::numeric_limits<double>::infinity();
  bench.pose(1)[0] = std::nan("");
  const std::string text = not_finite_text(bench.assembly, bench.stepper, energies);
  for (const char* piece : {"elastic", "external_work", "block 1"})
    EXPECT_NE(text.find(piece), std::string::npos) << text;
  EXPECT_EQ(text.find("kinetic"), std::string::npos) << text;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
