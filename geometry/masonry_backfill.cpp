// The backfill: between the spandrel walls, over backing and vaults, up to the deck, and between wing walls.
#include <cmath>

#include "geometry/masonry_parts.h"

namespace voussoir {

std::pair<double, double> wing_extent(const Bridge& bridge, std::size_t i) {
  const Support& support = bridge.supports[i];
  const double x0 = support.x0, x1 = support.x1;
  const double leaf = support.makeup == Makeup::leaf ? support.leaf_beside_span : x1 - x0;
  return i == 0 ? std::pair(x0, x1 - leaf) : std::pair(x0 + leaf, x1);
}

std::vector<FillRegion> fill_regions(const Bridge& bridge) {
  std::vector<FillRegion> regions;
  const auto add = [&](double x0, double x1, double inner, double z0, double z1, std::ptrdiff_t support, int course) {
    if (x1 - x0 > 1e-9) regions.push_back({{x0, -inner, z0}, {x1, inner, z1}, support, course});
  };
  for (const std::size_t support : {std::size_t(0), bridge.last_support()}) {
    const auto [x0, x1] = wing_extent(bridge, support);
    add(x0, x1, bridge.half_width() - bridge.wing_wall_thickness, bridge.supports[support].base,
        bridge.supports[support].springing, std::ptrdiff_t(support), 0);
  }
  const double top_of_backing = bridge.backing_top;
  int course = 0;
  if (!bridge.backing_line.empty()) {
    for (const Band& band : interior_bands(bridge)) {
      const double inner = bridge.half_width() - band.thickness;
      const Polygon& line = bridge.backing_line;
      for (const auto& [x0, x1] : between_transverse_walls(bridge)) {
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
          const double from = std::max(x0, line[i].x()), to = std::min(x1, line[i + 1].x());
          if (to - from <= 1e-9) continue;
          add(from, to, inner, band.z0, band.z1, -1, course);
          regions.back().past.push_back(opposite(under_backing(line[i], line[i + 1])));
        }
      }
      course += int(split(band.z0, band.z1, bridge.fill.z()).size()) - 1;
    }
    return regions;
  }
  for (const Band& band : interior_bands(bridge)) {
    const double inner = bridge.half_width() - band.thickness;
    if (band.z0 >= top_of_backing) {
      for (const auto& [x0, x1] : between_transverse_walls(bridge)) add(x0, x1, inner, band.z0, band.z1, -1, course);
    } else {  // beside the backing: behind the abutments only
      add(0.0, bridge.supports.front().x1 - bridge.backing_over_abutment[0], inner, band.z0, band.z1, -1, course);
      add(bridge.supports.back().x0 + bridge.backing_over_abutment[1], bridge.length(), inner, band.z0, band.z1, -1,
          course);
    }
    course += int(split(band.z0, band.z1, bridge.fill.z()).size()) - 1;
  }
  return regions;
}

double fill_space(const Bridge& bridge) {
  double volume = 0.0;
  for (const FillRegion& region : fill_regions(bridge)) {
    const double width = region.high.y() - region.low.y();
    SectionLimits limits = bridge.limits();
    for (const Plane& side : region.past) limits.past.push_back(side);
    const Polygon whole = rectangle(region.low.x(), region.high.x(), region.low.z(), region.high.z());
    for (const Polygon& piece : within(whole, limits)) volume += width * polygon_area(piece);
  }
  return volume / std::cos(bridge.skew);
}

std::vector<Polygon> beside_fill(const Bridge& bridge) {
  std::vector<Polygon> beside;
  if (!bridge.backing_line.empty()) {
    Polygon under(bridge.backing_line.rbegin(), bridge.backing_line.rend());
    under.emplace_back(under.back().x() - 1.0, 0.0, under.back().z());
    under.emplace_back(under.back().x(), 0.0, bridge.springing - 1.0);
    under.emplace_back(bridge.length() + 1.0, 0.0, bridge.springing - 1.0);
    under.emplace_back(bridge.length() + 1.0, 0.0, under.front().z());
    beside.push_back(under);
  }
  if (bridge.gradient != 0.0) {
    const double x0 = -1.0, x1 = bridge.length() + 1.0, high = std::max(bridge.deck_at(x0), bridge.deck_at(x1)) + 1.0;
    beside.push_back({{x0, 0.0, bridge.deck_at(x0)}, {x1, 0.0, bridge.deck_at(x1)}, {x1, 0.0, high}, {x0, 0.0, high}});
  }
  return beside;
}

void lay_region(Layout& layout, const Bridge& bridge, const FillRegion& region) {
  const SectionLimits usual = layout.limits;
  for (const Plane& side : region.past) layout.limits.past.push_back(side);
  lay_courses(layout, region.low, region.high, bridge.fill_unit(), region.course);
  layout.limits = usual;
}

void lay_backfill(Layout& layout, const Bridge& bridge) {
  if (!bridge.rigid_backfill) return;
  for (const FillRegion& region : fill_regions(bridge)) {
    if (region.support < 0) lay_region(layout, bridge, region);
  }
}

}  // namespace voussoir
