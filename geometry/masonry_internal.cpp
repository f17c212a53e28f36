// Internal walls: spandrel walls of part 2, along the bridge between those outside, with fill between them, or with
// nothing below slabs.
#include "geometry/masonry_parts.h"

namespace voussoir {

std::vector<std::pair<double, double>> internal_walls(const Bridge& bridge) {
  std::vector<std::pair<double, double>> walls;
  const int n = bridge.internal.number;
  const double inner = bridge.half_width() - bridge.spandrel_bottom, half = 0.5 * bridge.internal.thickness;
  for (int k = 1; k <= n; ++k) {
    const double y = inner * (2.0 * k / (n + 1) - 1.0);
    walls.emplace_back(y - half, y + half);
  }
  return walls;
}

std::vector<std::pair<double, double>> lanes(const Bridge& bridge, double inner) {
  std::vector<std::pair<double, double>> free;
  double from = -inner;
  if (!bridge.internal.hollow) {
    for (const auto& [y0, y1] : internal_walls(bridge)) {
      free.emplace_back(from, y0);
      from = y1;
    }
  }
  free.emplace_back(from, inner);
  return free;
}

void lay_above_backing(Layout& layout, const Bridge& bridge, const Vec3& low, const Vec3& high, const Unit& unit,
                       int course) {
  if (bridge.backing_line.empty()) {
    if (low.z() >= bridge.backing_top - 1e-9) lay_courses(layout, low, high, unit, course);
    return;
  }
  const SectionLimits usual = layout.limits;
  along_backing(bridge, low.x(), high.x(), [&](double from, double to, const Plane& under) {
    layout.limits.past.push_back(opposite(under));
    lay_courses(layout, {from, low.y(), low.z()}, {to, high.y(), high.z()}, unit, course);
    layout.limits = usual;
  });
}

namespace {

/// Lays slabs from the middle of one wall to that of the next, and onto the spandrel walls.
void lay_slabs(Layout& layout, const Bridge& bridge, const Band& band, double x0, double x1, Unit unit) {
  const double inner = bridge.half_width() - band.thickness;
  std::vector<double> y = {-inner};
  for (const auto& [y0, y1] : internal_walls(bridge)) y.push_back(0.5 * (y0 + y1));
  y.push_back(inner);
  for (std::size_t k = 0; k + 1 < y.size(); ++k) {
    unit.size.y() = y[k + 1] - y[k], unit.size.z() = band.z1 - band.z0;
    lay_above_backing(layout, bridge, {x0, y[k], band.z0}, {x1, y[k + 1], band.z1}, unit, 0);
  }
}

void lay_internal_band(Layout& layout, const Bridge& bridge, const Band& band, int course) {
  const InternalWalls& internal = bridge.internal;
  Unit unit = bridge.unit(Component::spandrel, 2);
  for (const auto& [x0, x1] : between_transverse_walls(bridge)) {
    if (internal.hollow && band.z0 > internal.slab_top - 1e-9) continue;
    if (internal.hollow && band.z0 > internal.slab_bottom() - 1e-9) {
      lay_slabs(layout, bridge, band, x0, x1, unit);
      continue;
    }
    for (const auto& [y0, y1] : internal_walls(bridge)) {
      unit.size.y() = y1 - y0;
      lay_above_backing(layout, bridge, {x0, y0, band.z0}, {x1, y1, band.z1}, unit, course);
    }
  }
}

}  // namespace

void lay_internal_walls(Layout& layout, const Bridge& bridge) {
  if (bridge.internal.number == 0) return;
  const std::size_t first = layout.stones.size();
  int course = 0;
  for (const Band& band : interior_bands(bridge)) {
    lay_internal_band(layout, bridge, band, course);
    course += int(split(band.z0, band.z1, bridge.block.z()).size()) - 1;
  }
  for (std::size_t s = first; s < layout.stones.size(); ++s)
    layout.stones[s].layers = 2;  // not that of the walls outside
}

}  // namespace voussoir
