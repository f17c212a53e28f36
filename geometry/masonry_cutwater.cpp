// Cutwaters: noses of stones on the side faces of a pier, a triangle or half an ellipse in plan.
#include <cmath>

#include "geometry/masonry_parts.h"
#include "solver/base/constants.h"

namespace voussoir {

namespace {

constexpr int facets = 8;  // of a round one

/// In plan, counter-clockwise seen from above, at y >= 0; z = 0.
Polygon plan(const Support& support, double half_width) {
  const double middle = 0.5 * (support.x0 + support.x1), half = 0.5 * (support.x1 - support.x0);
  Polygon outline = {{support.x1, half_width, 0.0}};
  const int corners = support.cutwater.round ? facets : 2;
  for (int i = 1; i < corners; ++i) {
    const double angle = pi * i / corners;
    outline.emplace_back(middle + half * std::cos(angle), half_width + support.cutwater.length * std::sin(angle), 0.0);
  }
  outline.emplace_back(support.x0, half_width, 0.0);
  return outline;
}

Polyhedron mirrored(Polyhedron shape) {
  for (Vec3& p : shape.vertices) p.y() = -p.y();
  for (auto& face : shape.faces) std::reverse(face.begin(), face.end());
  return shape;
}

}  // namespace

void lay_cutwaters(Layout& layout, const Bridge& bridge, std::size_t i) {
  const Support& support = bridge.supports[i];
  if (support.cutwater.length <= 0.0) return;
  const Unit unit = bridge.support_unit(i);
  const double half_width = bridge.half_width(i), slope = support.slope_y;
  const Vec3 outward = Vec3(0.0, 1.0, slope).normalized();
  const Plane off_the_pier = {-outward, -outward.dot(Vec3(0.0, half_width, support.springing))};
  const double middle = 0.5 * (support.x0 + support.x1);
  const std::vector<double> z = split(support.base, support.base + support.cutwater.height, unit.size.z());
  for (const bool other_side : {false, true}) {
    for (std::size_t k = 0; k + 1 < z.size(); ++k) {
      Polygon outline = plan(support, half_width);
      for (Vec3& p : outline) p.z() = z[k + 1];
      Polyhedron whole = make_prism(outline, {0.0, 0.0, z[k] - z[k + 1]});
      if (slope > 0.0) whole = cut(whole, off_the_pier);
      std::vector<Polyhedron> stones = {whole};  // whole and halved by turns
      if (k % 2 == 1) stones = {cut(whole, {Vec3::UnitX(), middle}), cut(whole, {-Vec3::UnitX(), -middle})};
      for (Polyhedron& stone : stones) {
        if (stone.faces.empty() || mass_properties(stone).volume < no_masonry * surface_area(stone)) continue;
        const Box box = bounding_box(stone);
        lay_stone(layout, {other_side ? mirrored(std::move(stone)) : std::move(stone)}, unit, box.high - box.low,
                  false);
      }
    }
  }
}

}  // namespace voussoir
