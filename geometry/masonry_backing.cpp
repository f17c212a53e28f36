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

/// Lays the backing from crown to crown; the vaults cut it.
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

double height(const Plane& under, double x) {
  return (under.offset - under.normal.x() * x) / under.normal.z();
}

/// Lays the backing below each straight piece of the line; head joints are continuous where pieces meet.
void lay_under_line(Layout& layout, const Bridge& bridge, std::size_t support) {
  const SectionLimits usual = layout.limits;
  const auto [x0, x1] = extent(bridge, support);
  along_backing(bridge, x0, x1, [&](double from, double to, const Plane& under) {
    layout.limits.past.push_back(under);
    lay_up_to(layout, bridge, support, from, to, std::max(height(under, from), height(under, to)));
    layout.limits = usual;
  });
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
