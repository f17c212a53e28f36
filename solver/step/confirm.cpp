#include "solver/step/confirm.h"

#include "solver/step/simulation.h"

namespace voussoir {

bool moves_away(const Assembly& assembly, const SolverSettings& settings, const Loads& loads, double rise, double limit,
                int threads, const std::atomic<bool>* stop) {
  SolverSettings own = settings;
  StageSettings raise, hold;
  raise.kind = hold.kind = StageSettings::Kind::free;
  raise.label = "load raised";
  hold.label = "load held";
  raise.duration = rise;
  raise.loads = loads;
  hold.duration = 2.0 * rise;
  own.stages.insert(own.stages.end(), {raise, hold});
  own.output.fields_every = 0.0;

  std::atomic<bool> ended{false};
  Array<double> held;  // the placement when the full load has come
  bool moved = false;
  Observers observers;
  observers.stop = &ended;
  observers.history = [&](const Simulation& run, const Sample&) {
    if (std::size_t(run.position().stage) + 1 == own.stages.size()) {
      if (held.empty()) held = run.state().pose;
      moved = largest_displacement(run.model(), held, run.state().pose) > limit;
    }
    if (moved || (stop && stop->load())) ended.store(true);
  };
  Simulation run(assembly, own, threads, observers);
  return run.run() == RunEnd::failed || moved;
}

}  // namespace voussoir
