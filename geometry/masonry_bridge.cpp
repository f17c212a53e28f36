// Places of the parts of a bridge.
#include <algorithm>
#include <cmath>

#include "geometry/masonry_parts.h"

namespace voussoir {

Unit Bridge::unit(Component component, int part) const {
  return {component, part, masonry, block};
}

Unit Bridge::support_unit(std::size_t support) const {
  Unit own =
      is_abutment(support) ? unit(Component::abutment, support == 0 ? 0 : 1) : unit(Component::pier, int(support) - 1);
  own.material = supports[support].material;
  return own;
}

Unit Bridge::fill_unit() const {
  return {Component::backfill, 0, backfill, fill, fill_bonded};
}

SectionLimits Bridge::limits() const {
  SectionLimits limits;
  for (const Vault& vault : vaults) limits.rings.push_back(whole_vault(vault.rings));
  for (const Support& support : supports)
    if (support.top > springing) limits.taken.push_back({{support.x0, 0.0, springing}, {support.x1, 0.0, support.top}});
  if (gradient != 0.0) {
    const Vec3 up = Vec3(-gradient, 0.0, 1.0).normalized();
    limits.past.push_back({up, up.dot(Vec3(0.0, 0.0, deck_at(0.0)))});
  }
  return limits;
}

std::vector<Band> spandrel_courses(const Bridge& bridge) {
  std::vector<double> z = {bridge.springing};
  std::vector<double> ends = {std::min(bridge.backing_top, bridge.deck), bridge.deck};
  const InternalWalls& internal = bridge.internal;
  const bool slabs = internal.number > 0 && internal.hollow;
  if (slabs) ends.push_back(internal.slab_bottom()), ends.push_back(internal.slab_top);
  std::sort(ends.begin(), ends.end());
  for (const double to : ends) {
    if (to <= z.back() + 1e-9) continue;
    const std::vector<double> more = split(z.back(), to, bridge.block.z());
    z.insert(z.end(), more.begin() + 1, more.end());
  }
  std::vector<Band> courses;
  const double last = std::max(1.0, double(z.size()) - 2.0);
  for (std::size_t k = 0; k + 1 < z.size(); ++k) {
    const double share = double(k) / last;
    const bool notched = slabs && z[k] > internal.slab_bottom() - 1e-9 && z[k + 1] < internal.slab_top + 1e-9;
    courses.push_back({z[k], z[k + 1],
                       bridge.spandrel_bottom + share * (bridge.spandrel_top - bridge.spandrel_bottom) -
                           (notched ? internal.bearing : 0.0)});
  }
  return courses;
}

std::vector<Band> interior_bands(const Bridge& bridge) {
  const double backing = bridge.backing_top;
  std::vector<Band> bands;
  for (const Band& course : spandrel_courses(bridge)) {
    const bool same = !bands.empty() && bands.back().thickness == course.thickness && course.z0 != backing;
    if (same) {
      bands.back().z1 = course.z1;
    } else {
      bands.push_back(course);
    }
  }
  return bands;
}

}  // namespace voussoir
