// A cube of fill pressed between smooth plates under a confining pressure until it flows: its strength is
// Mohr–Coulomb's.
#include "solver/base/error.h"
#include "tools/ladder/fill_rig.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

/// So stiff that the strains, and with them the change of the areas, stay below a ten-thousandth.
Material stiff_soil() {
  Material m = elastic_fill(1500.0, 20e9, 12e9);
  m.cohesion = 20e3, m.friction_angle = radians(40.0), m.tensile_strength = 0.0;
  return m;
}

double strength(double confining) {
  constexpr int n = 2;
  const Material soil = stiff_soil();
  const FillMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1}, n, n, n);
  FillRig rig(mesh, soil);
  for (int c : {0, 1}) rig.press(mesh, surface(mesh, [c](const Vec3& x) { return x[c] > 1.0 - 1e-9; }), confining);
  const auto top = [](const Vec3& x) { return x.z() > 1.0 - 1e-9; };
  for (int c = 0; c < 3; ++c) rig.hold(c, [c](const Vec3& x) { return x[c] < 1e-9; });
  rig.hold(2, top);
  const double even = -confining / (3.0 * rig.fill.laws[0].bulk);  // strain of the confining pressure
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) rig.set_displacement(i, even * rig.fill.nodes[i]);
  rig.pass.dt = rig.safe_step(0.5);
  rig.pass.local = 0.8;
  // The plate goes down by three times the strain at which a bar of the expected strength yields.
  const double far = 3.0 * (50e3 + 5.0 * confining + 1e3) / soil.youngs_modulus;
  constexpr int steps = 20000;
  // All nodes at once, so that no wave runs ahead of the plate.
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
    rig.set_velocity(i, {0, 0, -far / (steps * rig.pass.dt) * rig.fill.nodes[i].z()});
  FillReport report;
  for (int s = 0; s < steps; ++s) report = rig.step();
  if (report.yielding == 0) throw RunError("the cube of fill never yielded");
  rig.stresses();
  return rig.force_on(2, top);
}

/// σ1 = σ3 tan²(45° + φ/2) + 2 c tan(45° + φ/2), c = 20 kPa, φ = 40°.
std::vector<Finding> climb_fill_triaxial(int) {
  std::vector<Finding> findings;
  const double expected[3] = {85.780, 315.726, 1005.562}, confining[3] = {0.0, 50.0, 200.0};
  for (int i = 0; i < 3; ++i)
    findings.push_back(near("strength under " + std::to_string(int(confining[i])) + " kPa", expected[i],
                            strength(1e3 * confining[i]) / 1e3, 1e-3, "kPa", "Mohr-Coulomb"));
  return findings;
}

}  // namespace

Rung fill_triaxial() {
  return {
      .name = "fill-triaxial", .help = "strength of the fill under confining pressure", .climb = climb_fill_triaxial};
}

}  // namespace voussoir::ladder
