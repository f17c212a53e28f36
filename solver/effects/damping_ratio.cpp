// A damping ratio that differs from that of the case.
#include "solver/base/error.h"
#include "solver/effects/effect.h"

namespace voussoir {

namespace {

void apply_damping_ratio(SolverSettings& settings, const std::string&, const std::vector<double>& values) {
  using Kind = DampingSettings::Kind;
  if (settings.damping.kind != Kind::maxwell && settings.damping.kind != Kind::rayleigh)
    throw InputError(
        "effect damping: the damping of the case has no ratio. Set [damping] kind to maxwell or rayleigh, with a "
        "ratio.");
  settings.damping.ratio = values[0];
}

std::vector<std::string> places_of_damping_ratio(const Assembly&) {
  return {"all"};
}

}  // namespace

Effect damping_ratio() {
  return {
      "damping",
      "the damping ratio of the structure is higher or lower than assumed",
      "Record for longer: an estimate of the damping ratio needs many more periods than an estimate of the frequency.",
      {{"ratio", "-", "damping ratio, as a share of critical damping", 0.001, 0.2, 0.02, 0.03, 0.5, true}},
      places_of_damping_ratio,
      nullptr,
      apply_damping_ratio};
}

}  // namespace voussoir
