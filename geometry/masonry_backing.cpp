// Backing: masonry over the supports between the spandrel walls, up to the backing's height or to its line.
#include <algorithm>

#include "geometry/masonry_parts.h"

namespace voussoir {

Plane under_backing(const Vec3& from, const Vec3& to) {
  const Vec3 up = Vec3(from.z() - to.z(), 0.0, to.x() - from.x()).normalized();
  return {up, up.dot(from)};
}

Plane opposite(const Plane& plane) {
  return {-plane.normal, -plane.offset};
}

namespace {

double crown(const Bridge& bridge, std::size_t span) {
  return 0.5 * (bridge.vaults[span].left() + bridge.vaults[span].right());
}

/// From crown to crown; what lies within the vaults is cut away.
std::pair<double, double> extent(const Bridge& bridge, std::size_t support) {
  const Support& at = bridge.supports[support];
  return {support == 0 ? at.x1 - bridge.backing_over_abutment[0] : crown(bridge, support - 1),
          support == bridge.last_support() ? at.x0 + bridge.backing_over_abutment[1] : crown(bridge, support)};
}

/// Course by course, in all bands that begin below `top`.
void lay_up_to(Layout& layout, const Bridge& bridge, std::size_t support, double x0, double x1, double top) {
  int course = 0;
  for (const Band& band : interior_bands(bridge)) {
    if (band.z0 >= top) break;
    const double inner = bridge.half_width() - band.thickness;
    lay_courses(layout, {x0, -inner, band.z0}, {x1, inner, band.z1}, bridge.unit(Component::backing, int(support)),
                course);
    course += int(split(band.z0, band.z1, bridge.block.z()).size()) - 1;
  }
}

/// Under one straight piece of the line after the other; head joints go through where they meet.
void lay_under_line(Layout& layout, const Bridge& bridge, std::size_t support) {
  const SectionLimits usual = layout.limits;
  const auto [x0, x1] = extent(bridge, support);
  const Polygon& line = bridge.backing_line;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double from = std::max(x0, line[i].x()), to = std::min(x1, line[i + 1].x());
    if (to - from < no_masonry) continue;
    layout.limits.past.push_back(under_backing(line[i], line[i + 1]));
    lay_up_to(layout, bridge, support, from, to, std::max(line[i].z(), line[i + 1].z()));
    layout.limits = usual;
  }
}

}  // namespace

void lay_backing(Layout& layout, const Bridge& bridge) {
  for (std::size_t support = 0; support < bridge.supports.size(); ++support) {
    const auto [x0, x1] = extent(bridge, support);
    if (bridge.backing_line.empty()) {
      lay_up_to(layout, bridge, support, x0, x1, bridge.backing_top);
    } else {
      lay_under_line(layout, bridge, support);
    }
  }
}

}  // namespace voussoir
