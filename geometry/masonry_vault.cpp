// Vaults: barrels of flat-faced wedges over the whole width.
#include <fmt/format.h>

#include "geometry/masonry_parts.h"

namespace voussoir {

void lay_vaults(Layout& layout, const Bridge& bridge) {
  for (std::size_t i = 0; i < bridge.vaults.size(); ++i) {
    const Vault& vault = bridge.vaults[i];
    auto& keystone = layout.groups[fmt::format("keystone {}", i)];
    for (std::size_t k = 0; k < vault.rings.size(); ++k) {
      const Ring& ring = vault.rings[k];
      const Unit unit = {Component::arch, int(i), bridge.vault, vault.voussoir};
      const auto first = lay_ring(layout, ring, -bridge.half_width(), bridge.half_width(), unit, int(k));
      // With an even number of wedges the crown is a joint, and the keystone the wedges on both its sides.
      const auto n = std::size_t(ring.wedges());
      for (std::int64_t s = first[(n - 1) / 2]; s < first[n / 2 + 1]; ++s) keystone.push_back(s);
    }
  }
  layout.limits.rings = bridge.limits().rings;
}

}  // namespace voussoir
