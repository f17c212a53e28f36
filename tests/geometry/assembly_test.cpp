#include "geometry/assembly.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/curve.h"
#include "geometry/nearest_block.h"
#include "solver/base/error.h"
#include "tests/geometry/shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

TEST(Names, FollowTheEnumerations) {
  EXPECT_EQ(component_names().size(), static_cast<std::size_t>(Component::block) + 1);
  EXPECT_EQ(component_names()[static_cast<std::size_t>(Component::spandrel)], "spandrel");
  EXPECT_EQ(component_names()[static_cast<std::size_t>(Component::restraint)], "restraint");
  EXPECT_EQ(joint_law_kinds()[static_cast<std::size_t>(JointLaw::Kind::elastic)], "elastic");
}

TEST(FinishBlocks, FillsMassCentroidAndInertia) {
  Assembly assembly = assembly_of({block_of({make_box({1, 0, 0}, {1.5, 1, 2}), make_box({1.5, 0, 0}, {3, 1, 2})})});
  finish_blocks(assembly);
  const Block& block = assembly.blocks[0];
  EXPECT_NEAR(block.mass, 8000.0, 1e-9);
  EXPECT_LT((block.centroid - Vec3(2, 0.5, 1)).norm(), 1e-14);
  EXPECT_NEAR(block.inertia(0, 0), 8000.0 * (1 + 4) / 12, 1e-8);
  EXPECT_NEAR(block.inertia(2, 2), 8000.0 * (4 + 1) / 12, 1e-8);
  EXPECT_NEAR(block.inertia(0, 1), 0.0, 1e-9);
  EXPECT_EQ(block_density(assembly, block), 2000.0);
  const Box box = block_box(block);
  EXPECT_EQ(box.low, Vec3(1, 0, 0));
  EXPECT_EQ(box.high, Vec3(3, 1, 2));
}

/// Slab by slab along the longest side, whatever the curve does; each point once, and equal points in their own order.
TEST(Curve, GoesSlabBySlab) {
  std::vector<Vec3> points;
  for (int z = 0; z < 6; ++z)
    for (int x = 0; x < 20; ++x)
      for (int twice = 0; twice < 2; ++twice) points.emplace_back(0.5 * x, 0.0, 0.5 * z);
  const std::vector<std::int32_t> order = in_slabs(points, 1.1);
  std::vector<std::int32_t> each(order);
  std::sort(each.begin(), each.end());
  ASSERT_EQ(each.size(), points.size());
  for (std::size_t i = 0; i < each.size(); ++i) ASSERT_EQ(each[i], std::int32_t(i));
  const auto x_of = [&](std::size_t i) { return points[std::size_t(order[i])].x(); };
  bool goes_back = false;
  for (std::size_t i = 1; i < order.size(); ++i) {
    EXPECT_GE(std::floor(x_of(i) / 1.1), std::floor(x_of(i - 1) / 1.1)) << i;
    goes_back |= x_of(i) < x_of(i - 1);
    if (points[std::size_t(order[i])] == points[std::size_t(order[i - 1])]) {
      EXPECT_GT(order[i], order[i - 1]);
    }
  }
  EXPECT_TRUE(goes_back) << "within a slab it goes to and fro";
  const std::vector<std::int32_t> plain = along_curve(points);
  EXPECT_NE(plain, order);
}

/// A sensor that the survey puts a centimetre off the end is on the bridge, whatever stands against it.
TEST(NearestBlock, IsNeverTheGroundBehindAnEnd) {
  const Assembly assembly = assembly_of(
      {block_of({make_box({0, 0, 0}, {1, 1, 1})}), block_of({make_box({1, 0, 0}, {2, 1, 1})}, Component::restraint)});
  const NearestBlock nearest = nearest_block(assembly, {1.01, 0.5, 0.5});
  EXPECT_EQ(nearest.block, 0);
  EXPECT_NEAR(nearest.distance, 0.01, 1e-12);
}

/// The error of finishing two blocks of which the second is a pier's, changed by `spoil`.
template <class Spoil>
std::string finishing_error(const Spoil& spoil) {
  Assembly assembly = assembly_of({block_of({unit_cube()}), block_of({unit_cube()}, Component::pier)});
  assembly.blocks[1].part = 2;
  spoil(assembly.blocks[1]);
  EXPECT_THROW(finish_blocks(assembly), InputError);
  const std::string text = error_of([&] { finish_blocks(assembly); });
  EXPECT_NE(text.find("block 1 (pier, part 2)"), std::string::npos) << text;
  return text;
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(FinishBlocks, NamesTheBlockThatIsWrong) {
  EXPECT_TRUE(holds(finishing_error([](Block& b) { b.cells[0] = make_box({0, 0, 0}, {1, 1, 0}); }), "thickness"));
  EXPECT_TRUE(holds(finishing_error([](Block& b) {
                      for (auto& face : b.cells[0].faces) std::reverse(face.begin(), face.end());
                    }),
                    "inside-out"));
  EXPECT_TRUE(holds(finishing_error([](Block& b) { b.cells[0].vertices[3].y() = NAN; }), "vertex 3"));
  EXPECT_TRUE(holds(finishing_error([](Block& b) { b.cells[0].vertices[3].y() = INFINITY; }), "finite"));
  EXPECT_TRUE(holds(finishing_error([](Block& b) { b.cells[0].faces[2][1] = 8; }), "It must be from 0 to 7"));
  EXPECT_TRUE(holds(finishing_error([](Block& b) { b.cells.clear(); }), "no cells"));
  EXPECT_TRUE(holds(finishing_error([](Block& b) { b.material = 1; }), "material index is 1"));
}

TEST(FinishBlocks, RefusesAnInsideOutCellThatASiblingOutweighs) {
  const std::string text = finishing_error([](Block& b) {
    b.cells.push_back(make_box({1, 0, 0}, {1.1, 1, 1}));
    for (auto& face : b.cells[1].faces) std::reverse(face.begin(), face.end());
  });
  EXPECT_TRUE(holds(text, "cell 1")) << text;
}

TEST(FinishBlocks, WantsADensity) {
  Assembly assembly = assembly_of({block_of({unit_cube()})});
  assembly.materials[0].density = 0.0;
  EXPECT_THROW(finish_blocks(assembly), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
