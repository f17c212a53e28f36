// A rough strip footing pressed into weightless soil: one half of it, as a slice of one cell.
#pragma once
#include "geometry/generate.h"
#include "tools/ladder/fill_rig.h"

namespace voussoir::ladder {

struct Footing {
  double friction = 0.0, dilation = 0.0;  // degrees
  double cell = 0.1;                      // m
  int cells_along = 40, cells_up = 25;    // of the soil
  double settlement = 12.0;               // in units of half-width × cohesion / shear modulus
  int steps = 6000;                       // time steps of the settlement
  int rest = 0;                           // time steps at rest after the settlement
  bool averaged = true;                   // volumetric strains of nodes; else plain tetrahedra
};

/// Mean pressure under the footing divided by the cohesion, over the last 200 time steps. The pressure falls to zero
/// over the cell beyond the last node, so half of this cell is added to the width (as is usual since Vermeer & de
/// Borst 1984).
inline double bearing_factor(const Footing& f) {
  constexpr double half_width = 1.0, cohesion = 1e3;  // m, Pa
  // With this stiffness the collapse occurs at strains of about 0.001, so that displacements remain small.
  Material soil = elastic_fill(2000.0, 200e6, 100e6);
  soil.cohesion = cohesion, soil.tensile_strength = 1e9;
  soil.friction_angle = radians(f.friction), soil.dilation_angle = radians(f.dilation);
  const double width = f.cell * f.cells_along, depth = f.cell * f.cells_up;
  FillRig rig(box_mesh({0, 0, 0}, {width, f.cell, depth}, f.cells_along, 1, f.cells_up), soil);
  rig.pass.averaged = f.averaged;
  const auto footing = [&](const Vec3& x) { return x.z() > depth - 1e-9 && x.x() < half_width + 1e-9; };
  const auto sides = [&](const Vec3& x) { return x.x() < 1e-9 || x.x() > width - 1e-9 || x.z() < 1e-9; };
  rig.hold(0, [&](const Vec3& x) { return sides(x) || footing(x); });
  rig.hold(1, [](const Vec3&) { return true; });
  rig.hold(2, [&](const Vec3& x) { return x.z() < 1e-9 || footing(x); });
  rig.pass.dt = rig.safe_step(0.6);
  rig.pass.local = 0.8;
  const double far = f.settlement * cohesion / soil.shear_modulus * half_width;
  const auto sink = [&](double speed) {
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
      if (footing(rig.fill.nodes[i])) rig.set_velocity(i, {0, 0, -speed});
  };
  sink(far / (f.steps * rig.pass.dt));
  double mean = 0.0;
  for (int s = 0; s < f.steps + f.rest; ++s) {
    if (s == f.steps) sink(0.0);
    rig.step();
    if (s >= f.steps + f.rest - 200) mean += rig.force_on(2, footing) / 200.0;
  }
  return mean / (f.cell * (half_width + 0.5 * f.cell) * cohesion);
}

}  // namespace voussoir::ladder
