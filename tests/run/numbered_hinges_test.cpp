// Hinges of a mechanism as a reader counts them.
#include "tools/run/numbered_hinges.h"

#include <gtest/gtest.h>

namespace voussoir {
namespace VOUSSOIR_FILE {

/// Two rows of blocks side by side along y, four blocks a row along x.
Assembly two_rows() {
  Assembly assembly;
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i < 4; ++i) {
      Block block;
      block.component = i == 0 ? Component::abutment : Component::wall;
      block.centroid = Vec3(i, row, 0.0);
      assembly.blocks.push_back(block);
    }
  return assembly;
}

MechanismJoint joint(std::int64_t a, std::int64_t b, const Vec3& place, bool slides, double opening) {
  MechanismJoint j;
  j.a = a, j.b = b, j.place = place, j.slides = slides, j.opening = opening;
  return j;
}

TEST(NumberedHinges, JointsSideBySideAreOne) {
  const Assembly assembly = two_rows();
  const std::vector<NumberedHinge> hinges =
      numbered_hinges(assembly,
                      {joint(1, 2, {1.5, 0.0, 0.2}, false, 0.3), joint(5, 6, {1.5, 1.0, 0.2}, false, 0.4),
                       joint(2, 3, {2.5, 0.0, 0.0}, true, 0.1), joint(0, 1, {0.5, 0.0, 0.0}, false, 0.2)},
                      1.0);
  ASSERT_EQ(hinges.size(), 3u);
  EXPECT_EQ(hinges[0].number, 1);
  EXPECT_EQ(hinges[0].where, "between abutment left and wall");
  EXPECT_EQ(hinges[1].joints, 2);
  EXPECT_NEAR((hinges[1].place - Vec3(1.5, 0.5, 0.2)).norm(), 0.0, 1e-12);
  EXPECT_EQ(hinges[1].opening, 0.4);
  EXPECT_EQ(hinges[1].where, "wall");
  EXPECT_TRUE(hinges[2].slides);
}

TEST(NumberedHinges, AHingeAndASlideAtOnePlaceAreTwo) {
  const Assembly assembly = two_rows();
  EXPECT_EQ(numbered_hinges(assembly,
                            {joint(1, 2, {1.5, 0.0, 0.0}, false, 0.3), joint(5, 6, {1.5, 1.0, 0.0}, true, 0.0)}, 1.0)
                .size(),
            2u);
}

TEST(LargestHinges, AreThoseThatMoveMostInTheirOrder) {
  std::vector<NumberedHinge> all(4);
  for (int i = 0; i < 4; ++i) all[std::size_t(i)].number = i + 1;
  all[0].opening = 0.3, all[1].slip = 0.9, all[2].opening = 1.0, all[3].opening = 0.2;
  const std::vector<NumberedHinge> largest = largest_hinges(all, 2);
  ASSERT_EQ(largest.size(), 2u);
  EXPECT_EQ(largest[0].number, 2);
  EXPECT_EQ(largest[1].number, 3);
  EXPECT_EQ(largest_hinges(all, 9).size(), 4u);
}

TEST(NumberedHinges, NoneOfNone) {
  EXPECT_TRUE(numbered_hinges(two_rows(), {}, 1.0).empty());
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
