// Transverse walls: across between the spandrel walls over each pier, from the backing to the deck.
#include "geometry/masonry_parts.h"

namespace voussoir {

std::vector<std::pair<double, double>> transverse_walls(const Bridge& bridge) {
  std::vector<std::pair<double, double>> walls;
  if (bridge.transverse_thickness <= 0.0) return walls;
  for (std::size_t i = 1; i < bridge.last_support(); ++i) {
    const double middle = 0.5 * (bridge.supports[i].x0 + bridge.supports[i].x1),
                 half = 0.5 * bridge.transverse_thickness;
    walls.emplace_back(middle - half, middle + half);
  }
  return walls;
}

std::vector<std::pair<double, double>> between_transverse_walls(const Bridge& bridge) {
  std::vector<std::pair<double, double>> free;
  double from = 0.0;
  for (const auto& [x0, x1] : transverse_walls(bridge)) {
    free.emplace_back(from, x0);
    from = x1;
  }
  free.emplace_back(from, bridge.length());
  return free;
}

namespace {

/// One wall in one band, above the backing.
void lay_band(Layout& layout, const Bridge& bridge, std::size_t support, const Band& band, int course) {
  const auto [x0, x1] = transverse_walls(bridge)[support - 1];
  const double inner = bridge.half_width() - band.thickness;
  const Unit unit = bridge.unit(Component::backing, int(support));
  const Polygon& line = bridge.backing_line;
  if (line.empty() && band.z0 >= bridge.backing_top)
    lay_courses(layout, {x0, -inner, band.z0}, {x1, inner, band.z1}, unit, course);
  const SectionLimits usual = layout.limits;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double from = std::max(x0, line[i].x()), to = std::min(x1, line[i + 1].x());
    if (to - from < no_masonry) continue;
    layout.limits.past.push_back(opposite(under_backing(line[i], line[i + 1])));
    lay_courses(layout, {from, -inner, band.z0}, {to, inner, band.z1}, unit, course);
    layout.limits = usual;
  }
}

}  // namespace

void lay_transverse_walls(Layout& layout, const Bridge& bridge) {
  if (transverse_walls(bridge).empty()) return;
  for (std::size_t support = 1; support < bridge.last_support(); ++support) {
    int course = 0;
    for (const Band& band : interior_bands(bridge)) {
      lay_band(layout, bridge, support, band, course);
      course += int(split(band.z0, band.z1, bridge.block.z()).size()) - 1;
    }
  }
}

}  // namespace voussoir
