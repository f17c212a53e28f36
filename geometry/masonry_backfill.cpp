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

namespace {

/// Whether a band lies in the voids under slabs.
bool is_void(const Bridge& bridge, const Band& band) {
  return bridge.internal.number > 0 && bridge.internal.hollow && band.z0 < bridge.internal.slab_top - 1e-9;
}

/// Boxes over a backing that is not level.
void add_over_line(std::vector<FillRegion>& regions, const Bridge& bridge, const Band& band, int course) {
  int lane = 0;
  for (const auto& [y0, y1] : lanes(bridge, bridge.half_width() - band.thickness)) {
    for (const auto& [x0, x1] : between_transverse_walls(bridge))
      along_backing(bridge, x0, x1, [&, y0 = y0, y1 = y1](double from, double to, const Plane& under) {
        regions.push_back({{from, y0, band.z0}, {to, y1, band.z1}, -1, course, {opposite(under)}, lane});
      });
    ++lane;
  }
}

/// Boxes over a level backing; in the bands at its height only behind the abutments.
void add_over_level(std::vector<FillRegion>& regions, const Bridge& bridge, const Band& band, int course) {
  const double inner = bridge.half_width() - band.thickness;
  const auto add = [&](double x0, double x1, double y0, double y1, int lane) {
    if (x1 - x0 > 1e-9) regions.push_back({{x0, y0, band.z0}, {x1, y1, band.z1}, -1, course, {}, lane});
  };
  if (band.z0 < bridge.backing_top) {
    add(0.0, bridge.supports.front().x1 - bridge.backing_over_abutment[0], -inner, inner, 0);
    add(bridge.supports.back().x0 + bridge.backing_over_abutment[1], bridge.length(), -inner, inner, 0);
    return;
  }
  int lane = 0;
  for (const auto& [y0, y1] : lanes(bridge, inner)) {
    for (const auto& [x0, x1] : between_transverse_walls(bridge)) add(x0, x1, y0, y1, lane);
    ++lane;
  }
}

/// The fill above the springing in two at the underside of the surfacing, which is parallel to the deck.
std::vector<FillRegion> with_surfacing(const std::vector<FillRegion>& regions, const Bridge& bridge) {
  std::vector<FillRegion> parts;
  const auto add = [&](const FillRegion& part) {
    if (part.high.z() - part.low.z() > no_masonry) parts.push_back(part);
  };
  const auto underside = [&](double x) { return bridge.deck_at(x) - bridge.surfacing_depth; };
  for (const FillRegion& region : regions) {
    if (region.support >= 0) {
      parts.push_back(region);
      continue;
    }
    FillRegion below = region, above = region;
    above.surfacing = true;
    const double x0 = region.low.x(), x1 = region.high.x(), z0 = underside(x0), z1 = underside(x1);
    above.low.z() = std::max(region.low.z(), std::min(z0, z1));
    below.high.z() = std::min(region.high.z(), std::max(z0, z1));
    if (bridge.gradient != 0.0) {
      const Plane under = under_backing({x0, 0.0, z0}, {x1, 0.0, z1});
      below.past.push_back(under), above.past.push_back(opposite(under));
    }
    add(below);
    if (below.high.z() > below.low.z())
      above.course += int(split(below.low.z(), below.high.z(), bridge.fill.z()).size()) - 1;
    add(above);
  }
  return parts;
}

}  // namespace

std::vector<FillRegion> fill_regions(const Bridge& bridge) {
  std::vector<FillRegion> regions;
  for (const std::size_t support : {std::size_t(0), bridge.last_support()}) {
    const auto [x0, x1] = wing_extent(bridge, support);
    const double inner = bridge.half_width() - bridge.wing_wall_thickness;
    const Support& at = bridge.supports[support];
    if (x1 - x0 > 1e-9)
      regions.push_back({{x0, -inner, at.base}, {x1, inner, at.springing}, std::ptrdiff_t(support), 0});
  }
  int course = 0;
  for (const Band& band : interior_bands(bridge)) {
    const bool beside = bridge.backing_line.empty() && band.z0 < bridge.backing_top;
    if (beside || !is_void(bridge, band)) {
      if (bridge.backing_line.empty()) {
        add_over_level(regions, bridge, band, course);
      } else {
        add_over_line(regions, bridge, band, course);
      }
    }
    course += int(split(band.z0, band.z1, bridge.fill.z()).size()) - 1;
  }
  return bridge.surfacing_depth > 0.0 ? with_surfacing(regions, bridge) : regions;
}

double fill_space(const Bridge& bridge) {
  double volume = 0.0;
  for (const FillRegion& region : fill_regions(bridge)) {
    const double width = region.high.y() - region.low.y();
    SectionLimits limits = bridge.limits();
    for (const Plane& side : region.past) limits.past.push_back(side);
    const Polygon whole = rectangle(region.low.x(), region.high.x(), region.low.z(), region.high.z());
    for (const Polygon& piece : within(whole, limits)) {
      const double spread = region.support < 0 ? bridge.spread_at(polygon_centroid(piece).z()) : 1.0;
      volume += width * polygon_area(piece) * spread;  // exact: the width is linear in z
    }
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
  Unit unit = bridge.fill_unit();
  const std::size_t first = layout.stones.size();
  if (region.surfacing) unit.material = bridge.surfacing, unit.size.z() = region.high.z() - region.low.z();
  lay_courses(layout, region.low, region.high, unit, region.course);
  if (region.surfacing)
    for (std::size_t s = first; s < layout.stones.size(); ++s)  // the box of a deck with a gradient is higher
      layout.stones[s].nominal.z() = std::min(layout.stones[s].nominal.z(), bridge.surfacing_depth);
  layout.limits = usual;
}

void lay_backfill(Layout& layout, const Bridge& bridge) {
  if (!bridge.rigid_backfill) return;
  for (const FillRegion& region : fill_regions(bridge)) {
    if (region.support < 0) lay_region(layout, bridge, region);
  }
}

}  // namespace voussoir
