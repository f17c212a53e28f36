// Transverse walls: across between the spandrel walls over each pier, from the backing to the deck.
#include "geometry/masonry_parts.h"

namespace voussoir {

std::vector<std::pair<double, double>> transverse_walls(const Bridge& bridge) {
  std::vector<std::pair<double, double>> walls;
  if (bridge.transverse_thickness <= 0.0) return walls;
  for (std::size_t i = 1; i < bridge.last_support(); ++i) {
    const double middle = 0.5 * (bridge.supports[i].x0 + bridge.supports[i].x1),
                 half = 0.5 * bridge.transverse_thickness;
    walls.emplace_back(middle - half, middle + half);
  }
  return walls;
}

std::vector<std::pair<double, double>> between_transverse_walls(const Bridge& bridge) {
  std::vector<std::pair<double, double>> free;
  double from = 0.0;
  for (const auto& [x0, x1] : transverse_walls(bridge)) {
    free.emplace_back(from, x0);
    from = x1;
  }
  free.emplace_back(from, bridge.length());
  return free;
}

void lay_transverse_walls(Layout& layout, const Bridge& bridge) {
  if (transverse_walls(bridge).empty()) return;
  for (std::size_t support = 1; support < bridge.last_support(); ++support) {
    const auto [x0, x1] = transverse_walls(bridge)[support - 1];
    int course = 0;
    for (const Band& band : interior_bands(bridge)) {
      const double inner = bridge.half_width() - band.thickness;
      lay_above_backing(layout, bridge, {x0, -inner, band.z0}, {x1, inner, band.z1},
                        bridge.unit(Component::backing, int(support)), course);
      course += int(split(band.z0, band.z1, bridge.block.z()).size()) - 1;
    }
  }
}

}  // namespace voussoir
