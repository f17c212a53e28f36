// A rough strip footing on clay (φ = 0): Prandtl's bearing capacity, with the mean volumetric strain of nodes and with
// plain tetrahedra, which lock.
#include "tools/ladder/footing.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

std::vector<Finding> climb_fill_footing(int) {
  const std::string source = "Prandtl: 2 + pi";
  return {
      near("bearing pressure over cohesion", 5.1416, bearing_factor({}), 0.03, "-", source),
      known_miss(near("the same with plain tetrahedra", 5.1416, bearing_factor({.averaged = false}), 0.03, "-", source),
                 "plain tetrahedra lock, because flow at constant volume leaves them too few ways to deform")};
}

}  // namespace

Rung fill_footing() {
  return {.name = "fill-footing",
          .help = "strip footing on clay, with and without mixed discretisation",
          .climb = climb_fill_footing};
}

}  // namespace voussoir::ladder
