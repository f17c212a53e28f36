#include "solver/model/quadrature.h"

#include <algorithm>
#include <cmath>

#include "solver/base/error.h"

namespace voussoir {

namespace {

using Vec2 = Eigen::Vector2d;

/// Tensor rule on the bilinear map. A quadratic of the plane is of degree 2 in each map coordinate, the Jacobian of
/// degree 1, and three Lobatto points integrate degree 3: exact for any convex quadrilateral.
std::vector<PatchPoint> tensor_rule(const std::vector<Vec2>& p, int per_side) {
  const LineRule rule = lobatto_rule(per_side);
  const Vec2 e = p[1] - p[0], f = p[3] - p[0], twist = p[0] - p[1] + p[2] - p[3];
  std::vector<PatchPoint> points;
  points.reserve(std::size_t(per_side * per_side));
  for (int i = 0; i < per_side; ++i)
    for (int j = 0; j < per_side; ++j) {
      const double x = 0.5 + 0.5 * rule.x[i], y = 0.5 + 0.5 * rule.x[j];
      const Vec2 at = p[0] + x * e + y * f + x * y * twist;
      const Vec2 dx = e + y * twist, dy = f + x * twist;
      points.push_back({at.x(), at.y(), rule.w[i] * rule.w[j] * (dx.x() * dy.y() - dx.y() * dy.x())});
    }
  return points;
}

/// Fan about the centroid: each triangle's rule puts 1/12 on its three corners and 3/4 on its own centroid, which is
/// exact for quadratics (Zienkiewicz & Taylor 2000, vol. 1, table 9.2, cubic family without edge points).
std::vector<PatchPoint> fan_rule(const std::vector<Vec2>& p) {
  const std::size_t m = p.size();
  std::vector<PatchPoint> points(2 * m + 1);
  for (std::size_t i = 0; i < m; ++i) points[i] = {p[i].x(), p[i].y(), 0.0};
  for (std::size_t i = 0; i < m; ++i) {
    const Vec2 &a = p[i], &b = p[(i + 1) % m];
    const double area = 0.5 * (a.x() * b.y() - a.y() * b.x());
    points[i].weight += area / 12;
    points[(i + 1) % m].weight += area / 12;
    points[2 * m].weight += area / 12;
    points[m + i] = {(a.x() + b.x()) / 3, (a.y() + b.y()) / 3, 0.75 * area};
  }
  return points;
}

struct Moments {
  double area = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  Vec2 first = Vec2::Zero();
};

Moments moments(const std::vector<Vec2>& p) {
  Moments m;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 &a = p[i], &b = p[(i + 1) % p.size()];
    const double c = a.x() * b.y() - a.y() * b.x();
    m.area += c / 2;
    m.first += c / 6 * (a + b);
    m.xx += c / 12 * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x());
    m.yy += c / 12 * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y());
    m.xy += c / 24 * (2 * a.x() * a.y() + a.x() * b.y() + b.x() * a.y() + 2 * b.x() * b.y());
  }
  return m;
}

}  // namespace

LineRule lobatto_rule(int n) {
  if (n == 3) return {3, {-1.0, 0.0, 1.0}, {1.0 / 6, 4.0 / 6, 1.0 / 6}};
  if (n == 4) {
    const double a = 1.0 / std::sqrt(5.0);
    return {4, {-1.0, -a, a, 1.0}, {1.0 / 12, 5.0 / 12, 5.0 / 12, 1.0 / 12}};
  }
  if (n == 5) {
    const double a = std::sqrt(3.0 / 7.0);
    return {5, {-1.0, -a, 0.0, a, 1.0}, {1.0 / 20, 49.0 / 180, 64.0 / 180, 49.0 / 180, 1.0 / 20}};
  }
  throw InputError("points_per_side is {}. It must be 3, 4 or 5.", n);
}

std::vector<PatchPoint> rectangle_points(const PatchShape& rectangle, int per_side) {
  const LineRule rule = lobatto_rule(per_side);
  std::vector<PatchPoint> points;
  points.reserve(std::size_t(per_side * per_side));
  for (int i = 0; i < per_side; ++i)
    for (int j = 0; j < per_side; ++j)
      points.push_back(
          {rectangle.half_s * rule.x[i], rectangle.half_t * rule.x[j], rule.w[i] * rule.w[j] * rectangle.area});
  return points;
}

std::vector<PatchPoint> moment_points(const PatchShape& shape) {
  const double s = std::sqrt(shape.ss / shape.area), t = std::sqrt(shape.tt / shape.area), w = 0.25 * shape.area;
  return {{s, t, w}, {-s, t, w}, {-s, -t, w}, {s, -t, w}};
}

PatchShape patch_shape(const Polygon& polygon, const Vec3& normal, int per_side) {
  PatchShape shape;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& v : polygon) mean += v / double(polygon.size());
  // A first frame from the longest edge, then the principal axes within it.
  Vec3 longest = Vec3::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (edge.squaredNorm() > longest.squaredNorm() * (1 + 1e-9)) longest = edge;
  }
  const Vec3 s0 = (longest - normal * normal.dot(longest)).normalized();
  const Vec3 t0 = normal.cross(s0);
  std::vector<Vec2> p;
  p.reserve(polygon.size()), shape.corners.reserve(polygon.size());
  for (const Vec3& v : polygon) p.emplace_back(s0.dot(v - mean), t0.dot(v - mean));
  const Moments about_mean = moments(p);
  shape.area = about_mean.area;
  const Vec2 centroid = about_mean.first / about_mean.area;
  for (Vec2& v : p) v -= centroid;
  const Moments m = moments(p);
  const double angle = 0.5 * std::atan2(2 * m.xy, m.xx - m.yy);
  const bool aligned = std::abs(m.xy) < 1e-12 * (m.xx + m.yy);
  const double c = aligned ? 1.0 : std::cos(angle), s = aligned ? 0.0 : std::sin(angle);
  for (Vec2& v : p) v = Vec2(c * v.x() + s * v.y(), -s * v.x() + c * v.y());
  shape.centroid = mean + s0 * centroid.x() + t0 * centroid.y();
  shape.frame.col(0) = normal;
  shape.frame.col(1) = c * s0 + s * t0;
  shape.frame.col(2) = normal.cross(shape.frame.col(1));
  const Moments principal = moments(p);
  shape.ss = principal.xx;
  shape.tt = principal.yy;
  for (const Vec2& v : p) {
    shape.corners.push_back({v.x(), v.y(), 0.0});
    shape.half_s = std::max(shape.half_s, std::abs(v.x()));
    shape.half_t = std::max(shape.half_t, std::abs(v.y()));
  }
  const double slack = 2e-12 * (shape.half_s + shape.half_t);  // rounding of coordinates some 100 m from the origin
  const auto fills = [&](const Vec2& v) {
    return std::abs(v.x()) > shape.half_s - slack && std::abs(v.y()) > shape.half_t - slack;
  };
  shape.rectangle = p.size() == 4 && std::all_of(p.begin(), p.end(), fills);
  shape.points = shape.rectangle ? rectangle_points(shape, per_side)
                 : p.size() == 4 ? tensor_rule(p, per_side)
                                 : fan_rule(p);
  return shape;
}

}  // namespace voussoir
