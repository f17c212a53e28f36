// Abutments: solid, or a leaf with infill beside the span and wing walls with backfill between them behind it.
#include "geometry/masonry_parts.h"

namespace voussoir {

namespace {

void lay_wings(Layout& layout, const Bridge& bridge, std::size_t support) {
  const auto [x0, x1] = wing_extent(bridge, support);
  if (x1 - x0 <= 1e-9) return;
  const double z0 = bridge.supports[support].base, z1 = bridge.supports[support].springing;
  const double half = bridge.half_width(), inner = half - bridge.wing_wall_thickness;
  Unit wing = bridge.support_unit(support);
  wing.size.y() = bridge.wing_wall_thickness;
  lay_courses(layout, {x0, -half, z0}, {x1, -inner, z1}, wing);
  lay_courses(layout, {x0, inner, z0}, {x1, half, z1}, wing);
  if (!bridge.rigid_backfill) return;
  for (const FillRegion& region : fill_regions(bridge))
    if (region.support == std::ptrdiff_t(support))
      lay_courses(layout, region.low, region.high, bridge.fill_unit(), region.course);
}

}  // namespace

void lay_abutments(Layout& layout, const Bridge& bridge) {
  for (const std::size_t i : {std::size_t(0), bridge.last_support()}) {
    const int part = i == 0 ? 0 : 1;
    const double half = bridge.half_width(i);
    const Support& support = bridge.supports[i];
    const double z0 = support.base, z1 = support.springing;
    lay_wing_walls(layout, bridge, i);
    if (support.makeup == Makeup::solid) {
      lay_solid(layout, {support.x0, support.x1, half, z0, z1, 0.0, 0.0, support.slope_y}, bridge.support_unit(i));
      continue;
    }
    const auto [wing0, wing1] = wing_extent(bridge, i);
    const double leaf0 = part == 0 ? wing1 : support.x0, leaf1 = part == 0 ? support.x1 : wing0;
    lay_leaf_and_infill(layout, bridge, {leaf0, -half, z0}, {leaf1, half, z1}, i);
    lay_wings(layout, bridge, i);
  }
}

}  // namespace voussoir
