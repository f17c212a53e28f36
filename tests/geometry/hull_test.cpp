#include "geometry/hull.h"

#include <gtest/gtest.h>

#include "geometry/repair.h"
#include "tests/geometry/shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

TEST(ConvexHull, OfABoxWithPointsInsideIsTheBox) {
  const Polyhedron box = placed(make_box({0, 0, 0}, {1, 2, 3}), turn({1, 2, 3}, 0.7), {40, -5, 6});
  std::vector<Vec3> points = box.vertices;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 200; ++k) {  // also on faces and edges
    Vec3 p(share(random), 2.0 * share(random), 3.0 * share(random));
    if (k % 3 == 0) p.x() = 0.0;
    if (k % 6 == 0) p.z() = 3.0;
    points.insert(points.begin(), turn({1, 2, 3}, 0.7) * p + Vec3(40, -5, 6));
  }
  const Polyhedron hull = merge_coplanar_faces(convex_hull(points), 1e-6);
  EXPECT_EQ(convexity_error(hull), "");
  EXPECT_EQ(hull.vertices.size(), 8u);
  EXPECT_EQ(hull.faces.size(), 6u);
  EXPECT_NEAR(mass_properties(hull).volume, 6.0, 1e-12);
}

/// The volume of a regular polyhedron of many corners on a sphere is between those of inscribed and circumscribed ones.
TEST(ConvexHull, OfPointsOnASphere) {
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k < 40; ++k) {
      const double up = k_pi * (i + 0.5) / 30, round = 2.0 * k_pi * k / 40;
      points.emplace_back(std::sin(up) * std::cos(round), std::sin(up) * std::sin(round), std::cos(up));
    }
  const Polyhedron hull = convex_hull(points);
  const double sphere = 4.0 * k_pi / 3.0;
  EXPECT_LT(mass_properties(hull).volume, sphere);
  EXPECT_GT(mass_properties(hull).volume, 0.98 * sphere);
  EXPECT_EQ(hull.vertices.size(), points.size());
  for (std::size_t f = 0; f < hull.faces.size(); ++f)
    for (const Vec3& p : points)
      EXPECT_LT(face_plane(hull, int(f)).normal.dot(p) - face_plane(hull, int(f)).offset, 1e-8);
}

TEST(ConvexHull, OfPointsWithoutVolumeIsEmpty) {
  EXPECT_TRUE(convex_hull({}).faces.empty());
  EXPECT_TRUE(convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).faces.empty());
  EXPECT_TRUE(convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.4, 1e-12}}).faces.empty());
  EXPECT_TRUE(convex_hull(std::vector<Vec3>(9, Vec3(1, 2, 3))).faces.empty());
  EXPECT_TRUE(convex_hull({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).faces.empty());
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
