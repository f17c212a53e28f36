// A rough strip footing on clay (φ = 0): Prandtl's bearing capacity, with the mean volumetric strain of nodes and with
// plain tetrahedra, which lock.
#include "tools/ladder/fill_rig.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

constexpr double half_width = 1.0, cell = 0.1, cohesion = 1e3;  // m, m, Pa

Material clay() {
  // A stiffness at which collapse comes at strains of a thousandth: what is small stays small.
  Material m = elastic_fill(2000.0, 200e6, 100e6);
  m.cohesion = cohesion, m.tensile_strength = 1e9;
  return m;
}

/// Mean pressure under the footing over the cohesion, at a settlement of `settlement` c/G half-widths: half of the
/// soil, a slice of one cell. The pressure falls to nothing over the cell beyond the last node, so that half of that
/// cell counts (as is usual since Vermeer & de Borst 1984).
double bearing(bool averaged, double settlement) {
  FillRig rig(box_mesh({0, 0, 0}, {4.0, cell, 2.5}, 40, 1, 25), clay());
  rig.pass.averaged = averaged;
  const auto footing = [](const Vec3& x) { return x.z() > 2.5 - 1e-9 && x.x() < half_width + 1e-9; };
  const auto sides = [](const Vec3& x) { return x.x() < 1e-9 || x.x() > 4.0 - 1e-9 || x.z() < 1e-9; };
  rig.hold(0, [&](const Vec3& x) { return sides(x) || footing(x); });
  rig.hold(1, [](const Vec3&) { return true; });
  rig.hold(2, [&](const Vec3& x) { return x.z() < 1e-9 || footing(x); });
  rig.pass.dt = rig.safe_step(0.6);
  rig.pass.local = 0.8;
  constexpr int steps = 6000;
  const double far = settlement * cohesion / clay().shear_modulus * half_width;
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
    if (footing(rig.fill.nodes[i])) rig.set_velocity(i, {0, 0, -far / (steps * rig.pass.dt)});
  double mean = 0.0;
  for (int s = 0; s < steps; ++s) {
    rig.step();
    if (s >= steps - 200) mean += rig.force_on(2, footing) / 200.0;
  }
  return mean / (cell * (half_width + 0.5 * cell) * cohesion);
}

std::vector<Finding> climb(int) {
  const double settlement = 12.0;
  const std::string source = "Prandtl: 2 + pi";
  return {near("bearing pressure over cohesion", 5.1416, bearing(true, settlement), 0.03, "-", source),
          known_miss(near("the same with plain tetrahedra", 5.1416, bearing(false, settlement), 0.03, "-", source),
                     "plain tetrahedra lock: flow at constant volume leaves them too few ways to deform")};
}

}  // namespace

Rung fill_footing() {
  return {
      .name = "fill-footing", .help = "strip footing on clay, with and without mixed discretisation", .climb = climb};
}

}  // namespace voussoir::ladder
