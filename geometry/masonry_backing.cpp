// Backing: masonry over the supports between the spandrel walls, up to the backing's height.
#include <algorithm>

#include "geometry/masonry_parts.h"

namespace voussoir {

void lay_backing(Layout& layout, const Bridge& bridge) {
  const double top = bridge.backing_top;
  const auto crown = [&](std::size_t span) { return 0.5 * (bridge.vaults[span].left() + bridge.vaults[span].right()); };
  for (std::size_t support = 0; support < bridge.supports.size(); ++support) {
    // From crown to crown; what lies within the vaults is cut away.
    const double x0 = support == 0 ? bridge.supports[0].x1 - bridge.backing_over_abutment[0] : crown(support - 1);
    const double x1 = support == bridge.last_support() ? bridge.supports[support].x0 + bridge.backing_over_abutment[1]
                                                       : crown(support);
    int course = 0;
    for (const Band& band : interior_bands(bridge)) {
      if (band.z0 >= top) break;
      const double inner = bridge.half_width() - band.thickness;
      lay_courses(layout, {x0, -inner, band.z0}, {x1, inner, band.z1}, bridge.unit(Component::backing, int(support)),
                  course);
      course += int(split(band.z0, band.z1, bridge.block.z()).size()) - 1;
    }
  }
}

}  // namespace voussoir
