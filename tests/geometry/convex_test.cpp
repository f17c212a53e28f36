#include "geometry/convex.h"

#include <gtest/gtest.h>

#include "tests/geometry/shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;
using Kind = Meeting::Kind;

Convex box(const Vec3& low, const Vec3& high) {
  return make_convex(make_box(low, high));
}

Convex placed_convex(const Polyhedron& shape, const Mat3& rotation, const Vec3& shift) {
  return make_convex(placed(shape, rotation, shift));
}

/// What must hold of any meeting: unit normal from a to b, points paired along it, the patch counter-clockwise.
void expect_sound(const Meeting& m) {
  EXPECT_NEAR(m.normal.norm(), 1.0, 1e-12);
  ASSERT_EQ(m.on_a.size(), m.on_b.size());
  EXPECT_TRUE(m.kind != Kind::apart || m.on_a.empty());
  if (m.kind != Kind::face || m.on_a.empty()) return;
  EXPECT_GE(m.face_a, 0);
  EXPECT_GE(m.face_b, 0);
  ASSERT_GE(m.on_a.size(), 3u);
  for (std::size_t i = 0; i < m.on_a.size(); ++i) {
    const Vec3 d = m.on_b[i] - m.on_a[i];
    EXPECT_LT((d - d.dot(m.normal) * m.normal).norm(), 1e-9);
    EXPECT_GE(d.dot(m.normal), m.separation - 1e-9);
  }
  Polygon flat = m.on_a;
  for (Vec3& p : flat) p -= m.normal.dot(p) * m.normal;
  EXPECT_GT(polygon_normal(flat).dot(m.normal), 0.999);
  EXPECT_NEAR(polygon_area(flat), m.area, 1e-9);
}

Vec3 middle(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return points.empty() ? sum : Vec3(sum / static_cast<double>(points.size()));
}

/// The meeting of b with a is that of a with b seen from the other side, and numbering changes nothing.
void expect_symmetric(const Polyhedron& a, const Polyhedron& b, double within) {
  const Meeting m = meeting(make_convex(a), make_convex(b), within);
  const Meeting back = meeting(make_convex(b), make_convex(a), within);
  expect_sound(m);
  expect_sound(back);
  EXPECT_EQ(m.kind, back.kind);
  EXPECT_NEAR(m.separation, back.separation, 1e-9);
  EXPECT_LT((m.normal + back.normal).norm(), 1e-9);
  EXPECT_NEAR(m.area, back.area, 1e-9);
  for (unsigned seed = 1; seed < 8; ++seed) {
    const Meeting other = meeting(make_convex(renumbered(a, seed)), make_convex(renumbered(b, seed + 100)), within);
    EXPECT_EQ(other.kind, m.kind);
    EXPECT_NEAR(other.separation, m.separation, 1e-12);
    EXPECT_LT((other.normal - m.normal).norm(), 1e-12);
    EXPECT_NEAR(other.area, m.area, 1e-12);
    ASSERT_EQ(other.on_a.size(), m.on_a.size());
    EXPECT_LT((middle(other.on_a) - middle(m.on_a)).norm(), 1e-9);
    EXPECT_LT((middle(other.on_b) - middle(m.on_b)).norm(), 1e-9);
  }
}

TEST(MakeConvex, ListsEdgesAndDirectionsOnce) {
  const Convex cube = make_convex(unit_cube());
  EXPECT_EQ(cube.edges.size(), 12u);
  EXPECT_EQ(cube.directions.size(), 3u);
  EXPECT_EQ(cube.planes.size(), 6u);
  EXPECT_LT((cube.centre - Vec3::Constant(0.5)).norm(), 1e-15);
}

TEST(Moved, IsTheShapeMadeInItsNewPlace) {
  const Polyhedron shape = cut(unit_cube(), {Vec3(1, 2, 3).normalized(), 1.1});
  const Mat3 r = turn({1, -1, 2}, 0.7);
  const Vec3 pivot(0.3, 0.4, 0.5), shift(50, -3, 8);
  const Convex moved_one = moved(make_convex(shape), r, pivot, shift);
  const Convex made = make_convex(placed(shape, r, pivot + shift - r * pivot));
  for (std::size_t v = 0; v < made.vertices.size(); ++v)
    EXPECT_LT((moved_one.vertices[v] - made.vertices[v]).norm(), 1e-12);
  for (std::size_t f = 0; f < made.planes.size(); ++f) {
    EXPECT_LT((moved_one.planes[f].normal - made.planes[f].normal).norm(), 1e-12);
    EXPECT_NEAR(moved_one.planes[f].offset, made.planes[f].offset, 1e-12);
  }
  EXPECT_LT((moved_one.centre - made.centre).norm(), 1e-12);
  for (std::size_t d = 0; d < made.directions.size(); ++d)
    EXPECT_LT((moved_one.directions[d] - made.directions[d]).norm(), 1e-12);
}

TEST(Meeting, OfABoxOnABoxTurnedAndOffset) {
  const Convex lower = box({-1, -1, -1}, {1, 1, 0});
  const Polyhedron small = make_box({-0.5, -0.5, 0}, {0.5, 0.5, 1});
  for (double height : {-0.01, 0.0, 0.01}) {
    const Meeting m = meeting(lower, placed_convex(small, turn(Vec3::UnitZ(), k_pi / 6), {0.1, 0.2, height}), 0.02);
    expect_sound(m);
    EXPECT_EQ(m.kind, Kind::face);
    EXPECT_NEAR(m.separation, height, 1e-14);
    EXPECT_LT((m.normal - Vec3::UnitZ()).norm(), 1e-14);
    EXPECT_NEAR(m.area, 1.0, 1e-13);
    ASSERT_EQ(m.on_a.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(m.on_a[i].z(), 0.0, 1e-14);
      EXPECT_NEAR(m.on_b[i].z(), height, 1e-14);
    }
  }
}

TEST(Meeting, AreaOfPartCoverIsExact) {
  // Equal squares turned by 45 degrees share an octagon; shifted ones a rectangle.
  const Convex lower = box({-1, -1, -1}, {1, 1, 0});
  const Polyhedron upper = make_box({-1, -1, 0}, {1, 1, 1});
  const Meeting octagon = meeting(lower, placed_convex(upper, turn(Vec3::UnitZ(), k_pi / 4), Vec3::Zero()), 0.01);
  expect_sound(octagon);
  EXPECT_EQ(octagon.on_a.size(), 8u);
  EXPECT_NEAR(octagon.area, 8.0 * std::tan(k_pi / 8), 1e-13);
  const Meeting rectangle = meeting(lower, placed_convex(upper, Mat3::Identity(), {1.5, -0.7, 0}), 0.01);
  EXPECT_NEAR(rectangle.area, 0.5 * 1.3, 1e-14);
}

TEST(Meeting, OfATiltedBoxHasPointsOnBothFaces) {
  const double tilt = 0.01;
  const Convex lower = box({-1, -1, -1}, {1, 1, 0});
  const Meeting m =
      meeting(lower, placed_convex(make_box({0, -0.5, 0}, {1, 0.5, 1}), turn(Vec3::UnitY(), -tilt), {-0.5, 0, 0}), 0.1);
  expect_sound(m);
  EXPECT_EQ(m.kind, Kind::face);
  EXPECT_NEAR(m.separation, 0.0, 1e-12);
  EXPECT_NEAR(m.area, std::cos(tilt), 1e-12);
  for (std::size_t i = 0; i < m.on_a.size(); ++i) {
    EXPECT_NEAR(m.on_a[i].z(), 0.0, 1e-12);
    EXPECT_NEAR(m.on_b[i].z(), (m.on_b[i].x() + 0.5) * std::tan(tilt), 1e-12);
  }
}

TEST(Meeting, OfACornerOnAFace) {
  // A cube on its corner: the patch is one of its faces seen from above, its lowest corner the tip.
  const Polyhedron cube =
      placed(make_box({0, 0, 0}, {1, 1, 1}), turn({1, -1, 0}, std::acos(1.0 / std::sqrt(3.0))), {0.2, 0.3, -0.004});
  const Meeting m = meeting(box({-3, -3, -1}, {3, 3, 0}), make_convex(cube), 0.01);
  expect_sound(m);
  EXPECT_EQ(m.kind, Kind::face);
  EXPECT_NEAR(m.separation, -0.004, 1e-12);
  EXPECT_LT((m.normal - Vec3::UnitZ()).norm(), 1e-12);
  double lowest = 1e9;
  Vec3 tip = Vec3::Zero();
  for (const Vec3& p : m.on_b)
    if (p.z() < lowest) lowest = p.z(), tip = p;
  EXPECT_LT((tip - Vec3(0.2, 0.3, -0.004)).norm(), 1e-9);
  EXPECT_NEAR(m.area, 1.0 / std::sqrt(3.0), 1e-12);
}

TEST(Meeting, OfAnEdgeOnAFaceHoldsTheWholeEdge) {
  const Polyhedron roof = placed(make_box({0, -0.5, 0}, {1, 0.5, 1}), turn(Vec3::UnitY(), -k_pi / 6), {0.1, 0, -0.002});
  const Meeting m = meeting(box({-3, -3, -1}, {3, 3, 0}), make_convex(roof), 0.01);
  expect_sound(m);
  EXPECT_EQ(m.kind, Kind::face);
  EXPECT_NEAR(m.separation, -0.002, 1e-12);
  std::vector<double> y;
  for (const Vec3& p : m.on_b)
    if (p.z() < -0.001) y.push_back(p.y());
  ASSERT_EQ(y.size(), 2u);
  EXPECT_NEAR(std::abs(y[0] - y[1]), 1.0, 1e-12);
  EXPECT_NEAR(m.area, std::cos(k_pi / 6), 1e-12);
}

/// Two roofs whose ridges cross at a right angle at (x, y), `gap` apart; the lower ridge is at z = 0 along x.
std::pair<Polyhedron, Polyhedron> crossing_ridges(double x, double y, double gap) {
  const Polyhedron lower = make_prism({{-1, -0.5, -0.5}, {-1, 0, 0}, {-1, 0.5, -0.5}}, {2, 0, 0});
  const Polyhedron upper = make_prism({{-0.5, -1, 0.5}, {0, -1, 0}, {0.5, -1, 0.5}}, {0, 2, 0});
  return {lower, placed(upper, Mat3::Identity(), {x, y, gap})};
}

TEST(Meeting, OfCrossingEdgesIsTheirNearestPoints) {
  for (double gap : {0.004, -0.004}) {
    const auto [lower, upper] = crossing_ridges(0.3, -0.2, gap);
    ASSERT_GT(mass_properties(lower).volume, 0.0);
    ASSERT_GT(mass_properties(upper).volume, 0.0);
    const Meeting m = meeting(make_convex(lower), make_convex(upper), 0.01);
    expect_sound(m);
    ASSERT_EQ(m.kind, Kind::edge);
    EXPECT_NEAR(m.separation, gap, 1e-14);
    EXPECT_LT((m.normal - Vec3::UnitZ()).norm(), 1e-14);
    ASSERT_EQ(m.on_a.size(), 1u);
    EXPECT_LT((m.on_a[0] - Vec3(0.3, 0, 0)).norm(), 1e-13);
    EXPECT_LT((m.on_b[0] - Vec3(0.3, 0, gap)).norm(), 1e-13);
    EXPECT_EQ(m.area, 0.0);
    expect_symmetric(lower, upper, 0.01);
  }
}

TEST(Meeting, IsApartBeyondTheDistance) {
  const Convex a = make_convex(unit_cube());
  const Meeting m = meeting(a, box({0.2, 0.1, 1.05}, {1, 1, 2}), 0.04);
  EXPECT_EQ(m.kind, Kind::apart);
  EXPECT_NEAR(m.separation, 0.05, 1e-14);
  EXPECT_TRUE(m.on_a.empty());
  EXPECT_EQ(meeting(a, box({0.2, 0.1, 1.05}, {1, 1, 2}), 0.06).kind, Kind::face);
  // Apart by a diagonal that only a cross product of edges tells.
  const auto [lower, upper] = crossing_ridges(0, 0, 0.03);
  EXPECT_EQ(meeting(make_convex(lower), make_convex(upper), 0.02).kind, Kind::apart);
}

TEST(Meeting, BesideEachOthersFacesHasNoPoints) {
  // Diagonal neighbours of a wall touch along an edge only.
  const Meeting m = meeting(make_convex(unit_cube()), box({1.001, 0, 1.0005}, {2, 1, 2}), 0.01);
  EXPECT_EQ(m.kind, Kind::face);
  EXPECT_EQ(m.area, 0.0);
  EXPECT_TRUE(m.on_a.empty());
  EXPECT_NEAR(m.separation, 0.001, 1e-14);
}

TEST(Meeting, OfASteepTipIsOnePoint) {
  // A needle: all faces at its tip stand steeper than the patch rule allows.
  Polyhedron needle{{{0.2, 0.1, -0.001}, {0.15, 0.05, 2}, {0.25, 0.05, 2}, {0.2, 0.15, 2}},
                    {{1, 2, 3}, {0, 2, 1}, {0, 3, 2}, {0, 1, 3}}};
  ASSERT_GT(mass_properties(needle).volume, 0.0);
  const Convex ground = box({-1, -1, -1}, {1, 1, 0});
  const Meeting m = meeting(ground, make_convex(needle), 0.01);
  expect_sound(m);
  EXPECT_EQ(m.kind, Kind::edge);
  EXPECT_NEAR(m.separation, -0.001, 1e-14);
  ASSERT_EQ(m.on_a.size(), 1u);
  EXPECT_LT((m.on_a[0] - Vec3(0.2, 0.1, 0)).norm(), 1e-12);
  EXPECT_LT((m.on_b[0] - Vec3(0.2, 0.1, -0.001)).norm(), 1e-12);
}

TEST(Meeting, TakesTheFaceThatHoldsTheDeepestCorner) {
  // A keel that slopes by 4 degrees: its low end is cut by a face 30 degrees from level, its high end by one only 8
  // degrees from level, which does not reach the corner that touches.
  const double degree = k_pi / 180.0;
  Polyhedron keel = make_box({-1, -1, -1}, {1, 1, 1});
  for (double side : {-1.0, 1.0})
    keel = cut(keel, {Vec3(side * std::sin(60 * degree), 0, -std::cos(60 * degree)), 0.0});
  const Vec3 low(0, std::sin(34 * degree), -std::cos(34 * degree)),
      high(0, -std::sin(4 * degree), -std::cos(4 * degree));
  keel = cut(keel, {low, low.dot(Vec3(0, 0.3, 0))});
  keel = cut(keel, {high, high.dot(Vec3(0, -0.3, 0))});
  const Polyhedron sloping = placed(keel, turn(Vec3::UnitX(), -4 * degree), {0, 0, 0.3 * std::sin(4 * degree) - 1e-3});
  const Meeting m = meeting(box({-3, -3, -3}, {3, 3, 0}), make_convex(sloping), 0.01);
  expect_sound(m);
  EXPECT_EQ(m.kind, Kind::face);
  EXPECT_NEAR(m.separation, -1e-3, 1e-12);
  double deepest = 1.0;
  for (const Vec3& p : m.on_b) deepest = std::min(deepest, p.z());
  EXPECT_NEAR(deepest, -1e-3, 1e-9);
}

TEST(Meeting, BreaksTiesWithoutLookingAtNumbers) {
  const Polyhedron cube = make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  // On its edge at 45 degrees: two faces look down alike.
  const Polyhedron on_edge = placed(cube, turn(Vec3::UnitY(), k_pi / 4), {0, 0, std::sqrt(0.5) - 1e-3});
  expect_symmetric(make_box({-3, -3, -1}, {3, 3, 0}), on_edge, 0.01);
  // Overlapping by the same amount in x and z; then with the centres farther apart in z.
  expect_symmetric(cube, placed(cube, Mat3::Identity(), {0.99, 0.1, 0.99}), 0.01);
  const Polyhedron tall = make_box({0.49, -0.4, 0.49}, {1.49, 0.6, 2.49});
  expect_symmetric(cube, tall, 0.01);
  EXPECT_LT((meeting(make_convex(cube), make_convex(tall), 0.01).normal - Vec3::UnitZ()).norm(), 1e-12);
}

TEST(Meeting, OfVoussoirsTouchesOnTheirRadialPlane) {
  const auto wedge = [](double from, double to) {
    const auto at = [](double r, double angle) { return Vec3(r * std::cos(angle), 0.0, r * std::sin(angle)); };
    return make_prism({at(5, from), at(5.6, from), at(5.6, to), at(5, to)}, {0, 0.5, 0});
  };
  Polyhedron a = wedge(1.0, 1.1), b = wedge(1.1, 1.2);
  ASSERT_GT(mass_properties(a).volume, 0.0);
  const Meeting m = meeting(make_convex(a), make_convex(b), 1e-3);
  expect_sound(m);
  EXPECT_EQ(m.kind, Kind::face);
  EXPECT_NEAR(m.separation, 0.0, 1e-12);
  EXPECT_NEAR(m.area, 0.6 * 0.5, 1e-12);
  EXPECT_LT((m.normal - Vec3(-std::sin(1.1), 0, std::cos(1.1))).norm(), 1e-12);
  expect_symmetric(a, b, 1e-3);
}

TEST(Meeting, IsSymmetricAndFreeOfNumbering) {
  const Polyhedron cube = make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const Polyhedron wedge = cut(make_box({-0.6, -0.4, -0.3}, {0.5, 0.3, 0.6}), {Vec3(1, 2, 2).normalized(), 0.3});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto any = [&] { return Vec3(number(random), number(random), number(random)); };
  int faces = 0, edges = 0;
  for (int i = 0; i < 200; ++i) {
    const Polyhedron a = placed(i % 2 ? cube : wedge, turn(any(), 3.0 * number(random)), {10, 20, 30});
    Polyhedron b = placed(wedge, turn(any(), 3.0 * number(random)), Vec3(10, 20, 30));
    // Push b away until it nearly touches.
    const Vec3 way = any().normalized();
    for (int step = 0; step < 60; ++step) {
      const double s = separation(make_convex(a), make_convex(b), 1.0);
      if (s > -0.01) break;
      for (Vec3& p : b.vertices) p += 0.5 * std::max(-s, 0.01) * way;
    }
    const Meeting m = meeting(make_convex(a), make_convex(b), 0.1);
    faces += m.kind == Kind::face;
    edges += m.kind == Kind::edge;
    expect_symmetric(a, b, 0.1);
  }
  EXPECT_GT(faces, 50);
  EXPECT_GT(edges, 20);
}

TEST(Separation, IsTheLeastPushThatPartsTheBodies) {
  const Convex cube = make_convex(unit_cube());
  EXPECT_NEAR(separation(cube, box({0.2, 0.3, 0.9}, {0.7, 0.8, 3}), 1.0), -0.1, 1e-14);
  EXPECT_NEAR(separation(cube, box({0.2, 0.3, 1.25}, {0.7, 0.8, 3}), 1.0), 0.25, 1e-14);
  EXPECT_GT(separation(cube, box({1.5, 0.3, 9}, {1.7, 0.8, 10}), 0.1), 0.1);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
