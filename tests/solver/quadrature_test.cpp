// Rules of the patches against moments of the polygon that are computed another way.
#include "solver/model/quadrature.h"

#include "solver/base/error.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Area, first and second moments about the origin.
struct Exact {
  double area = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
};

/// Fan about corner 0 with the edge-midpoint rule (a third of the area on each mid-edge), which is exact for quadratics
/// (Strang & Fix 1973, section 4.3): a rule the program does not use.
Exact exact_moments(const Polygon& p) {
  Exact e;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const double area = 0.5 * (p[i] - p[0]).cross(p[i + 1] - p[0]).norm();
    for (const Vec3& x : {Vec3(0.5 * (p[0] + p[i])), Vec3(0.5 * (p[i] + p[i + 1])), Vec3(0.5 * (p[i + 1] + p[0]))}) {
      e.area += area / 3;
      e.first += area / 3 * x;
      e.second += area / 3 * x * x.transpose();
    }
  }
  return e;
}

void check(const Polygon& polygon, const PatchShape& shape) {
  const Vec3 normal = polygon_normal(polygon);
  const Exact exact = exact_moments(polygon);
  double size = 0.0, area = 0.0, product = 0.0, ss = 0.0, tt = 0.0;
  for (const Vec3& p : polygon) size = std::max(size, p.norm());
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const PatchPoint& q : shape.points) {
    EXPECT_GT(q.weight, 0.0);
    const Vec3 x = shape.centroid + shape.frame * Vec3(0.0, q.s, q.t);
    area += q.weight, first += q.weight * x, second += q.weight * x * x.transpose();
    product += q.weight * q.s * q.t, ss += q.weight * q.s * q.s, tt += q.weight * q.t * q.t;
  }
  const double tolerance = 1e-12 * exact.area;
  EXPECT_NEAR(area, exact.area, tolerance);
  EXPECT_NEAR(shape.area, exact.area, tolerance);
  EXPECT_LT((first - exact.first).norm(), tolerance * size);
  EXPECT_LT((second - exact.second).norm(), tolerance * size * size);
  EXPECT_LT((shape.centroid - exact.first / exact.area).norm(), 1e-12 * size);
  // The principal moments are those of the rule, and principal.
  EXPECT_NEAR(product, 0.0, tolerance * size * size);
  EXPECT_NEAR(shape.ss, ss, tolerance * size * size);
  EXPECT_NEAR(shape.tt, tt, tolerance * size * size);
  EXPECT_LT((shape.frame.transpose() * shape.frame - Mat3::Identity()).norm(), 1e-14);
  EXPECT_GT(shape.frame.determinant(), 0.0);
  EXPECT_LT((shape.frame.col(0) - normal).norm(), 1e-14);
}

void check(const Polygon& polygon, int per_side) {
  check(polygon, patch_shape(polygon, polygon_normal(polygon), per_side));
}

/// How far the four points of equal weight stay inside the polygon, m.
double check_moment_points(const Polygon& polygon) {
  PatchShape shape = patch_shape(polygon, polygon_normal(polygon), 3);
  shape.points = moment_points(shape);
  EXPECT_EQ(shape.points.size(), 4u);
  for (std::size_t i = 0; i < 2; ++i) {  // the pass keeps two, and takes the others opposite
    EXPECT_EQ(shape.points[i + 2].s, -shape.points[i].s);
    EXPECT_EQ(shape.points[i + 2].t, -shape.points[i].t);
    EXPECT_EQ(shape.points[i].weight, 0.25 * shape.area);
  }
  check(polygon, shape);
  double least = 1e300;
  for (std::size_t i = 0; i < shape.corners.size(); ++i)
    for (const PatchPoint& q : shape.points) {
      const PatchPoint &a = shape.corners[i], &b = shape.corners[(i + 1) % shape.corners.size()];
      const double twice_area = (b.s - a.s) * (q.t - a.t) - (b.t - a.t) * (q.s - a.s);
      least = std::min(least, twice_area / std::hypot(b.s - a.s, b.t - a.t));
    }
  return least;
}

/// Every corner of the polygon is a corner of the shape and a point of the rule, so that a joint can hinge there.
void check_corners(const Polygon& polygon, int per_side) {
  const PatchShape shape = patch_shape(polygon, polygon_normal(polygon), per_side);
  ASSERT_EQ(shape.corners.size(), polygon.size());
  const auto nearest = [&](const std::vector<PatchPoint>& points, const Vec3& corner) {
    double least = 1e300;
    for (const PatchPoint& q : points)
      least = std::min(least, (shape.centroid + shape.frame * Vec3(0.0, q.s, q.t) - corner).norm());
    return least;
  };
  for (const Vec3& corner : polygon) {
    EXPECT_LT(nearest(shape.corners, corner), 1e-12);
    EXPECT_LT(nearest(shape.points, corner), 1e-12);
  }
}

const Polygon square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const Polygon triangle = {{0, 0, 0}, {2, 0.1, 0}, {0.3, 0.7, 0}};

TEST(Quadrature, IsExactForQuadraticsOnTheSquareAndTheTriangle) {
  for (int per_side : {3, 4, 5}) check(square, per_side), check(triangle, per_side);
}

TEST(Quadrature, SquareHasItsClosedForm) {
  const PatchShape shape = patch_shape(square, Vec3::UnitZ(), 3);
  EXPECT_NEAR(shape.area, 1.0, 1e-15);
  EXPECT_NEAR(shape.ss, 1.0 / 12, 1e-15);
  EXPECT_NEAR(shape.tt, 1.0 / 12, 1e-15);
  ASSERT_EQ(shape.points.size(), 9u);
}

TEST(Quadrature, NumberOfPoints) {
  EXPECT_EQ(patch_shape(square, Vec3::UnitZ(), 4).points.size(), 16u);
  EXPECT_EQ(patch_shape(square, Vec3::UnitZ(), 5).points.size(), 25u);
  EXPECT_EQ(patch_shape(triangle, Vec3::UnitZ(), 3).points.size(), 7u);
}

TEST(Quadrature, IsExactOnRandomConvexPolygonsInAnyPlane) {
  std::mt19937 random(11);
  for (int corners = 3; corners <= 9; ++corners)
    for (int repeat = 0; repeat < 20; ++repeat) {
      Polygon polygon = random_polygon(corners, random);
      const Mat3 r = random_rotation(random).toRotationMatrix();
      const Vec3 shift = random_vector(3.0, random);
      for (Vec3& p : polygon) p = r * p + shift;
      for (int per_side : {3, 4, 5}) check(polygon, per_side);
      check_corners(polygon, 3);
    }
}

TEST(Quadrature, FourPointsDoForAnyConvexPolygon) {
  EXPECT_NEAR(check_moment_points(square), 0.5 - std::sqrt(1.0 / 12), 1e-14);  // Gauss's
  const double side = std::sqrt(0.75);
  EXPECT_GT(check_moment_points({{0, 0, 0}, {1, 0, 0}, {0.5, side, 0}}), 0.0);
  EXPECT_GT(check_moment_points(triangle), 0.0);
  std::mt19937 random(12);
  for (int corners = 3; corners <= 9; ++corners)
    for (int repeat = 0; repeat < 200; ++repeat)
      EXPECT_GT(check_moment_points(random_polygon(corners, random)), -1e-12);
}

TEST(Quadrature, RefusesOtherNumbersOfPoints) {
  EXPECT_THROW(patch_shape(square, Vec3::UnitZ(), 6), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
