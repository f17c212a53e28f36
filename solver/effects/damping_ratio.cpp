// More or less damping than the case has.
#include "solver/base/error.h"
#include "solver/effects/effect.h"

namespace voussoir {

namespace {

void apply_damping_ratio(SolverSettings& settings, const std::string&, const std::vector<double>& values) {
  using Kind = DampingSettings::Kind;
  if (settings.damping.kind != Kind::maxwell && settings.damping.kind != Kind::rayleigh)
    throw InputError(
        "effect damping: the case's damping has no ratio; give [damping] kind maxwell or rayleigh with it");
  settings.damping.ratio = values[0];
}

std::vector<std::string> places_of_damping_ratio(const Assembly&) {
  return {"all"};
}

}  // namespace

Effect damping_ratio() {
  return {"damping",
          "the structure damps more, or less, than thought",
          "Record for longer: damping needs far more periods than a frequency.",
          {{"ratio", "-", "share of critical", 0.001, 0.2, 0.02, 0.03, 0.5, true}},
          places_of_damping_ratio,
          nullptr,
          apply_damping_ratio};
}

}  // namespace voussoir
