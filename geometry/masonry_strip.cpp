// A strip of a bridge in plane strain, without walls along its faces, between two fixed smooth walls.
#include "geometry/masonry_parts.h"
#include "geometry/stiffness.h"

namespace voussoir {

namespace {

constexpr const char* walls_group = "walls";

}  // namespace

void lay_strip_walls(Layout& layout, const Bridge& bridge) {
  if (!bridge.strip) return;
  constexpr double thickness = 0.3;  // m
  double base = bridge.springing;
  for (const Support& support : bridge.supports) base = std::min(base, support.base);
  const double length = bridge.length(), y = bridge.half_width();
  auto& walls = layout.groups[walls_group];
  for (const int side : {0, 1}) {
    const double y0 = side == 0 ? -y - thickness : y;
    const Polygon outline = {
        {0.0, y0, base}, {length, y0, base}, {length, y0, bridge.deck_at(length)}, {0.0, y0, bridge.deck_at(0.0)}};
    const Vec3 size(length, thickness, bridge.deck - base);
    walls.push_back(std::int64_t(layout.stones.size()));
    lay_stone(layout, {make_prism(outline, {0.0, thickness, 0.0})},
              {Component::restraint, 2 + side, bridge.masonry, size}, size, false);
  }
}

void smooth_strip_walls(Assembly& assembly) {
  const auto found = assembly.groups.find(walls_group);
  if (found == assembly.groups.end()) return;
  const std::vector<std::int64_t>& walls = found->second;
  const auto is_wall = [&](std::int64_t block) { return std::find(walls.begin(), walls.end(), block) != walls.end(); };
  const std::int32_t smooth = law_index(assembly.laws, {});
  for (Joint& joint : assembly.joints)
    if (is_wall(joint.a) || is_wall(joint.b)) joint.law = smooth;
  for (FillJoint& joint : assembly.fill_joints)
    if (is_wall(joint.block)) joint.law = smooth;
}

}  // namespace voussoir
