// Parapets that add weight but little stiffness: their joints have a share of their stiffness.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

void apply_parapet_not_structural(Assembly& assembly, const std::string&, const std::vector<double>& values) {
  scale_inside(assembly, component(assembly, Component::parapet), values[0]);
}

std::vector<std::string> places_of_parapet_not_structural(const Assembly& assembly) {
  return all_if_any(assembly, Component::parapet);
}

}  // namespace

Effect parapet_not_structural() {
  return {
      "parapet_not_structural",
      "the parapets add weight but do not stiffen the bridge",
      "Inspect the joints of the parapets. Look for open or later joints, and for a rebuilt parapet on mortar without "
      "bond.",
      {{"factor", "-", "factor on the stiffness of the joints inside the parapets", 0.001, 1.0, 1.0, 0.01, 1.0, true}},
      places_of_parapet_not_structural,
      apply_parapet_not_structural,
      nullptr};
}

}  // namespace voussoir
