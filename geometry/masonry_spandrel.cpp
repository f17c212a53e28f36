// Spandrel walls: along both edges over the whole length, from the springing to the deck, standing on the extrados.
#include <fmt/format.h>

#include <cmath>

#include "geometry/masonry_parts.h"

namespace voussoir {

std::string support_name(const Bridge& bridge, std::size_t support) {
  if (support == 0) return "abutment left";
  if (support == bridge.last_support()) return "abutment right";
  return fmt::format("pier {}", support - 1);
}

namespace {

double middle_of(const Stone& stone) {
  const Box box = bounding_box(stone.cells[0]);
  return 0.5 * (box.low.x() + box.high.x());
}

bool reaches_deck(const Bridge& bridge, const Stone& stone) {
  for (const Polyhedron& cell : stone.cells)
    for (const Vec3& p : cell.vertices)
      if (p.z() > bridge.deck_at(p.x()) - 1e-6) return true;
  return false;
}

/// The stones under the deck nearest above each support's middle.
void name_tops(Layout& layout, const Bridge& bridge, std::size_t first, const std::string& side) {
  for (std::size_t support = 0; support < bridge.supports.size(); ++support) {
    const double middle = 0.5 * (bridge.supports[support].x0 + bridge.supports[support].x1);
    double nearest = 1e300;
    for (std::size_t i = first; i < layout.stones.size(); ++i) {
      if (!reaches_deck(bridge, layout.stones[i])) continue;
      nearest = std::min(nearest, std::abs(middle_of(layout.stones[i]) - middle));
    }
    auto& group = layout.groups[fmt::format("spandrel {} {}", side, support_name(bridge, support))];
    for (std::size_t i = first; i < layout.stones.size(); ++i) {
      // Stones that share a column across a thick wall go together; of two at equal distance both count.
      if (reaches_deck(bridge, layout.stones[i]) && std::abs(middle_of(layout.stones[i]) - middle) < nearest + 1e-6)
        group.push_back(std::int64_t(i));
    }
  }
}

}  // namespace

void lay_spandrels(Layout& layout, const Bridge& bridge) {
  const std::vector<Band> courses = spandrel_courses(bridge);
  for (const int side : {0, 1}) {
    const std::size_t first = layout.stones.size();
    for (std::size_t k = 0; k < courses.size(); ++k) {
      const Band& course = courses[k];
      const double outer = bridge.half_width(), inner = outer - course.thickness;
      Unit unit = bridge.unit(Component::spandrel, side);
      unit.size.z() = course.z1 - course.z0;
      lay_courses(layout, {0.0, side == 0 ? -outer : inner, course.z0},
                  {bridge.length(), side == 0 ? -inner : outer, course.z1}, unit, int(k));
    }
    name_tops(layout, bridge, first, side == 0 ? "y-" : "y+");
  }
}

}  // namespace voussoir
