// Line segments.
#pragma once
#include <algorithm>
#include <utility>

#include "geometry/polyhedron.h"

namespace voussoir {

struct Segment {
  Vec3 from, to;  // m
};

/// Nearest points of two segments, m. A segment may have zero length. The parameter of the nearest point of each
/// segment is computed from that of the other and limited to the segment.
inline std::pair<Vec3, Vec3> nearest_points(const Segment& p, const Segment& q) {
  const auto clamped = [](double above, double below) {
    return below > 0.0 ? std::clamp(above / below, 0.0, 1.0) : 0.0;
  };
  const Vec3 u = p.to - p.from, v = q.to - q.from, w = p.from - q.from;
  const double uu = u.dot(u), vv = v.dot(v), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 1e-14 * uu * vv ? std::clamp((uv * vw - vv * uw) / determinant, 0.0, 1.0) : 0.5;
  const double t = clamped(vw + s * uv, vv);
  s = clamped(t * uv - uw, uu);
  return {p.from + s * u, q.from + t * v};
}

}  // namespace voussoir
