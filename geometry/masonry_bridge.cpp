// Where the parts of a bridge are.
#include <algorithm>
#include <cmath>

#include "geometry/masonry_parts.h"

namespace voussoir {

double Bridge::springing() const {
  double highest = abutment_height;
  for (const double h : pier_heights) highest = std::max(highest, h);
  return highest;
}

double Bridge::deck() const {
  return springing() + 0.5 * clear_span + ring_thickness + fill_over_crown;
}

double Bridge::length() const {
  return span_end(spans - 1) + abutment_length;
}

double Bridge::span_start(int i) const {
  double start = abutment_length + i * (clear_span + pier_thickness);
  for (int j = 0; j < i; ++j) start += own_spans[std::size_t(j)] - clear_span;
  return start;
}

double Bridge::support_height(int support) const {
  return is_abutment(support) ? abutment_height : pier_heights[std::size_t(support) - 1];
}

double Bridge::support_start(int support) const {
  return support == 0 ? 0.0 : span_end(support - 1);
}

double Bridge::support_end(int support) const {
  return support == spans ? length() : span_start(support);
}

Unit Bridge::unit(Component component, int part) const {
  return {component, part, masonry, block};
}

Unit Bridge::fill_unit() const {
  return {Component::backfill, 0, backfill, fill, fill_bonded};
}

std::vector<Band> spandrel_courses(const Bridge& bridge) {
  const double springing = bridge.springing(), deck = bridge.deck();
  const double backing = std::min(springing + bridge.backing_height, deck);
  std::vector<double> z = {springing};
  for (const double to : {backing, deck}) {
    if (to <= z.back()) continue;
    const std::vector<double> more = split(z.back(), to, bridge.block.z());
    z.insert(z.end(), more.begin() + 1, more.end());
  }
  std::vector<Band> courses;
  const double last = std::max(1.0, double(z.size()) - 2.0);
  for (std::size_t k = 0; k + 1 < z.size(); ++k) {
    const double share = double(k) / last;
    courses.push_back(
        {z[k], z[k + 1], bridge.spandrel_bottom + share * (bridge.spandrel_top - bridge.spandrel_bottom)});
  }
  return courses;
}

std::vector<Band> interior_bands(const Bridge& bridge) {
  const double backing = bridge.springing() + bridge.backing_height;
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
