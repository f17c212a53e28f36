#include "geometry/kern.h"

#include <algorithm>
#include <cmath>

namespace voussoir {

namespace {

/// Area and second moments, which have the sign of the corners' sense.
std::pair<double, SecondMoments> signed_moments(const PlaneCorners& corners) {
  double area = 0.0;
  SecondMoments m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d &p = corners[i], &q = corners[(i + 1) % corners.size()];
    const double cross = p.x() * q.y() - q.x() * p.y();
    area += cross / 2.0;
    m.xx += cross * (p.x() * p.x() + p.x() * q.x() + q.x() * q.x()) / 12.0;
    m.yy += cross * (p.y() * p.y() + p.y() * q.y() + q.y() * q.y()) / 12.0;
    m.xy += cross * (2.0 * (p.x() * p.y() + q.x() * q.y()) + p.x() * q.y() + q.x() * p.y()) / 24.0;
  }
  return {area, m};
}

}  // namespace

SecondMoments second_moments(const PlaneCorners& corners) {
  const auto& [area, m] = signed_moments(corners);
  const double sense = area < 0.0 ? -1.0 : 1.0;
  return {sense * m.xx, sense * m.xy, sense * m.yy};
}

double eccentricity_over_depth(const PlaneCorners& corners, const Eigen::Vector2d& centre) {
  const auto& [area, m] = signed_moments(corners);
  const double determinant = m.xx * m.yy - m.xy * m.xy;
  if (!(determinant > 0.0)) return 0.0;
  const Eigen::Vector2d slope =
      area / determinant *
      Eigen::Vector2d(m.yy * centre.x() - m.xy * centre.y(), m.xx * centre.y() - m.xy * centre.x());
  double fall = 0.0;
  for (const Eigen::Vector2d& x : corners) fall = std::max(fall, -slope.dot(x));
  return fall / 6.0;
}

double eccentricity_over_depth(const Polygon& polygon, const Vec3& normal, const Vec3& offset) {
  const Vec3 s = normal.unitOrthogonal(), t = normal.cross(s), middle = polygon_centroid(polygon);
  PlaneCorners corners;
  for (const Vec3& x : polygon) corners.emplace_back(s.dot(x - middle), t.dot(x - middle));
  return eccentricity_over_depth(corners, {s.dot(offset), t.dot(offset)});
}

}  // namespace voussoir
