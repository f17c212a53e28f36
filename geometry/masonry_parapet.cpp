// Parapets: on the spandrel walls, flush with their outer faces.
#include <utility>

#include "geometry/masonry_parts.h"

namespace voussoir {

void lay_parapets(Layout& layout, const Bridge& bridge) {
  const double z0 = bridge.deck + bridge.string_height, z1 = z0 + bridge.parapet_height;
  const double outer = bridge.half_width(), inner = outer - bridge.parapet_thickness;
  const SectionLimits usual = std::exchange(layout.limits, {});  // laid level, and moved to the deck's slope below
  const std::size_t first = layout.stones.size();
  for (const int side : {0, 1}) {
    Unit unit = bridge.unit(Component::parapet, side);
    if (bridge.string_height > 0.0) {
      const double out = outer + bridge.string_projection;
      unit.size.y() = out - inner;
      lay_courses(layout, {0.0, side == 0 ? -out : inner, bridge.deck}, {bridge.length(), side == 0 ? -inner : out, z0},
                  unit, 1);
    }
    if (bridge.parapet_height <= 0.0) continue;
    unit.size.y() = bridge.parapet_thickness;
    lay_courses(layout, {0.0, side == 0 ? -outer : inner, z0}, {bridge.length(), side == 0 ? -inner : outer, z1}, unit);
  }
  layout.limits = usual;
  if (bridge.gradient == 0.0) return;
  for (std::size_t s = first; s < layout.stones.size(); ++s)  // upright head joints, beds along the deck
    for (Polyhedron& cell : layout.stones[s].cells)
      for (Vec3& p : cell.vertices) p.z() += bridge.deck_at(p.x()) - bridge.deck;
}

}  // namespace voussoir
