// The beam of a loading test: a fixed block on the fill, across the whole of it, that a stage drives down.
#include "geometry/masonry_parts.h"

namespace voussoir {

void lay_load_beam(Layout& layout, const Bridge& bridge) {
  const LoadBeam& beam = bridge.beam;
  if (beam.length <= 0.0) return;
  const double x0 = beam.middle - 0.5 * beam.length, x1 = beam.middle + 0.5 * beam.length;
  const double y = bridge.half_width() - (bridge.tapered ? bridge.taper_top : bridge.spandrel_top);
  const Polygon side = {{x0, -y, bridge.deck_at(x0)},
                        {x1, -y, bridge.deck_at(x1)},
                        {x1, -y, bridge.deck_at(x1) + beam.height},
                        {x0, -y, bridge.deck_at(x0) + beam.height}};
  const Vec3 size(beam.length, 2.0 * y, beam.height);
  layout.groups["load"] = {std::int64_t(layout.stones.size())};
  lay_stone(layout, {make_prism(side, {0.0, 2.0 * y, 0.0})}, {Component::base, 0, bridge.masonry, size}, size, false);
}

}  // namespace voussoir
