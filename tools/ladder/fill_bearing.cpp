// A rough strip footing on weightless soil with cohesion and friction: Nc = (Nq − 1) cot φ, Nq = e^(π tan φ)
// tan²(45° + φ/2) (Prandtl 1920, Reissner 1924), for soil that flows along the normal of its yield surface. On two
// meshes, pressed in and then left to rest, and pressed in as quickly without rest; and at constant volume.

#include "solver/base/constants.h"
#include "tools/ladder/footing.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

double expected(double friction) {
  const double tan = std::tan(radians(friction)), way = std::tan(radians(45.0 + 0.5 * friction));
  return (std::exp(pi * tan) * way * way - 1.0) / tan;
}

Footing on_soil(double friction, double dilation, double cell, int rest) {
  Footing f{.friction = friction, .dilation = dilation, .cell = cell, .steps = 6000, .rest = rest};
  const bool wide = friction > 25.0;  // the wedges extend farther
  f.cells_along = int(std::lround((wide ? 14.0 : 8.0) / cell)),
  f.cells_up = int(std::lround((wide ? 6.0 : 4.0) / cell));
  f.settlement = wide ? 100.0 : 30.0;
  return f;
}

std::vector<Finding> climb_fill_bearing(int) {
  const std::string source = "Prandtl 1920, Reissner 1924";
  const auto found = [&](const std::string& what, double friction, double dilation, double cell, int rest,
                         double share) {
    return near(what, expected(friction), bearing_factor(on_soil(friction, dilation, cell, rest)), share, "-", source);
  };
  const std::string rate = "inertia and local damping of the flowing fill also resist the moving footing";
  const std::string volume = "flow at constant volume carries less than the associated flow that the formula assumes";
  return {found("friction 20 degrees, five cells under half of the footing", 20, 20, 0.2, 8000, 0.07),
          found("ten cells", 20, 20, 0.1, 12000, 0.04),
          known_miss(found("ten cells, read while the footing sinks", 20, 20, 0.1, 0, 0.04), rate),
          known_miss(found("ten cells, no dilation", 20, 0, 0.1, 12000, 0.04), volume),
          found("friction 30 degrees, five cells", 30, 30, 0.2, 16000, 0.10),
          known_miss(found("five cells, no dilation", 30, 0, 0.2, 16000, 0.10), volume)};
}

}  // namespace

Rung fill_bearing() {
  return {.name = "fill-bearing",
          .help = "strip footing on soil with friction: mesh, speed, dilation",
          .climb = climb_fill_bearing,
          .slow = true};
}

}  // namespace voussoir::ladder
