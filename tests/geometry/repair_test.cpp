#include "geometry/repair.h"

#include <gtest/gtest.h>

#include "tests/geometry/shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

/// Every face as a fan of triangles, each with vertices of its own, as an STL file has them.
Polyhedron triangle_soup(const Polyhedron& shape) {
  Polyhedron out;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const Polygon loop = face_polygon(shape, static_cast<int>(f));
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const int n = static_cast<int>(out.vertices.size());
      for (const Vec3& p : {loop[0], loop[i], loop[i + 1]}) out.vertices.push_back(p);
      out.faces.push_back({n, n + 1, n + 2});
    }
  }
  return out;
}

TEST(MergeCoplanarFaces, MakesACubeOfTwelveTriangles) {
  const Polyhedron soup = triangle_soup(placed(unit_cube(), turn({1, 2, 3}, 0.5), {30, 4, 5}));
  ASSERT_EQ(soup.faces.size(), 12u);
  const Polyhedron cube = merge_coplanar_faces(soup, 1e-3);
  EXPECT_EQ(cube.vertices.size(), 8u);
  ASSERT_EQ(cube.faces.size(), 6u);
  for (const auto& face : cube.faces) EXPECT_EQ(face.size(), 4u);
  EXPECT_EQ(convexity_error(cube), "");
  EXPECT_NEAR(mass_properties(cube).volume, 1.0, 1e-12);
}

TEST(MergeCoplanarFaces, DropsVerticesInsideFacesAndOnEdges) {
  // A box whose top is fanned about its middle and about a point on one edge, which the side shares.
  Polyhedron box = unit_cube();
  box.vertices.push_back({0.5, 0.5, 1.0});
  box.vertices.push_back({0.5, 0.0, 1.0});
  box.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 9, 4}, {2, 6, 7, 3}, {0, 2, 3, 1},
               {4, 9, 8},    {9, 5, 8},    {5, 7, 8},       {7, 6, 8},    {6, 4, 8}};
  ASSERT_EQ(convexity_error(box), "");
  const Polyhedron merged = merge_coplanar_faces(box, 1e-3);
  EXPECT_EQ(merged.vertices.size(), 8u);
  EXPECT_EQ(merged.faces.size(), 6u);
  EXPECT_EQ(convexity_error(merged), "");
}

TEST(MergeCoplanarFaces, KeepsFacesThatTurnMoreThanTheAngle) {
  Polyhedron barrel = make_box({-2, 0, -2}, {2, 1, 2});
  for (int i = 0; i < 20; ++i)
    barrel = cut(barrel, {Vec3(std::cos(0.1 * k_pi * i), 0.0, std::sin(0.1 * k_pi * i)), 1.0});
  const Polyhedron merged = merge_coplanar_faces(triangle_soup(barrel), 0.05);
  EXPECT_EQ(merged.faces.size(), 22u);
  EXPECT_EQ(convexity_error(merged), "");
  EXPECT_NEAR(mass_properties(merged).volume, 20 * std::tan(k_pi / 20), 1e-12);
}

TEST(MergeCoplanarFaces, KeepsTheEndsOfAThinWedge) {
  // An end of 0.8 mm2 on a stone of 1.1 m is small, but a face like any other: it is 0.7 mm wide.
  const std::vector<Vec3> end = {{0, 0, 0}, {2.3e-3, 0, 0.3e-3}, {2.0e-3, 0, -0.4e-3}};
  Polyhedron wedge;
  for (const double y : {0.0, 1.1})
    for (const Vec3& p : end) wedge.vertices.push_back(p + Vec3(0, y, 0));
  wedge.faces = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  if (mass_properties(wedge).volume < 0.0)
    for (auto& face : wedge.faces) std::ranges::reverse(face);
  const Polyhedron merged = merge_coplanar_faces(wedge, 1e-3);
  EXPECT_EQ(merged.faces.size(), 5u);
  EXPECT_EQ(convexity_error(merged), "");
}

bool says(const Polyhedron& shape, const std::string& words) {
  const std::string error = convexity_error(shape);
  return error.find(words) != std::string::npos;
}

TEST(ConvexityError, SaysWhatIsWrong) {
  const Polyhedron cube = unit_cube();
  EXPECT_EQ(convexity_error(cube), "");
  Polyhedron bad = cube;
  bad.faces.pop_back();
  EXPECT_TRUE(says(bad, "not closed"));
  bad = cube;
  for (auto& face : bad.faces) std::reverse(face.begin(), face.end());
  EXPECT_TRUE(says(bad, "inside-out"));
  bad = cube;
  std::reverse(bad.faces[2].begin(), bad.faces[2].end());
  EXPECT_TRUE(says(bad, "the same direction"));
  bad = cube;
  bad.vertices[4].z() = NAN;
  EXPECT_TRUE(says(bad, "vertex 4 is not finite"));
  bad = cube;
  bad.vertices[7].z() = 1.1;
  EXPECT_TRUE(says(bad, "not planar"));
  EXPECT_TRUE(says(make_box({0, 0, 0}, {1, 1, 0}), "no volume"));
  EXPECT_FALSE(convexity_error(Polyhedron{}).empty());
  bad = cube;
  bad.faces[0][1] = 12;
  EXPECT_TRUE(says(bad, "vertex 12"));
}

TEST(ConvexityError, SeesMissingTrianglesAndRecesses) {
  Polyhedron soup = triangle_soup(unit_cube());
  soup.faces.pop_back();
  EXPECT_TRUE(says(merge_coplanar_faces(soup, 1e-3), "not closed"));
  const Polyhedron l = make_prism({{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, {1, 0, 2}, {0, 0, 2}}, {0, 1, 0});
  ASSERT_GT(mass_properties(l).volume, 0.0);
  EXPECT_TRUE(says(l, "not convex"));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
