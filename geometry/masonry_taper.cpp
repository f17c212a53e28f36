// Spandrel walls whose back is one plane: all is laid out with walls of one thickness and then moved across.
//
// With half the width W, the thickness t0 of the layout and the wanted t(z), which is linear, a point of a wall keeps
// its share of the thickness and one between the walls its share of the space there. Planes y = const and planes whose
// normal lies in x-z stay planes, so that cells stay convex (docs/theory/geometry.md).
#include <algorithm>
#include <cmath>

#include "geometry/masonry_parts.h"

namespace voussoir {

double Bridge::spandrel_at(double z) const {
  if (!tapered) return spandrel_bottom;
  return taper_bottom + (taper_top - taper_bottom) * (z - springing) / (deck - springing);
}

double Bridge::spread_at(double z) const {
  return tapered ? (half_width() - spandrel_at(z)) / (half_width() - spandrel_bottom) : 1.0;
}

namespace {

double in_wall(const Bridge& bridge, const Vec3& p) {
  const double outer = bridge.half_width();
  const double y = outer - (outer - std::abs(p.y())) * bridge.spandrel_at(p.z()) / bridge.spandrel_bottom;
  return p.y() < 0.0 ? -y : y;
}

}  // namespace

void taper(Layout& layout, const Bridge& bridge, std::size_t first) {
  if (!bridge.tapered) return;
  for (std::size_t s = first; s < layout.stones.size(); ++s) {
    Stone& stone = layout.stones[s];
    const bool wall = stone.component == Component::spandrel && stone.part < 2;  // not those between
    for (Polyhedron& cell : stone.cells)
      for (Vec3& p : cell.vertices) p.y() = wall ? in_wall(bridge, p) : p.y() * bridge.spread_at(p.z());
  }
}

double longest_stretch(const Bridge& bridge) {
  if (!bridge.tapered) return 1.0;
  // The gradient of (y, z) -> (y f(z), z) is [[f, y f'], [0, 1]]; its norm grows with either entry.
  const double f = std::max(bridge.spread_at(bridge.springing), bridge.spread_at(bridge.deck));
  const double c = (bridge.taper_top - bridge.taper_bottom) / (bridge.deck - bridge.springing);
  const double trace = f * f + c * c + 1.0;
  return std::sqrt(0.5 * (trace + std::sqrt(std::max(0.0, trace * trace - 4.0 * f * f))));
}

}  // namespace voussoir
