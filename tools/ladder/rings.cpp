// A strip of a segmental arch of one thick ring, of two and three rings that only rub, and of two rings with headers,
// under a load near the quarter span: collapse loads of the program against limit analysis of the same blocks.
#include <fmt/format.h>

#include "solver/base/error.h"
#include "solver/run/simulation.h"
#include "tools/ladder/ring_strip.h"
#include "tools/ladder/rung.h"
#include "tools/limit/limit_analysis.h"

namespace voussoir::ladder {

namespace {

/// Largest multiplier of a load of the strip's weight, to a two-hundredth of what is expected.
double collapse_multiplier(const Assembly& assembly, const StripLoad& load, double expected, int threads) {
  StageSettings stage;
  stage.kind = StageSettings::Kind::collapse;
  stage.loads = Loads();
  stage.loads->forces = {{load.group, load.force, load.at}};
  stage.collapse.to = 2.0 * expected;
  stage.collapse.tolerance = 0.005 * expected;
  stage.collapse.confirm = 0.0;
  SolverSettings settings;
  settings.stages = {StageSettings{}, stage};
  Simulation run(assembly, settings, threads, {});
  if (run.run() != RunEnd::finished || !run.collapse().found) throw RunError("no collapse load: {}", run.failure());
  return 0.5 * (run.collapse().multiplier + run.collapse().above);
}

struct Compared {
  std::string what;
  RingStrip strip;
  bool lifts;  // dilation is friction, as limit analysis has it; else there is none
};

std::vector<Finding> climb_rings(int threads) {
  const RingStrip one = {.rings = {0.33}}, two = {.rings = {0.165, 0.165}}, three = {.rings = {0.11, 0.11, 0.11}};
  RingStrip tied = two;
  tied.headers_every = 10;
  std::vector<Finding> findings;
  for (const Compared& c : {Compared{"one thick ring", one, true},
                            {"two rings", two, true},
                            {"three rings", three, true},
                            {"two rings, headers every 10 courses", tied, true},
                            {"two rings, no dilation", two, false},
                            {"three rings, no dilation", three, false},
                            {"two rings, headers every 10 courses, no dilation", tied, false}}) {
    RingStrip strip = c.strip;
    strip.lifts = c.lifts;
    const Assembly assembly = ring_strip(strip);
    const StripLoad load = load_on(assembly, strip);
    limit::LimitProblem problem;
    problem.loads = {{load.block, load.force, load.at}};
    const double expected =
        (c.lifts ? limit::limit_analysis(assembly, problem) : limit::limit_analysis_without_lift(assembly, problem))
            .multiplier;
    findings.push_back(
        near(c.what + ": load over weight", expected, collapse_multiplier(assembly, load, expected, threads), 0.02, "-",
             c.lifts ? "linear program, associated friction" : "linear programs without lift (Gilbert et al. 2006)"));
  }
  return findings;
}

}  // namespace

Rung rings() {
  return {.name = "rings",
          .help = "strips of one, two and three rings, with and without headers: collapse loads",
          .climb = climb_rings};
}

}  // namespace voussoir::ladder
