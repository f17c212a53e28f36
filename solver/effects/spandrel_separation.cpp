// A spandrel wall has separated from the vaults under it: the joints between them are softer.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

void apply_spandrel_separation(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  const BlockSet wall = masonry_part(assembly, where == "both" ? "spandrels" : where);
  scale_between(assembly, wall, component(assembly, Component::arch), values[0]);
}

std::vector<std::string> places_of_spandrel_separation(const Assembly& assembly) {
  std::vector<std::string> names;
  for (const std::string& part : masonry_parts(assembly)) {
    if (part.starts_with("spandrel y")) names.push_back(part);
    if (part == "spandrels") names.push_back("both");
  }
  return names;
}

}  // namespace

Effect spandrel_separation() {
  return {
      "spandrel_separation",
      "a spandrel wall has separated from the vaults",
      "Inspect the edge of the vault from below for a crack along the wall. Measure whether the wall leans outwards.",
      {{"factor", "-", "factor on the stiffness of the joints between the wall and the vaults", 0.001, 1.0, 1.0, 0.1,
        1.0, true}},
      places_of_spandrel_separation,
      apply_spandrel_separation,
      nullptr};
}

}  // namespace voussoir
