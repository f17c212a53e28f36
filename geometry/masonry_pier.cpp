// Piers: solid with battered faces, or a leaf around loose infill.
#include <fmt/format.h>

#include <cmath>

#include "geometry/masonry_parts.h"

namespace voussoir {

namespace {

/// Lays one run of leaf pieces: a box divided along `axis` (0: x, 1: y).
void lay_run(Layout& layout, const Vec3& low, const Vec3& high, int axis, double piece, bool half, const Unit& unit) {
  const std::vector<double> at = split(low[axis], high[axis], piece, half);
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    Vec3 a = low, b = high;
    a[axis] = at[i], b[axis] = at[i + 1];
    lay_stone(layout, {make_box(a, b)}, unit, b - a, false);
  }
}

/// One course of the leaf. `along_y`: the faces along y run through the corners, otherwise those along x.
void lay_leaf_course(Layout& layout, const Vec3& low, const Vec3& high, double t, bool along_y, const Unit& unit) {
  const double in_x = along_y ? t : 0.0, in_y = along_y ? 0.0 : t;
  const double piece = unit.size.x();
  const Vec3 y_low(low.x(), low.y() + in_y, low.z()), y_high(high.x(), high.y() - in_y, high.z());
  lay_run(layout, y_low, {low.x() + t, y_high.y(), high.z()}, 1, piece, !along_y, unit);
  lay_run(layout, {high.x() - t, y_low.y(), low.z()}, y_high, 1, piece, !along_y, unit);
  const Vec3 x_low(low.x() + in_x, low.y(), low.z()), x_high(high.x() - in_x, high.y(), high.z());
  lay_run(layout, x_low, {x_high.x(), low.y() + t, high.z()}, 0, piece, along_y, unit);
  lay_run(layout, {x_low.x(), high.y() - t, low.z()}, x_high, 0, piece, along_y, unit);
}

}  // namespace

void lay_leaf_and_infill(Layout& layout, const Bridge& bridge, const Vec3& low, const Vec3& high, std::size_t support) {
  Unit leaf = bridge.support_unit(support), slab = leaf;
  leaf.size = bridge.leaf_piece;
  const std::vector<double> z = split(low.z(), high.z(), bridge.leaf_piece.z());
  const bool hollow = bridge.supports[support].makeup == Makeup::hollow;
  for (std::size_t k = 0; k + 1 < z.size(); ++k) {
    if (hollow && k + 2 == z.size()) {
      slab.size = {high.x() - low.x(), bridge.leaf_piece.x(), z[k + 1] - z[k]};
      lay_courses(layout, {low.x(), low.y(), z[k]}, high, slab);
      break;
    }
    const double t = bridge.leaf_thickness[k % 2];
    lay_leaf_course(layout, {low.x(), low.y(), z[k]}, {high.x(), high.y(), z[k + 1]}, t, k % 2 == 0, leaf);
    if (hollow) continue;
    const Unit infill = {Component::infill,
                         int(support),
                         bridge.infill_material,
                         {bridge.infill.x(), bridge.infill.y(), 0.5 * (z[k + 1] - z[k])}};
    lay_courses(layout, {low.x() + t, low.y() + t, z[k]}, {high.x() - t, high.y() - t, z[k + 1]}, infill);
  }
}

void lay_solid(Layout& layout, const Solid& solid, const Unit& unit) {
  const auto face = [&](double slope, const Vec3& outward, double at_top) {
    // Points (d, z) on the face: d = at_top + slope (z1 - z), with d measured along `outward`.
    const Vec3 normal = (outward + Vec3(0.0, 0.0, slope)).normalized();
    return Plane{normal, (at_top + slope * solid.z1) / std::sqrt(1.0 + slope * slope)};
  };
  const std::vector<Plane> faces = {face(solid.slope_left, {-1.0, 0.0, 0.0}, -solid.x0),
                                    face(solid.slope_right, {1.0, 0.0, 0.0}, solid.x1),
                                    face(solid.slope_across, {0.0, -1.0, 0.0}, solid.half_width),
                                    face(solid.slope_across, {0.0, 1.0, 0.0}, solid.half_width)};
  const std::vector<double> z = split(solid.z0, solid.z1, unit.size.z());
  for (std::size_t k = 0; k + 1 < z.size(); ++k) {
    // Each course is divided at its own foot, so that only the outer stones are cut, and little.
    const double down = solid.z1 - z[k];
    const double half = solid.half_width + solid.slope_across * down;
    Layout course;
    Unit row = unit;
    row.size.z() = z[k + 1] - z[k];
    lay_courses(course, {solid.x0 - solid.slope_left * down, -half, z[k]},
                {solid.x1 + solid.slope_right * down, half, z[k + 1]}, row, int(k));
    for (Stone& stone : course.stones) {
      for (const Plane& plane : faces) stone.cells[0] = cut(stone.cells[0], plane);
      layout.stones.push_back(std::move(stone));
    }
  }
}

namespace {

/// The uppermost course of a pier, from stone number `from` on.
void name_top(Layout& layout, std::size_t pier, std::size_t from) {
  const auto top = [&](std::size_t s) {
    double z = -1e300;
    for (const Polyhedron& cell : layout.stones[s].cells) z = std::max(z, bounding_box(cell).high.z());
    return z;
  };
  double highest = -1e300;
  for (std::size_t s = from; s < layout.stones.size(); ++s) highest = std::max(highest, top(s));
  auto& group = layout.groups[fmt::format("pier top {}", pier)];
  for (std::size_t s = from; s < layout.stones.size(); ++s)
    if (top(s) > highest - no_masonry) group.push_back(std::int64_t(s));
}

}  // namespace

void lay_piers(Layout& layout, const Bridge& bridge) {
  for (std::size_t i = 1; i < bridge.last_support(); ++i) {
    const std::size_t first = layout.stones.size();
    const Support& support = bridge.supports[i];
    const double z0 = support.base, z1 = support.springing, half = bridge.half_width(i);
    if (support.makeup != Makeup::solid) {
      lay_leaf_and_infill(layout, bridge, {support.x0, -half, z0}, {support.x1, half, z1}, i);
    } else {
      const Solid solid = {support.x0, support.x1, half, z0, z1, support.slope_x, support.slope_x, support.slope_y};
      lay_solid(layout, solid, bridge.support_unit(i));
    }
    name_top(layout, i - 1, first);
    lay_cutwaters(layout, bridge, i);
  }
}

void lay_skewbacks(Layout& layout, const Bridge& bridge) {
  for (std::size_t i = 0; i < bridge.supports.size(); ++i) {
    const Support& support = bridge.supports[i];
    lay_courses(layout, {support.x0, -bridge.half_width(), support.springing},
                {support.x1, bridge.half_width(), support.top}, bridge.support_unit(i));
  }
  layout.limits = bridge.limits();
}

}  // namespace voussoir
