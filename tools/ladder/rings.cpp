// A strip of a segmental arch with one thick ring, with two rings that have only friction between them, and with two
// rings and headers, under a load near the quarter span: collapse loads by the solver against limit analysis of the
// same blocks.
#include "tools/ladder/ring_strip.h"
#include "tools/ladder/rung.h"
#include "tools/limit/limit_analysis.h"

namespace voussoir::ladder {

namespace {

/// With headers the collapse load of sliding stones depends more on the loading path, so the `share` is wider.
Finding compared(const std::string& what, const RingStrip& strip, double share, int threads) {
  const Assembly assembly = ring_strip(strip);
  const StripLoad load = load_on(assembly, strip);
  limit::LimitProblem problem;
  problem.loads = {{load.block, load.force, load.at}};
  const bool slides = strip.rings.size() > 1;
  const double expected =
      (slides ? limit::limit_analysis_without_lift(assembly, problem) : limit::limit_analysis(assembly, problem))
          .multiplier;
  return near(what + ": load over weight", expected, collapse_multiplier(assembly, load, expected, threads), share, "-",
              slides ? "linear programs without lift (Gilbert et al. 2006)" : "linear program (Livesley 1978)");
}

std::vector<Finding> climb_rings(int threads) {
  const RingStrip one = {.rings = {0.33}, .voussoirs = 20};
  RingStrip two = one, slippery = one, tied = one;
  two.rings = slippery.rings = tied.rings = {0.165, 0.165};
  slippery.ring_friction = 0.02;
  tied.headers_every = 10;
  return {compared("one thick ring", one, 0.02, threads),
          compared("two rings, friction 0.02 between", slippery, 0.02, threads),
          compared("two rings, friction 0.5", two, 0.02, threads),
          compared("the same with headers every 10 courses", tied, 0.03, threads)};
}

}  // namespace

Rung rings() {
  return {.name = "rings",
          .help = "collapse loads of strips with one ring and with two, with and without headers",
          .climb = climb_rings,
          .slow = true};
}

}  // namespace voussoir::ladder
