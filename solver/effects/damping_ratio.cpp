// More or less damping than the case has.
#include "solver/effects/effect.h"

namespace voussoir {

namespace {

void apply(SolverSettings& settings, const std::vector<double>& values) {
  settings.damping.ratio = values[0];
}

std::vector<std::string> places(const Assembly&) {
  return {"all"};
}

}  // namespace

Effect damping_ratio() {
  return {"damping",
          "the structure damps more, or less, than thought",
          {{"ratio", "-", "share of critical", 0.001, 0.2, 0.02, 0.03, 0.5, true}},
          places,
          nullptr,
          apply};
}

}  // namespace voussoir
