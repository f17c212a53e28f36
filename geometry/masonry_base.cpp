// Fixed blocks: one base under each support, and one restraint over each end face of a restrained bridge.
#include <fmt/format.h>

#include "geometry/masonry_parts.h"

namespace voussoir {

void lay_bases(Layout& layout, const Bridge& bridge) {
  for (int support = 0; support < bridge.supports(); ++support) {
    const double height = bridge.support_height(support);
    const double grow_x = bridge.leaf || bridge.is_abutment(support) ? 0.0 : bridge.batter_x * height;
    const double half = bridge.half_width() + (bridge.leaf ? 0.0 : bridge.batter_y * height);
    const double z = bridge.support_base(support);
    const Vec3 low(bridge.support_start(support) - grow_x, -half, z - bridge.base_depth);
    const Vec3 high(bridge.support_end(support) + grow_x, half, z);
    layout.groups[fmt::format("base {}", support_name(bridge, support))] = {std::int64_t(layout.stones.size())};
    lay_stone(layout, {make_box(low, high)}, {Component::base, support, bridge.masonry, high - low}, high - low, false);
  }
}

void lay_restraints(Layout& layout, const Bridge& bridge) {
  if (!bridge.restrained) return;
  const double z0 = bridge.support_base(0), z1 = bridge.springing(), z2 = bridge.deck(), top = bridge.half_width();
  const double foot = top + (bridge.leaf ? 0.0 : bridge.batter_y * bridge.abutment_height);
  for (const int end : {0, 1}) {
    const double x = end == 0 ? -bridge.restraint_depth : bridge.length();
    const Vec3 sweep(bridge.restraint_depth, 0.0, 0.0);
    const Polygon lower = {{x, -foot, z0}, {x, -top, z1}, {x, top, z1}, {x, foot, z0}};
    const Polygon upper = {{x, -top, z1}, {x, -top, z2}, {x, top, z2}, {x, top, z1}};
    const Vec3 size(bridge.restraint_depth, 2.0 * top, z2 - z0);
    layout.groups[end == 0 ? "restraint left" : "restraint right"] = {std::int64_t(layout.stones.size())};
    lay_stone(layout, {make_prism(lower, sweep), make_prism(upper, sweep)},
              {Component::restraint, end, bridge.masonry, size}, size, false);
  }
}

}  // namespace voussoir
