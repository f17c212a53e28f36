// Plane waves through a column of the fill: compressive and shear.
#include "solver/base/error.h"
#include "tools/ladder/fill_rig.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

/// A column of 60 m whose nodes move along one axis alone; its foot moves by a smooth step. Speed of the peak of the
/// velocity between two heights.
double wave_speed(int along, double expected) {
  constexpr double length = 60.0, cell = 0.3, push = 0.02;  // m, m, s
  FillRig rig(box_mesh({0, 0, 0}, {cell, cell, length}, 1, 1, int(std::lround(length / cell))),
              elastic_fill(1500.0, 800e6 / 3.0, 160e6));
  const auto everywhere = [](const Vec3&) { return true; };
  const auto foot = [](const Vec3& x) { return x.z() < 1e-9; };
  for (int c = 0; c < 3; ++c)
    if (c != along)
      rig.hold(c, everywhere);
    else
      rig.hold(c, foot);
  rig.pass.dt = rig.safe_step(0.5);
  const double heights[2] = {15.0, 36.0};
  double peak[2] = {0, 0}, when[2] = {0, 0};
  std::size_t seen[2] = {0, 0};
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
    for (int h : {0, 1})
      if ((rig.fill.nodes[i] - Vec3(0, 0, heights[h])).norm() < 1e-6) seen[h] = i;
  // Not so long that the wave comes back from the top.
  while (rig.time < heights[1] / expected + 1.5 * push) {
    const double speed = rig.time < push ? 1e-4 * (1.0 - std::cos(2 * pi * rig.time / push)) : 0.0;
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
      if (foot(rig.fill.nodes[i])) rig.set_velocity(i, speed * Vec3::Unit(along));
    rig.step();
    for (int h : {0, 1}) {
      const double v = rig.memory.motion[node_width * seen[h] + std::size_t(along)];
      if (v > peak[h]) peak[h] = v, when[h] = rig.time;
    }
  }
  if (!(when[1] > when[0])) throw RunError("no wave came through the fill");
  return (heights[1] - heights[0]) / (when[1] - when[0]);
}

/// κ + 4/3 μ = 480 MPa and μ = 160 MPa over 1500 kg/m3.
std::vector<Finding> climb_fill_waves(int) {
  return {near("speed of a compressive wave", 565.685, wave_speed(2, 565.685), 0.01, "m/s", "sqrt((K + 4/3 G)/rho)"),
          near("speed of a shear wave", 326.599, wave_speed(0, 326.599), 0.01, "m/s", "sqrt(G/rho)")};
}

}  // namespace

Rung fill_waves() {
  return {.name = "fill-waves", .help = "compressive and shear waves through tetrahedra", .climb = climb_fill_waves};
}

}  // namespace voussoir::ladder
