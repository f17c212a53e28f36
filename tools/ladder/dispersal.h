// A wheel, or an axle in plane strain, on a flat fill over a rigid base: the pressure at the base, and its closed
// forms.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/generate.h"
#include "solver/base/constants.h"
#include "tools/ladder/fill_rig.h"

namespace voussoir::ladder {

constexpr double patch_half = 0.15;  // m: a wheel of 0.3 m × 0.3 m, or a strip 0.3 m wide

/// Depths of the rung and of the study, m, and a matching number of cells under half of the patch.
constexpr double dispersal_depths[] = {0.3, 0.6, 1.0};
constexpr int dispersal_cells[] = {4, 3, 2};

struct Dispersal {
  double depth = 0.6;      // m, of the fill
  bool wheel = false;      // else a strip in plane strain
  bool rough = false;      // the base also holds the fill tangentially
  int cells = 3;           // under half of the patch
  double pressure = 1e5;   // Pa, under the patch
  bool yields = false;     // Mohr–Coulomb under its own weight; otherwise elastic and weightless
  double friction = 35.0;  // degrees, without dilation
  double cohesion = 5e3;   // Pa
};

/// Additional pressure at the base due to the patch, along the line under its middle.
struct BasePressure {
  std::vector<double> x, p;  // m from the middle, Pa
  double load = 0.0;         // load of the patch: N, or N/m for a strip
  bool at_rest = true;       // the base carries the load, to a hundredth
  double peak() const { return p.front(); }
  /// Width over which the pressure is at least half of that under the middle, m.
  double half_width() const {
    for (std::size_t i = 1; i < x.size(); ++i)
      if (p[i] < 0.5 * peak())
        return 2.0 * (x[i - 1] + (x[i] - x[i - 1]) * (p[i - 1] - 0.5 * peak()) / (p[i - 1] - p[i]));
    return std::nan("");
  }
  /// Side of the square, or width of the strip, that carries the load at the pressure under the middle, m.
  double equivalent(bool wheel) const { return wheel ? std::sqrt(load / peak()) : load / peak(); }
};

/// The pressure at a base node is its reaction divided by a third of the area of the adjacent triangles.
inline BasePressure base_pressure(const Dispersal& d) {
  const double cell = patch_half / d.cells;
  const int up = int(std::lround(d.depth / cell)), along = d.cells + int(std::lround(2.5 * d.depth / cell));
  const double far = cell * along, top = d.depth, width = d.wheel ? far : cell;
  const FillMesh mesh = box_mesh({0, 0, 0}, {far, width, top}, along, d.wheel ? along : 1, up);
  Material soil = elastic_fill(2000.0, 50e6, 23.1e6);  // Poisson's ratio 0.3
  if (d.yields) {
    soil.cohesion = d.cohesion, soil.tensile_strength = 0.0;
    soil.friction_angle = radians(d.friction), soil.dilation_angle = 0.0;
  }
  FillRig rig(mesh, soil);
  const auto base = [](const Vec3& x) { return x.z() < 1e-9; };
  rig.hold(0, [&](const Vec3& x) { return x.x() < 1e-9 || x.x() > far - 1e-9 || (d.rough && base(x)); });
  rig.hold(1, [&](const Vec3& x) { return !d.wheel || x.y() < 1e-9 || x.y() > width - 1e-9 || (d.rough && base(x)); });
  rig.hold(2, base);
  const auto under_patch = surface(mesh, [&](const Vec3& x) {
    return x.z() > top - 1e-9 && x.x() < patch_half + 1e-9 && (!d.wheel || x.y() < patch_half + 1e-9);
  });
  std::vector<double> area(mesh.nodes.size(), 0.0);
  for (const auto& t : surface(mesh, base)) {
    const auto x = [&](std::size_t k) { return mesh.nodes[std::size_t(t[k])]; };
    for (const std::int32_t node : t) area[std::size_t(node)] += (x(1) - x(0)).cross(x(2) - x(0)).norm() / 6.0;
  }
  rig.pass.dt = rig.safe_step(0.6);
  rig.pass.local = 0.8;
  const auto held_up = [&] { return -rig.force_on(2, base); };
  const double load = d.pressure * patch_half * (d.wheel ? patch_half : cell);  // on the part that is modelled
  const auto rest = [&](double wanted) {
    constexpr int round = 200, rounds = 150;
    for (int k = 0; k < rounds; ++k) {
      const double before = held_up();
      for (int s = 0; s < round; ++s) rig.step();
      if (std::abs(held_up() - wanted) < 2e-3 * load && std::abs(held_up() - before) < 1e-3 * load) break;
    }
  };
  if (d.yields) {
    rig.pass.gravity = {0, 0, -standard_gravity};
    rest(soil.density * standard_gravity * far * width * top);
  }
  const double weight = d.yields ? held_up() : 0.0;
  std::vector<double> before(mesh.nodes.size(), 0.0);
  const auto reaction = [&](std::size_t node) { return -rig.force(std::size_t(rig.fill.node_of[node]))[2]; };
  for (std::size_t i = 0; i < before.size(); ++i)
    if (base(mesh.nodes[i])) before[i] = d.yields ? reaction(i) : 0.0;
  const int parts = d.yields ? 20 : 1;
  for (int part = 1; part <= parts; ++part) {
    rig.press(mesh, under_patch, d.pressure / parts);
    if (part < parts)
      for (int s = 0; s < 200; ++s) rig.step();
  }
  rest(weight + load);
  BasePressure found;
  found.load = d.pressure * 2.0 * patch_half * (d.wheel ? 2.0 * patch_half : 1.0);
  found.at_rest = std::abs(held_up() - weight - load) < 0.01 * load;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vec3& x = mesh.nodes[i];
    if (!base(x) || x.y() > 1e-9) continue;
    double force = reaction(i) - before[i], over = area[i];
    if (!d.wheel) {  // both sides of the slice
      for (std::size_t j = i + 1; j < mesh.nodes.size(); ++j)
        if (base(mesh.nodes[j]) && std::abs(mesh.nodes[j].x() - x.x()) < 1e-9 && mesh.nodes[j].y() > 1e-9)
          force += reaction(j) - before[j], over += area[j];
    }
    found.x.push_back(x.x()), found.p.push_back(force / over);
  }
  return found;
}

/// Share of a pressure wave on an elastic layer that reaches a smooth rigid base, as a function of k = depth × wave
/// number, for any Poisson's ratio (Filon 1903; Timoshenko & Goodier 1970, art. 24: the middle plane of a layer of
/// twice the thickness that is pressed from both sides). It holds for waves in both directions, because each of them
/// is in plane strain.
inline double arriving(double k) {
  if (k < 1e-6) return 1.0;
  if (k > 300.0) return 0.0;
  return 2.0 * (std::sinh(k) + k * std::cosh(k)) / (std::sinh(2.0 * k) + 2.0 * k);
}

/// Pressure (Pa) on a smooth base at x (m) from the middle, by Simpson's rule over the waves: (2 p/π) ∫ sin(k a)/k T
/// cos(k x) dk, with T = arriving(k depth) and a = patch_half. Under a wheel the integral is over both directions.
inline double smooth_base_pressure(const Dispersal& d, double x) {
  constexpr int steps = 400;
  const double most = 24.0 / d.depth, h = most / steps, a = patch_half;
  const auto weight = [&](int i) { return (i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * h / 3.0; };
  const auto spread = [&](double k) { return k < 1e-12 ? a : std::sin(k * a) / k; };
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double k = i * h, along = weight(i) * spread(k) * std::cos(k * x);
    if (!d.wheel) {
      sum += along * arriving(k * d.depth);
      continue;
    }
    for (int j = 0; j <= steps; ++j)
      sum += along * weight(j) * spread(j * h) * arriving(std::hypot(k, j * h) * d.depth) * 2.0 / std::numbers::pi;
  }
  return d.pressure * 2.0 / std::numbers::pi * sum;
}

/// Pressure (Pa) in a half-space at the same depth, at x (m) from the middle (Boussinesq 1885). That of a wheel follows
/// from the corners of rectangles (Newmark 1935).
inline double half_space_pressure(const Dispersal& d, double x) {
  const double z = d.depth, a = patch_half;
  if (!d.wheel) {
    const auto side = [&](double u) { return std::atan(u / z) + u * z / (u * u + z * z); };
    return d.pressure / std::numbers::pi * (side(x + a) - side(x - a));
  }
  const auto corner = [&](double l) {  // of a rectangle l × a
    const double r1 = l * l + z * z, r2 = a * a + z * z, r3 = std::sqrt(l * l + a * a + z * z);
    return (std::atan(l * a / (z * r3)) + l * a * z / r3 * (1.0 / r1 + 1.0 / r2)) / (2.0 * std::numbers::pi);
  };
  return d.pressure * 2.0 * (corner(x + a) - corner(x - a));
}

/// A closed form as a profile, for its peak and widths.
template <class Form>
BasePressure profile(const Dispersal& d, const Form& form) {
  BasePressure found;
  found.load = d.pressure * 2.0 * patch_half * (d.wheel ? 2.0 * patch_half : 1.0);
  for (int i = 0; i <= 60; ++i) {
    found.x.push_back(i * (patch_half + 1.5 * d.depth) / 60.0);
    found.p.push_back(form(d, found.x.back()));
  }
  return found;
}

/// Side or width over which a code distributes the patch load uniformly, m. `slope` is horizontal over vertical on
/// each side.
inline double spread_width(const Dispersal& d, double slope) {
  return 2.0 * (patch_half + slope * d.depth);
}
inline constexpr double cs454_slope = 0.5;                     // two down to one along (CS 454)
inline const double ec1_fill_slope = std::tan(radians(30.0));  // EN 1991-2, 4.9.1, through backfill
inline constexpr double ec1_ballast_slope = 0.25;              // four to one (EN 1991-2, 6.3.6)

}  // namespace voussoir::ladder
