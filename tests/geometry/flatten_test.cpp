// Stones whose faces are not quite plane.
#include "geometry/flatten.h"

#include <gtest/gtest.h>

#include "geometry/joints.h"
#include "geometry/repair.h"
#include "geometry/stiffness.h"
#include "tests/geometry/shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

/// A unit cube whose top corners stand by turns `d` above and below 1: its best top plane is z = 1.
Polyhedron warped_cube(double d) {
  Polyhedron cube = unit_cube();
  for (Vec3& p : cube.vertices)
    if (p.z() > 0.5) p.z() += (p.x() > 0.5) == (p.y() > 0.5) ? d : -d;
  return cube;
}

/// Its faces cut into triangles, along either diagonal.
Polyhedron in_triangles(const Polyhedron& shape, std::size_t start) {
  Polyhedron out{shape.vertices, {}};
  for (const auto& loop : shape.faces)
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      out.faces.push_back(
          {loop[start % loop.size()], loop[(start + i) % loop.size()], loop[(start + i + 1) % loop.size()]});
  return out;
}

void expect_cube(const std::optional<Flattened>& flat, double moved) {
  ASSERT_TRUE(flat);
  EXPECT_EQ(convexity_error(flat->shape), "");
  EXPECT_EQ(flat->shape.faces.size(), 6u);
  EXPECT_EQ(flat->shape.vertices.size(), 8u);
  EXPECT_NEAR(mass_properties(flat->shape).volume, 1.0, 1e-12);
  EXPECT_NEAR(flat->moved, moved, 1e-12);
}

TEST(Flatten, AWarpedFaceGetsItsBestPlane) {
  EXPECT_NE(convexity_error(warped_cube(4e-4)), "");
  expect_cube(flatten(warped_cube(4e-4), 1e-3), 4e-4);
  expect_cube(flatten(in_triangles(warped_cube(4e-4), 0), 1e-3), 4e-4);
  expect_cube(flatten(in_triangles(warped_cube(4e-4), 1), 1e-3), 4e-4);
}

TEST(Flatten, AWarpBeyondWhatIsAllowedStays) {
  EXPECT_FALSE(flatten(warped_cube(1.1e-3), 1e-3));
  EXPECT_TRUE(flatten(warped_cube(0.9e-3), 1e-3));
  expect_cube(flatten(warped_cube(0.02), 0.025), 0.02);
}

TEST(Flatten, AnotherShapeStays) {
  const Polyhedron ell = make_prism({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, {0, 0, 1});
  EXPECT_FALSE(flatten(ell, 1e-3));
  EXPECT_FALSE(flatten(ell, 0.1));
}

/// A point where four faces meet stays one point, or becomes a short edge: the solid is closed in any case.
TEST(Flatten, APyramidWhoseApexIsRounded) {
  Polyhedron pyramid{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 3e-4}, {0.5, 0.5, 0.7}},
                     {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  const auto flat = flatten(pyramid, 1e-3);
  ASSERT_TRUE(flat);
  EXPECT_EQ(convexity_error(flat->shape), "");
  EXPECT_LT(flat->moved, 1e-3);
  EXPECT_NEAR(mass_properties(flat->shape).volume, 0.7 / 3.0, 1e-3);
}

/// Stones with the same corners get the same plane, so they meet without a gap.
TEST(Flatten, NeighboursMeet) {
  const double d = 3e-4;
  Polyhedron above = placed(unit_cube(), Mat3::Identity(), {0, 0, 1});
  for (Vec3& p : above.vertices)
    if (p.z() < 1.5) p.z() += (p.x() > 0.5) == (p.y() > 0.5) ? d : -d;
  Assembly both = assembly_of(
      {block_of({flatten(warped_cube(d), 1e-3)->shape}), block_of({flatten(in_triangles(above, 1), 1e-3)->shape})});
  const JointReport report = find_joints(both, careful_search());
  ASSERT_EQ(report.joints, 1);
  EXPECT_EQ(report.closed_gaps, 0);
  EXPECT_NEAR(both.joints[0].area, 1.0, 1e-9);
}

/// Coordinates in single precision let stones that meet along an edge overlap by a strip.
TEST(FindJoints, StripsAlongAnEdgeAreNone) {
  const auto joints = [](double overlap, const JointSearch& search) {
    Assembly a = assembly_of({block_of({unit_cube()}), block_of({make_box({1.0 - overlap, 0, 1}, {2, 1, 2})})});
    return find_joints(a, search).joints;
  };
  EXPECT_EQ(joints(1e-7, {}), 1);
  EXPECT_EQ(joints(1e-7, careful_search()), 0);
  EXPECT_EQ(joints(9e-5, careful_search()), 0);
  EXPECT_EQ(joints(2e-4, careful_search()), 1);
}

TEST(LayJoints, TakesModuliOrWhatIsGiven) {
  Assembly pile = assembly_of({block_of({unit_cube()}), block_of({make_box({0, 0, 1}, {1, 1, 2})})});
  pile.blocks[0].fixed = true;
  pile.materials[0].cohesion = 1e5;
  finish_blocks(pile);
  lay_joints(pile, {});
  ASSERT_EQ(pile.joints.size(), 1u);
  EXPECT_NEAR(pile.joints[0].kn, 1e9 / 1.0, 1.0);  // E over the distance between the centroids
  EXPECT_EQ(pile.laws.at(0).cohesion, 1e5);
  lay_joints(pile, {}, {5e9, 2e9});
  EXPECT_EQ(pile.joints[0].kn, 5e9);
  EXPECT_EQ(pile.laws.size(), 1u);
  pile.materials[0].youngs_modulus = 0.0;
  const std::string message = error_of([&] { lay_joints(pile, {}); });
  EXPECT_NE(message.find("1 block has no moduli, so its joints have no stiffness. Give kn and ks, or materials"),
            std::string::npos);
  EXPECT_NE(message.find("The blocks are: block 1 (block, part 0), material \"stone\""), std::string::npos) << message;
  EXPECT_NE(error_of([&] { lay_joints(pile, {}, {5e9, 0.0}); }).find("Give both"), std::string::npos);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
