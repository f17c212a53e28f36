// Shapes that are not convex, cut into convex pieces by CGAL. Without it at the build the tests say so.
#include "geometry/decompose.h"

#include <gtest/gtest.h>

#include "geometry/joints.h"
#include "geometry/repair.h"
#include "solver/base/error.h"
#include "tests/geometry/shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

bool without_cgal(const std::string& message) {
  return message.find("libcgal-dev") != std::string::npos;
}

/// Cuts, checks the pieces, and returns how many there are; 0 when the program was built without CGAL.
std::size_t cut_and_check(const Polyhedron& shape, double tolerance = 1e-12) {
  std::vector<Polyhedron> pieces;
  try {
    pieces = decompose(shape);
  } catch (const InputError& error) {
    EXPECT_TRUE(without_cgal(error.what())) << error.what();
    return 0;
  }
  double sum = 0.0;
  Vec3 moment = Vec3::Zero();
  for (const Polyhedron& piece : pieces) {
    EXPECT_EQ(convexity_error(piece), "");
    const MassProperties own = mass_properties(piece);
    sum += own.volume;
    moment += own.volume * own.centroid;
  }
  const MassProperties whole = mass_properties(shape);
  EXPECT_NEAR(sum, whole.volume, tolerance * whole.volume);
  EXPECT_LT((moment / sum - whole.centroid).norm(), 1e-6);
  // None lies in another: as blocks of their own they do not overlap.
  std::vector<Block> blocks;
  for (const Polyhedron& piece : pieces) blocks.push_back(block_of({piece}));
  EXPECT_TRUE(find_overlaps(assembly_of(blocks), 1e-7).empty());
  return pieces.size();
}

#define SKIP_WITHOUT_CGAL(count) \
  if (count == 0) GTEST_SKIP() << "built without CGAL (libcgal-dev)"

Polyhedron prism(const Polygon& outline) {
  return make_prism(outline, {0, 0.5, 0});
}

TEST(Decompose, ACorbelIsTwoPieces) {
  const Polyhedron corbel = prism({{0, 0, 0}, {0.5, 0, 0}, {0.5, 0, 1.2}, {1.2, 0, 1.2}, {1.2, 0, 1.5}, {0, 0, 1.5}});
  const std::size_t count = cut_and_check(corbel);
  SKIP_WITHOUT_CGAL(count);
  EXPECT_EQ(count, 2u);
}

/// Turned, no face of the drawing is plane to the last bit, and none may be cut for that.
TEST(Decompose, HoweverItIsTurned) {
  const Polyhedron corbel = prism({{0, 0, 0}, {0.5, 0, 0}, {0.5, 0, 1.2}, {1.2, 0, 1.2}, {1.2, 0, 1.5}, {0, 0, 1.5}});
  for (int k = 1; k < 6; ++k) {
    const std::size_t count =
        cut_and_check(placed(corbel, turn({1.0, 0.3 * k, 2.0}, 0.4 * k), {30.0 * k, -5, 6}), 1e-9);
    SKIP_WITHOUT_CGAL(count);
    EXPECT_EQ(count, 2u) << k;
  }
}

TEST(Decompose, DovetailStepsAndACross) {
  // A dovetail: narrow neck, wide head.
  std::size_t count = cut_and_check(
      prism({{0, 0, 0}, {3, 0, 0}, {3, 0, 1}, {2, 0, 1}, {2.5, 0, 2}, {0.5, 0, 2}, {1, 0, 1}, {0, 0, 1}}));
  SKIP_WITHOUT_CGAL(count);
  EXPECT_EQ(count, 2u);
  // Three steps.
  count =
      cut_and_check(prism({{0, 0, 0}, {3, 0, 0}, {3, 0, 1}, {2, 0, 1}, {2, 0, 2}, {1, 0, 2}, {1, 0, 3}, {0, 0, 3}}));
  EXPECT_EQ(count, 3u);
  // A cross.
  count = cut_and_check(prism({{1, 0, 0},
                               {2, 0, 0},
                               {2, 0, 1},
                               {3, 0, 1},
                               {3, 0, 2},
                               {2, 0, 2},
                               {2, 0, 3},
                               {1, 0, 3},
                               {1, 0, 2},
                               {0, 0, 2},
                               {0, 0, 1},
                               {1, 0, 1}}));
  EXPECT_EQ(count, 3u);
}

/// A voussoir whose intrados follows the arc: each of its edges is one that turns in.
TEST(Decompose, AVoussoirWithACurvedIntrados) {
  Polygon outline;
  for (int k = 0; k <= 6; ++k) outline.emplace_back(3.0 * std::sin(0.1 * k), 0.0, 3.0 * std::cos(0.1 * k));
  for (const double angle : {0.6, 0.0}) outline.emplace_back(4.0 * std::sin(angle), 0.0, 4.0 * std::cos(angle));
  std::reverse(outline.begin(), outline.end());
  Polyhedron stone = prism(outline);
  if (mass_properties(stone).volume < 0.0)
    for (auto& loop : stone.faces) std::reverse(loop.begin(), loop.end());
  const std::size_t count = cut_and_check(stone, 1e-9);
  SKIP_WITHOUT_CGAL(count);
  EXPECT_LE(count, 6u);
  EXPECT_GE(count, 3u);
}

TEST(Decompose, AConvexShapeStaysOne) {
  const std::size_t count = cut_and_check(placed(unit_cube(), turn({1, 2, 3}, 0.5), {3, 4, 5}), 1e-9);
  SKIP_WITHOUT_CGAL(count);
  EXPECT_EQ(count, 1u);
}

TEST(Decompose, AnOpenSurfaceIsAnError) {
  Polyhedron open = unit_cube();
  open.faces.pop_back();
  try {
    decompose(open);
    FAIL() << "an open surface was cut";
  } catch (const InputError& error) {
    EXPECT_TRUE(without_cgal(error.what()) || std::string(error.what()).find("not closed") != std::string::npos)
        << error.what();
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
