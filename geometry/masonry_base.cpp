// Fixed blocks: one base under each support, and one restraint over each end face of a restrained bridge.
#include <fmt/format.h>

#include <algorithm>

#include "geometry/masonry_parts.h"

namespace voussoir {

void lay_bases(Layout& layout, const Bridge& bridge) {
  for (std::size_t i = 0; i < bridge.supports.size(); ++i) {
    const Support& support = bridge.supports[i];
    const double grow_x = support.slope_x * support.height;
    const double half = bridge.half_width(i) + std::max(support.slope_y * support.height, support.cutwater.length);
    const double z = support.base;
    const Vec3 low(support.x0 - grow_x, -half, z - bridge.base_depth);
    const Vec3 high(support.x1 + grow_x, half, z);
    layout.groups[fmt::format("base {}", support_name(bridge, i))] = {std::int64_t(layout.stones.size())};
    std::vector<Polyhedron> cells = base_of_wings(bridge, i);
    cells.insert(cells.begin(), make_box(low, high));
    lay_stone(layout, std::move(cells), {Component::base, int(i), bridge.masonry, high - low}, high - low, false);
  }
}

void lay_restraints(Layout& layout, const Bridge& bridge) {
  if (!bridge.restrained) return;
  const double top = bridge.half_width();
  for (const int end : {0, 1}) {
    const Support& support = end == 0 ? bridge.supports.front() : bridge.supports.back();
    const double z0 = support.base, z1 = support.springing,
                 wide = bridge.half_width(end == 0 ? 0 : bridge.last_support()),
                 foot = wide + support.slope_y * support.height;
    const double x = end == 0 ? -bridge.restraint_depth : bridge.length();
    const double z2 = bridge.deck_at(end == 0 ? 0.0 : bridge.length());
    const Vec3 sweep(bridge.restraint_depth, 0.0, 0.0);
    const Polygon lower = {{x, -foot, z0}, {x, -wide, z1}, {x, wide, z1}, {x, foot, z0}};
    const Polygon upper = {{x, -top, z1}, {x, -top, z2}, {x, top, z2}, {x, top, z1}};
    const Vec3 size(bridge.restraint_depth, 2.0 * top, z2 - z0);
    layout.groups[end == 0 ? "restraint left" : "restraint right"] = {std::int64_t(layout.stones.size())};
    lay_stone(layout, {make_prism(lower, sweep), make_prism(upper, sweep)},
              {Component::restraint, end, bridge.masonry, size}, size, false);
  }
}

}  // namespace voussoir
