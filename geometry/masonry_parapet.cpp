// Parapets: on the spandrel walls, flush with their outer faces.
#include "geometry/masonry_parts.h"

namespace voussoir {

void lay_parapets(Layout& layout, const Bridge& bridge) {
  if (bridge.parapet_height <= 0.0) return;
  const double z0 = bridge.deck, z1 = z0 + bridge.parapet_height;
  const double outer = bridge.half_width(), inner = outer - bridge.parapet_thickness;
  for (const int side : {0, 1}) {
    Unit unit = bridge.unit(Component::parapet, side);
    unit.size.y() = bridge.parapet_thickness;
    lay_courses(layout, {0.0, side == 0 ? -outer : inner, z0}, {bridge.length(), side == 0 ? -inner : outer, z1}, unit);
  }
}

}  // namespace voussoir
