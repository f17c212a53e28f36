#include "geometry/joints.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "geometry/neighbours.h"
#include "solver/base/error.h"
#include "tests/geometry/shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

/// Corners go once around `normal`, within the joint's own plane.
void expect_sound(const Joint& joint) {
  EXPECT_GE(joint.polygon.size(), 3u);
  EXPECT_GT(polygon_normal(joint.polygon).dot(joint.normal), 1.0 - 1e-9);
  EXPECT_NEAR(polygon_area(joint.polygon), joint.area, 1e-12);
  EXPECT_NEAR(joint.normal.norm(), 1.0, 1e-14);
}

/// All pairs, each looked at.
std::vector<std::pair<int, int>> all_neighbours(const std::vector<Box>& boxes, double distance) {
  std::vector<std::pair<int, int>> pairs;
  const auto near = [&](const Box& a, const Box& b) { return ((b.low - a.high).array() <= distance).all(); };
  for (int i = 0; i < int(boxes.size()); ++i)
    for (int j = i + 1; j < int(boxes.size()); ++j)
      if (near(boxes[i], boxes[j]) && near(boxes[j], boxes[i])) pairs.emplace_back(i, j);
  return pairs;
}

/// Small boxes, some as long as all of them, some flat, in rows whose faces coincide and anywhere.
TEST(Neighbours, AreThoseFoundByLookingAtEveryPair) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Box> boxes;
  for (int i = 0; i < 600; ++i) {
    const Vec3 place = Vec3(20 * unit(random), 6 * unit(random), 4 * unit(random)), size(unit(random), 0.5, 0.25);
    const Vec3 low = i % 2 ? place : Vec3(0.5 * place.array().floor());
    boxes.push_back({low, low + (i % 50 ? size : Vec3(20.0, i % 100 ? 0.0 : 6.0, 0.5))});
  }
  for (double distance : {0.0, 1e-3, 0.4, -1e-3, -0.3})
    EXPECT_EQ(neighbours(boxes, distance), all_neighbours(boxes, distance)) << distance;
  for (double distance : {0.0, 1e-3, 0.4}) {  // each of them, and one outside, asks the rest
    const BoxIndex index(std::vector<Box>(boxes.begin() + 200, boxes.end()), distance);
    std::vector<std::pair<int, int>> found, expected;
    for (const auto& [i, j] : all_neighbours(boxes, distance))
      if (i < 200 && j >= 200) expected.emplace_back(i, j);
    std::vector<int> near;
    for (int i = 0; i < 200; ++i) {
      index.near(boxes[i], near);
      for (const int j : near) found.emplace_back(i, j + 200);
    }
    EXPECT_EQ(found, expected) << distance;
    index.near({Vec3(-9.0, -9.0, -9.0), Vec3(-8.0, 90.0, 90.0)}, near);
    EXPECT_TRUE(near.empty());
    BoxIndex({}, distance).near(boxes[0], near);
    EXPECT_TRUE(near.empty());
  }
}

TEST(FindJoints, OfTwoStackedBoxesOffset) {
  Assembly assembly =
      assembly_of({block_of({make_box({0.3, 0.4, 1}, {2.3, 2.4, 2})}), block_of({make_box({0, 0, 0}, {1, 1, 1})})});
  const JointReport report = find_joints(assembly);
  ASSERT_EQ(assembly.joints.size(), 1u);
  const Joint& joint = assembly.joints[0];
  expect_sound(joint);
  EXPECT_EQ(joint.a, 0);
  EXPECT_EQ(joint.b, 1);
  EXPECT_LT((joint.normal + Vec3::UnitZ()).norm(), 1e-15);  // from the upper one, a, down to b
  EXPECT_NEAR(joint.area, 0.7 * 0.6, 1e-15);
  EXPECT_EQ(joint.polygon.size(), 4u);
  EXPECT_LT((polygon_centroid(joint.polygon) - Vec3(0.65, 0.7, 1.0)).norm(), 1e-15);
  EXPECT_EQ(report.joints, 1);
  EXPECT_EQ(report.closed_gaps, 0);
  EXPECT_LT(face_plane(assembly.blocks[0].cells[0], joint.face_a).normal.z(), -0.9);
  EXPECT_GT(face_plane(assembly.blocks[1].cells[0], joint.face_b).normal.z(), 0.9);
}

TEST(FindJoints, OfTurnedBoxesFarFromTheOrigin) {
  const Mat3 r = turn({1, 2, 3}, 1.1);
  const Vec3 shift(60, -5, 12);
  const Polyhedron lower = make_box({-1, -1, -1}, {1, 1, 0});
  const Polyhedron upper = placed(make_box({-1, -1, 0}, {1, 1, 1}), turn(Vec3::UnitZ(), k_pi / 4), Vec3::Zero());
  Assembly assembly = assembly_of({block_of({placed(lower, r, shift)}), block_of({placed(upper, r, shift)})});
  find_joints(assembly);
  ASSERT_EQ(assembly.joints.size(), 1u);
  expect_sound(assembly.joints[0]);
  EXPECT_EQ(assembly.joints[0].polygon.size(), 8u);
  EXPECT_NEAR(assembly.joints[0].area, 8.0 * std::tan(k_pi / 8), 1e-11);
  EXPECT_LT((assembly.joints[0].normal - r * Vec3::UnitZ()).norm(), 1e-12);
}

TEST(FindJoints, ClosesSmallGapsAndCountsThem) {
  for (double gap : {8e-5, -8e-5}) {
    Assembly assembly = assembly_of({block_of({unit_cube()}), block_of({make_box({0, 0, 1 + gap}, {1, 1, 2})})});
    const JointReport report = find_joints(assembly);
    ASSERT_EQ(assembly.joints.size(), 1u);
    EXPECT_EQ(report.closed_gaps, 1);
    EXPECT_NEAR(report.largest_closed_gap, 8e-5, 1e-12);
    for (const Vec3& p : assembly.joints[0].polygon) EXPECT_NEAR(p.z(), 1 + 0.5 * gap, 1e-12);
  }
}

TEST(FindJoints, LeavesWiderGapsOpenAndCountsThem) {
  Assembly assembly = assembly_of({block_of({unit_cube()}), block_of({make_box({0, 0, 1.0005}, {1, 1, 2})}),
                                   block_of({make_box({0, 0, 2.1}, {1, 1, 3})})});
  const JointReport report = find_joints(assembly);
  EXPECT_EQ(report.joints, 0);
  EXPECT_EQ(report.open_gaps, 1);
  EXPECT_NEAR(report.smallest_open_gap, 5e-4, 1e-12);
}

TEST(FindJoints, TakesOneJointAPairAndNoneForEdgesAndCorners) {
  // Four cubes in a square: four joints, none across the diagonals.
  Assembly assembly =
      assembly_of({block_of({make_box({0, 0, 0}, {1, 1, 1})}), block_of({make_box({1, 0, 0}, {2, 1, 1})}),
                   block_of({make_box({0, 0, 1}, {1, 1, 2})}), block_of({make_box({1, 0, 1}, {2, 1, 2})})});
  find_joints(assembly);
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  for (const Joint& joint : assembly.joints) pairs.emplace_back(joint.a, joint.b);
  EXPECT_EQ(pairs, (std::vector<std::pair<std::int64_t, std::int64_t>>{{0, 1}, {0, 2}, {1, 3}, {2, 3}}));
}

TEST(FindJoints, HoldsToTheAngle) {
  for (const auto& [angle, joints] : {std::pair(8e-4, 1), std::pair(2e-3, 0)}) {
    const Polyhedron upper =
        placed(make_box({-0.05, -0.05, 0}, {0.05, 0.05, 1}), turn(Vec3::UnitX(), angle), Vec3::Zero());
    Assembly assembly = assembly_of({block_of({make_box({-1, -1, -1}, {1, 1, 0})}), block_of({upper})});
    EXPECT_EQ(find_joints(assembly, {1e-3, 1e-3, 1e-8}).joints, joints);
  }
}

TEST(FindJoints, SkipsPairsOfFixedBlocksAndSiblings) {
  Assembly assembly =
      assembly_of({block_of({make_box({0, 0, 0}, {1, 1, 1}), make_box({1, 0, 0}, {2, 1, 1})}),
                   block_of({make_box({0, 0, 1}, {2, 1, 2})}), block_of({make_box({0, 0, -1}, {2, 1, 0})})});
  assembly.blocks[0].fixed = assembly.blocks[2].fixed = true;
  find_joints(assembly);
  ASSERT_EQ(assembly.joints.size(), 2u);  // one for each cell under block 1
  EXPECT_EQ(assembly.joints[0].cell_a, 0);
  EXPECT_EQ(assembly.joints[1].cell_a, 1);
  EXPECT_EQ(assembly.joints[1].b, 1);
}

TEST(FindJoints, DoesNotDependOnTheNumberingOfVertices) {
  Assembly one = assembly_of({block_of({unit_cube()}), block_of({make_box({0.5, 0.2, 1}, {1.7, 0.9, 2})})});
  find_joints(one);
  for (unsigned seed = 1; seed < 6; ++seed) {
    Assembly other = one;
    for (Block& block : other.blocks) block.cells[0] = renumbered(block.cells[0], seed);
    find_joints(other);
    ASSERT_EQ(other.joints.size(), 1u);
    EXPECT_NEAR(other.joints[0].area, one.joints[0].area, 1e-14);
    EXPECT_LT((polygon_centroid(other.joints[0].polygon) - polygon_centroid(one.joints[0].polygon)).norm(), 1e-14);
  }
}

TEST(FindJoints, NamesTheDeepestOverlap) {
  Assembly assembly =
      assembly_of({block_of({unit_cube()}, Component::arch), block_of({make_box({0, 0, 0.9}, {1, 1, 2})}),
                   block_of({make_box({0.98, 0, 0}, {2, 1, 0.5})}, Component::pier)});
  assembly.blocks[1].part = 3;
  const std::string text = error_of([&] { find_joints(assembly); });
  EXPECT_NE(text.find("block 0 (arch, part 0) and block 1 (block, part 3) overlap by 0.1 m"), std::string::npos)
      << text;
  EXPECT_NE(text.find("1 more"), std::string::npos) << text;
  EXPECT_THROW(find_joints(assembly), InputError);
  const std::vector<Overlap> overlaps = find_overlaps(assembly, 1e-4);
  ASSERT_EQ(overlaps.size(), 2u);
  EXPECT_NEAR(overlaps[0].depth, 0.1, 1e-12);
  EXPECT_EQ(overlaps[1].b, 2);
  EXPECT_NEAR(overlaps[1].depth, 0.02, 1e-12);
  EXPECT_EQ(find_overlaps(assembly, 0.05).size(), 1u);
}

TEST(FindOverlaps, SeesABlockInsideAnotherAndPassesTurnedNeighbours) {
  Assembly inside = assembly_of({block_of({unit_cube()}), block_of({make_box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6})})});
  ASSERT_EQ(find_overlaps(inside, 1e-4).size(), 1u);
  EXPECT_NEAR(find_overlaps(inside, 1e-4)[0].depth, 0.6, 1e-12);
  // Boxes of a roof's two halves meet deeply, the halves only on their plane.
  const Polyhedron cube = unit_cube();
  const Plane plane{Vec3(1, 0, 1).normalized(), std::sqrt(0.5)};
  Assembly halves = assembly_of({block_of({cut(cube, plane)}), block_of({cut(cube, {-plane.normal, -plane.offset})})});
  EXPECT_TRUE(find_overlaps(halves, 1e-6).empty());
  EXPECT_EQ(find_joints(halves).joints, 1);
  EXPECT_NEAR(halves.joints[0].area, std::sqrt(2.0), 1e-14);
}

TEST(FindJoints, RefusesVerticesThatAreNotFinite) {
  Assembly assembly = assembly_of({block_of({unit_cube()}), block_of({make_box({0, 0, 1}, {1, 1, 2})})});
  assembly.blocks[1].cells[0].vertices[0].x() = INFINITY;
  EXPECT_THROW(find_joints(assembly), InputError);
}

double area_of(const std::vector<Polygon>& polygons) {
  double sum = 0.0;
  for (const Polygon& polygon : polygons) sum += polygon_area(polygon);
  return sum;
}

TEST(OuterFaces, OfAnLOfTwoCells) {
  const Block block = block_of({make_box({0, 0, 0}, {2, 1, 1}), make_box({0, 0, 1}, {1, 1, 2})});
  const std::vector<Polygon> faces = outer_faces(block);
  EXPECT_NEAR(area_of(faces), 14.0, 1e-13);
  for (const Polygon& polygon : faces)  // nothing is left of the shared square
    EXPECT_FALSE((polygon_centroid(polygon) - Vec3(0.5, 0.5, 1.0)).norm() < 1e-6);
}

TEST(OuterFaces, OfACellWithASmallSiblingInTheMiddleOfAFace) {
  // The hole in the middle leaves four convex pieces of the top.
  const Block block = block_of({make_box({0, 0, 0}, {3, 3, 1}), make_box({1, 1, 1}, {2, 2, 2})});
  const std::vector<Polygon> faces = outer_faces(block);
  EXPECT_EQ(faces.size(), 5u + 4u + 5u);
  EXPECT_NEAR(area_of(faces), 2 * 9 + 12 + 4, 1e-13);
  for (const Polygon& polygon : faces) EXPECT_GT(polygon_area(polygon), 0.5);
}

TEST(UncoveredSurface, OfAWallInRunningBondIsItsOutside) {
  // Courses shifted by half a block, with the half blocks at the ends; one block of two cells.
  std::vector<Block> blocks;
  for (int course = 0; course < 6; ++course)
    for (double x = course % 2 ? -0.5 : 0.0; x < 5.0; x += 1.0)
      blocks.push_back(
          block_of({make_box({std::max(x, 0.0), 0, 0.4 * course}, {std::min(x + 1.0, 5.0), 0.6, 0.4 * (course + 1)})}));
  Assembly assembly = assembly_of(blocks);
  find_joints(assembly);
  EXPECT_NEAR(uncovered_surface(assembly), 2 * (5 * 2.4 + 0.6 * 2.4 + 5 * 0.6), 1e-10);
  assembly.blocks[0].cells.push_back(assembly.blocks[1].cells[0]);
  assembly.blocks.erase(assembly.blocks.begin() + 1);
  find_joints(assembly);
  EXPECT_NEAR(uncovered_surface(assembly), 2 * (5 * 2.4 + 0.6 * 2.4 + 5 * 0.6), 1e-10);
}

TEST(FindJoints, OfAWholeBridgesWorthOfBlocks) {
  std::vector<Block> blocks;
  const int nx = 60, ny = 12, nz = 28;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        const Vec3 low(0.75 * x + (z % 2) * 0.375, 0.6 * y, 0.45 * z);
        blocks.push_back(block_of({make_box(low, low + Vec3(0.75, 0.6, 0.45))}));
      }
  Assembly assembly = assembly_of(std::move(blocks));
  const auto start = std::chrono::steady_clock::now();
  find_joints(assembly);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  RecordProperty("seconds", std::to_string(took.count()));
  EXPECT_EQ(assembly.joints.size(),
            static_cast<std::size_t>((nx - 1) * ny * nz + nx * (ny - 1) * nz + (2 * nx - 1) * ny * (nz - 1)));
  EXPECT_LT(took.count(), 20.0);  // a search that grows with the square of the count takes minutes
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
