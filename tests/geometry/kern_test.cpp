// Eccentricities against the kerns of plane areas.
#include "geometry/kern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/base/constants.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

const PlaneCorners rectangle = {{-0.4, -0.15}, {0.4, -0.15}, {0.4, 0.15}, {-0.4, 0.15}};  // 0.8 × 0.3 m

TEST(Kern, SecondMomentsOfARectangle) {
  for (const bool turned_round : {false, true}) {
    PlaneCorners corners = rectangle;
    if (turned_round) std::reverse(corners.begin(), corners.end());
    const SecondMoments m = second_moments(corners);
    EXPECT_NEAR(m.xx, 0.3 * std::pow(0.8, 3) / 12.0, 1e-15);
    EXPECT_NEAR(m.yy, 0.8 * std::pow(0.3, 3) / 12.0, 1e-15);
    EXPECT_NEAR(m.xy, 0.0, 1e-15);
  }
}

/// A right triangle with legs 3 a and 3 b about its centroid: b h³/36, and ∫ x y dA = −b² h²/72.
TEST(Kern, SecondMomentsOfATriangle) {
  const SecondMoments m = second_moments({{-1.0, -2.0}, {2.0, -2.0}, {-1.0, 4.0}});
  EXPECT_NEAR(m.xx, 6.0 * 27.0 / 36.0, 1e-12);
  EXPECT_NEAR(m.yy, 3.0 * 216.0 / 36.0, 1e-12);
  EXPECT_NEAR(m.xy, -9.0 * 36.0 / 72.0, 1e-12);
}

TEST(Kern, OfARectangleEccentricitiesOverTheirDepthsAddUp) {
  EXPECT_NEAR(eccentricity_over_depth(rectangle, {0.08, 0.0}), 0.1, 1e-12);
  EXPECT_NEAR(eccentricity_over_depth(rectangle, {0.0, -0.15}), 0.5, 1e-12);
  EXPECT_NEAR(eccentricity_over_depth(rectangle, {-0.08, 0.03}), 0.2, 1e-12);
  EXPECT_EQ(eccentricity_over_depth(rectangle, {0.0, 0.0}), 0.0);
}

/// The kern of a circle of radius r has radius r/4 (64 corners: a little more than a regular polygon's).
TEST(Kern, OfACircleEndsAtAQuarterOfItsRadius) {
  PlaneCorners circle;
  for (int i = 0; i < 64; ++i) circle.emplace_back(2.0 * std::cos(pi * i / 32.0), 2.0 * std::sin(pi * i / 32.0));
  EXPECT_NEAR(eccentricity_over_depth(circle, {0.5, 0.0}), 1.0 / 6.0, 1e-3);
}

/// That of a triangle is a triangle: from the centroid a sixth of the height away from a side, a twelfth towards it.
TEST(Kern, OfATriangle) {
  const PlaneCorners triangle = {{-1.0, -1.0}, {1.0, -1.0}, {0.0, 2.0}};  // 3 m high
  EXPECT_NEAR(eccentricity_over_depth(triangle, {0.0, 3.0 / 6.0}), 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(eccentricity_over_depth(triangle, {0.0, -3.0 / 12.0}), 1.0 / 6.0, 1e-12);
}

TEST(Kern, InSpaceAsInThePlane) {
  const Vec3 n = Vec3(1, 2, 3).normalized(), s = n.unitOrthogonal(), t = n.cross(s), c(5, -2, 1);
  Polygon polygon;
  for (const Eigen::Vector2d& x : rectangle) polygon.push_back(c + x.x() * s + x.y() * t);
  EXPECT_NEAR(eccentricity_over_depth(polygon, n, -0.08 * s + 0.03 * t), 0.2, 1e-12);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
