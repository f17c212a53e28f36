// Walls beyond the end of a bridge: wings that splay outwards, and counterforts against the end face.
#include "geometry/masonry_parts.h"

namespace voussoir {

namespace {

/// Wing walls are laid out straight behind an end; then a point d m behind it moves outwards by slope × d.
struct Wall {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // m
  double slope = 0.0;                            // along y over the way from the end
};

std::vector<Wall> walls(const Bridge& bridge, std::size_t i) {
  const Support& support = bridge.supports[i];
  const Wings& wings = support.wings;
  const double half = bridge.half_width(), z0 = support.base;
  const auto behind = [&](double length) {
    return i == 0 ? std::pair(-length, 0.0) : std::pair(bridge.length(), bridge.length() + length);
  };
  std::vector<Wall> list;
  if (wings.length > 0.0) {
    const auto [x0, x1] = behind(wings.length);
    list.push_back({{x0, -half, z0}, {x1, wings.thickness - half, wings.top}, -wings.slope});
    list.push_back({{x0, half - wings.thickness, z0}, {x1, half, wings.top}, wings.slope});
  }
  const auto [x0, x1] = behind(wings.counterfort_length);
  const double inside = 2.0 * (half - (wings.length > 0.0 ? wings.thickness : 0.0));
  for (int k = 0; k < wings.counterforts; ++k) {
    const double y = inside * ((k + 0.5) / wings.counterforts - 0.5), t = 0.5 * wings.counterfort_thickness;
    list.push_back({{x0, y - t, z0}, {x1, y + t, wings.counterfort_top}, 0.0});
  }
  return list;
}

void splay(Polyhedron& shape, const Bridge& bridge, std::size_t i, double slope) {
  for (Vec3& p : shape.vertices) p.y() += slope * (i == 0 ? -p.x() : p.x() - bridge.length());
}

}  // namespace

void lay_wing_walls(Layout& layout, const Bridge& bridge, std::size_t i) {
  for (const Wall& wall : walls(bridge, i)) {
    const Unit unit = bridge.support_unit(i);
    Layout straight;
    lay_courses(straight, wall.low, wall.high, unit);
    for (Stone& stone : straight.stones) {
      for (Polyhedron& cell : stone.cells) splay(cell, bridge, i, wall.slope);
      layout.stones.push_back(std::move(stone));
    }
  }
}

std::vector<Polyhedron> base_of_wings(const Bridge& bridge, std::size_t i) {
  std::vector<Polyhedron> cells;
  for (const Wall& wall : walls(bridge, i)) {
    Vec3 low = wall.low, high = wall.high;
    low.z() = wall.low.z() - bridge.base_depth, high.z() = wall.low.z();
    cells.push_back(make_box(low, high));
    splay(cells.back(), bridge, i, wall.slope);
  }
  return cells;
}

}  // namespace voussoir
