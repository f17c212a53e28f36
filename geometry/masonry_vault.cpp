// Vaults: semicircular barrels of flat-faced wedges over the whole width.
#include <fmt/format.h>

#include "geometry/masonry_parts.h"

namespace voussoir {

std::vector<Ring> vault_rings(const Bridge& bridge) {
  std::vector<Ring> rings;
  for (int i = 0; i < bridge.spans; ++i) {
    const double radius = 0.5 * bridge.own_spans[std::size_t(i)];
    const Vec3 centre(0.5 * (bridge.span_start(i) + bridge.span_end(i)), 0.0, bridge.springing());
    rings.push_back(make_semicircle(centre, radius, radius + bridge.ring_thickness, bridge.voussoirs));
  }
  return rings;
}

void lay_vaults(Layout& layout, const Bridge& bridge) {
  const std::vector<Ring> rings = vault_rings(bridge);
  for (int i = 0; i < bridge.spans; ++i) {
    const Ring& ring = rings[std::size_t(i)];
    const Unit unit = {Component::arch, i, bridge.vault, bridge.voussoir};
    const auto first = lay_ring(layout, ring, -bridge.half_width(), bridge.half_width(), unit);
    // With an even number of wedges the crown is a joint, and the keystone the wedges on both its sides.
    const std::size_t n = std::size_t(bridge.voussoirs);
    auto& keystone = layout.groups[fmt::format("keystone {}", i)];
    for (std::int64_t s = first[(n - 1) / 2]; s < first[n / 2 + 1]; ++s) keystone.push_back(s);
    layout.limits.rings.push_back(ring);
  }
}

}  // namespace voussoir
