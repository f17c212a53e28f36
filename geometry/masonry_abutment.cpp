// Abutments: solid, or a leaf with infill beside the span and wing walls with backfill between them behind it.
#include "geometry/masonry_parts.h"

namespace voussoir {

namespace {

void lay_wings(Layout& layout, const Bridge& bridge, double x0, double x1, double z0, int part) {
  const double z1 = bridge.springing(), half = bridge.half_width(), inner = half - bridge.wing_wall_thickness;
  Unit wing = bridge.unit(Component::abutment, part);
  wing.size.y() = bridge.wing_wall_thickness;
  lay_courses(layout, {x0, -half, z0}, {x1, -inner, z1}, wing);
  lay_courses(layout, {x0, inner, z0}, {x1, half, z1}, wing);
  if (bridge.rigid_backfill) {
    lay_courses(layout, {x0, -inner, z0}, {x1, inner, z1}, bridge.fill_unit());
  }
}

}  // namespace

void lay_abutments(Layout& layout, const Bridge& bridge) {
  const double z1 = bridge.springing(), half = bridge.half_width();
  for (const int support : {0, bridge.spans}) {
    const int part = support == 0 ? 0 : 1;
    const double x0 = bridge.support_start(support), x1 = bridge.support_end(support);
    const double z0 = bridge.support_base(support);
    if (!bridge.leaf) {
      lay_solid(layout, {x0, x1, half, z0, z1, 0.0, 0.0, bridge.batter_y}, bridge.unit(Component::abutment, part));
      continue;
    }
    const double back = part == 0 ? x1 - bridge.leaf_length_beside_span : x0 + bridge.leaf_length_beside_span;
    const double leaf0 = part == 0 ? back : x0, leaf1 = part == 0 ? x1 : back;
    const double wing0 = part == 0 ? x0 : back, wing1 = part == 0 ? back : x1;
    lay_leaf_and_infill(layout, bridge, {leaf0, -half, z0}, {leaf1, half, z1}, Component::abutment, part, support);
    if (wing1 - wing0 > 1e-9) lay_wings(layout, bridge, wing0, wing1, z0, part);
  }
}

}  // namespace voussoir
