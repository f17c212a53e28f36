// Rigid backfill above the springing: between the spandrel walls, over backing and vaults, up to the deck.
#include "geometry/masonry_parts.h"

namespace voussoir {

void lay_backfill(Layout& layout, const Bridge& bridge) {
  if (!bridge.rigid_backfill) return;
  const Unit unit = bridge.fill_unit();
  const double top_of_backing = bridge.springing() + bridge.backing_height;
  int course = 0;
  for (const Band& band : interior_bands(bridge)) {
    const double inner = bridge.half_width() - band.thickness;
    const auto lay = [&](double x0, double x1) {
      if (x1 - x0 > 1e-9) lay_courses(layout, {x0, -inner, band.z0}, {x1, inner, band.z1}, unit, course);
    };
    if (band.z0 >= top_of_backing) {
      lay(0.0, bridge.length());
    } else {  // beside the backing: behind the abutments only
      lay(0.0, bridge.support_end(0) - bridge.backing_over_abutment);
      lay(bridge.support_start(bridge.spans) + bridge.backing_over_abutment, bridge.length());
    }
    course += int(split(band.z0, band.z1, bridge.fill.z()).size()) - 1;
  }
}

}  // namespace voussoir
