#include "viz/crack_map/intrados.h"

#include <algorithm>
#include <cmath>

namespace voussoir {

namespace {

Intrados intrados_of(const MeasuredSpan& span, double skew, double middle) {
  Intrados i;
  i.part = span.part;
  i.along = Vec3(std::cos(skew), -std::sin(skew), 0.0);
  i.axis = Vec3(std::sin(skew), std::cos(skew), 0.0);
  i.origin = Vec3(0.0, middle, 0.0);
  i.thickness = span.crown_thickness;
  for (const Vec3& corner : span.intrados) {  // (x, z) in the upright plane along the middle
    const Vec3 at(i.along.x() * corner.x(), corner.y(), 0.0);
    if (i.profile.empty() || (at - i.profile.back()).norm() > 1e-6) {
      i.arc.push_back(i.profile.empty() ? 0.0 : i.arc.back() + (at - i.profile.back()).norm());
      i.profile.push_back(at);
    }
  }
  return i;
}

}  // namespace

Intrados::Place Intrados::unrolled(const Vec3& x) const {
  const Vec3 at(along.dot(x - origin), x.z(), 0.0);
  Place nearest{0.0, axis.dot(x - origin), 1e300};
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    const Vec3 side = profile[k + 1] - profile[k];
    const double share = std::clamp(side.dot(at - profile[k]) / side.squaredNorm(), 0.0, 1.0);
    const double off = (at - profile[k] - share * side).norm();
    if (off < nearest.off) nearest.off = off, nearest.s = arc[k] + share * side.norm();
  }
  return nearest;
}

bool Intrados::holds(const Vec3& x) const {
  return unrolled(x).off < (std::isfinite(thickness) ? 0.1 * thickness : 1e-3 * length());
}

double Intrados::share_of_span(const Vec3& x) const {
  const double left = profile.front().x(), right = profile.back().x();
  return (along.dot(x - origin) - left) / (right - left);
}

std::vector<Intrados> find_intrados(const Measures& measures) {
  std::vector<Intrados> all;
  for (const MeasuredSpan& span : measures.spans)
    if (Intrados one = intrados_of(span, measures.skew, measures.middle); one.profile.size() > 1)
      all.push_back(std::move(one));
  return all;
}

}  // namespace voussoir
