// Vaults: barrels of flat-faced wedges over the whole width.
#include <fmt/format.h>

#include "geometry/masonry_parts.h"
#include "geometry/rings.h"

namespace voussoir {

std::size_t rings_of_stone(const Vault& vault, std::size_t ring, std::int64_t course) {
  const auto every = std::int64_t(vault.headers_every);
  if (every == 0 || ((course % every) + every) % every != 0) return 1;
  const bool second = vault.rings.size() > 2 && (course / every) % 2 != 0;
  const std::size_t start = second ? 1 : 0;
  if (ring < start) return 1;
  if ((ring - start) % 2 == 1) return 0;
  return ring + 1 < vault.rings.size() ? 2 : 1;
}

bool at_crown(int wedge, int wedges) {
  return wedge == (wedges - 1) / 2 || wedge == wedges / 2;
}

void name_rings(Layout& layout, std::size_t vault, std::size_t first_ring, std::size_t rings, std::size_t from) {
  for (std::size_t ring = first_ring; ring < first_ring + rings; ++ring) {
    auto& group = layout.groups[ring_group(vault, ring)];
    for (std::size_t s = from; s < layout.stones.size(); ++s) group.push_back(std::int64_t(s));
  }
}

void name_quarter(Layout& layout, std::size_t vault, int quarter, std::size_t from) {
  if (quarter < 0) return;
  auto& group = layout.groups[fmt::format("quarter {} {}", vault, quarter == 0 ? "left" : "right")];
  for (std::size_t s = from; s < layout.stones.size(); ++s) group.push_back(std::int64_t(s));
}

namespace {

void lay_straight(Layout& layout, const Bridge& bridge, std::size_t i) {
  const Vault& vault = bridge.vaults[i];
  auto& keystone = layout.groups[fmt::format("keystone {}", i)];
  const Unit unit = {Component::arch, int(i), vault.material, vault.voussoir};
  for (std::size_t k = 0; k < vault.rings.size(); ++k) {
    for (int wedge = 0; wedge < vault.rings[k].wedges(); ++wedge) {
      const std::size_t rings = rings_of_stone(vault, k, wedge);
      const std::size_t first = layout.stones.size();
      std::vector<Polygon> polygons;
      for (std::size_t r = k; r < k + rings; ++r) polygons.push_back(vault.rings[r].wedge(wedge));
      const bool half = (std::size_t(wedge) + k) % 2 == 1;
      if (rings > 0)
        lay_across(layout, polygons, split(-bridge.half_width(), bridge.half_width(), unit.size.y(), half), unit,
                   vault.stone(k, rings));
      if (at_crown(wedge, vault.rings[k].wedges()))
        for (std::size_t s = first; s < layout.stones.size(); ++s) keystone.push_back(std::int64_t(s));
      name_quarter(layout, i, quarter_of(vault.rings[k].intrados, wedge), first);
      if (vault.rings.size() > 1) name_rings(layout, i, k, rings, first);
    }
  }
}

}  // namespace

void lay_vaults(Layout& layout, const Bridge& bridge) {
  for (std::size_t i = 0; i < bridge.vaults.size(); ++i) {
    if (bridge.skew == 0.0 || bridge.skew_bond == SkewBond::parallel) {
      lay_straight(layout, bridge, i);
    } else {
      lay_oblique(layout, bridge, i);
    }
  }
  layout.limits.rings = bridge.limits().rings;
}

}  // namespace voussoir
