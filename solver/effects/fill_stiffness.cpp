// The backfill itself is softer or stiffer than assumed.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

void apply_fill_stiffness(Assembly& assembly, const std::string&, const std::vector<double>& values) {
  scale_inside(assembly, component(assembly, Component::backfill), values[0]);
  scale_fill(assembly, values[0], 1.0);
}

std::vector<std::string> places_of_fill_stiffness(const Assembly& assembly) {
  return all_if_filled(assembly);
}

}  // namespace

Effect fill_stiffness() {
  return {"fill_stiffness",
          "the backfill is softer or stiffer than assumed",
          "Probe the fill from the road (penetration tests): determine its material, density and water content.",
          {{"factor", "-", "factor on the stiffness of its joints, or on its moduli where it is a deformable fill",
            0.05, 20.0, 1.0, 1.0, 0.7, true}},
          places_of_fill_stiffness,
          apply_fill_stiffness,
          nullptr};
}

}  // namespace voussoir
