#include "geometry/polyhedron.h"

#include <gtest/gtest.h>

#include "tests/geometry/shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

double relative(const Mat3& found, const Mat3& expected) {
  return (found - expected).norm() / expected.norm();
}

Mat3 box_inertia(double mass, const Vec3& size) {
  const Vec3 s = size.cwiseProduct(size);
  return (mass / 12.0 * Vec3(s.y() + s.z(), s.z() + s.x(), s.x() + s.y())).asDiagonal();
}

TEST(MassProperties, OfABoxFarFromTheOrigin) {
  const Vec3 low(1000.0, -2000.0, 500.0), size(0.6, 0.5, 0.45);
  const MassProperties m = mass_properties(make_box(low, low + size));
  const double volume = 0.6 * 0.5 * 0.45;
  EXPECT_NEAR(m.volume, volume, 1e-12);  // the corners themselves are rounded to 1e-13
  EXPECT_LT((m.centroid - (low + 0.5 * size)).norm(), 1e-12);
  EXPECT_LT(relative(m.inertia, box_inertia(volume, size)), 4e-12);
}

TEST(MassProperties, OfTheUnitTetrahedron) {
  const MassProperties m = mass_properties(tetrahedron(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()));
  EXPECT_NEAR(m.volume, 1.0 / 6.0, 1e-15);
  EXPECT_LT((m.centroid - Vec3::Constant(0.25)).norm(), 1e-15);
  // About the origin: ∫x² = 1/60, ∫xy = 1/120; moved to the centroid.
  const double square = 1.0 / 60.0 - 1.0 / 96.0, mixed = 1.0 / 120.0 - 1.0 / 96.0;
  Mat3 expected = Mat3::Constant(-mixed);
  expected.diagonal().setConstant(2.0 * square);
  EXPECT_LT(relative(m.inertia, expected), 1e-13);
}

TEST(MassProperties, OfAWedgePrism) {
  // A right triangle with legs b along x and h along z, 2l long in y.
  const double b = 1.2, h = 0.7, l = 0.4;
  const Polyhedron wedge = make_prism({{0, -l, 0}, {b, -l, 0}, {0, -l, h}}, {0, 2 * l, 0});
  const MassProperties m = mass_properties(wedge);
  const double volume = b * h * l;
  EXPECT_NEAR(m.volume, volume, 1e-15);
  EXPECT_LT((m.centroid - Vec3(b / 3, 0, h / 3)).norm(), 1e-15);
  const double xx = volume * b * b / 18, zz = volume * h * h / 18, yy = volume * l * l / 3, xz = -volume * b * h / 36;
  Mat3 expected;
  expected << yy + zz, 0, -xz, 0, xx + zz, 0, -xz, 0, xx + yy;
  EXPECT_LT(relative(m.inertia, expected), 1e-12);
}

TEST(MassProperties, OfAnLMadeOfTwoCells) {
  // 2 x 1 x 1 foot and 1 x 1 x 1 post at its left end.
  const std::vector<Polyhedron> cells = {make_box({0, 0, 0}, {2, 1, 1}), make_box({0, 0, 1}, {1, 1, 2})};
  const MassProperties m = mass_properties(cells);
  EXPECT_NEAR(m.volume, 3.0, 1e-14);
  const Vec3 centroid((2 * 1.0 + 0.5) / 3, 0.5, (2 * 0.5 + 1.5) / 3);
  EXPECT_LT((m.centroid - centroid).norm(), 1e-15);
  Mat3 expected = box_inertia(2.0, {2, 1, 1}) + box_inertia(1.0, {1, 1, 1});
  for (const auto& [mass, at] : {std::pair(2.0, Vec3(1, 0.5, 0.5)), std::pair(1.0, Vec3(0.5, 0.5, 1.5))}) {
    const Vec3 d = at - centroid;
    expected += mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  }
  EXPECT_LT(relative(m.inertia, expected), 1e-13);
  // The same L as one surface with a non-convex face.
  const Polyhedron one = make_prism({{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, {1, 0, 2}, {0, 0, 2}}, {0, 1, 0});
  const MassProperties whole = mass_properties(one);
  EXPECT_NEAR(whole.volume, 3.0, 1e-14);
  EXPECT_LT((whole.centroid - centroid).norm(), 1e-14);
  EXPECT_LT(relative(whole.inertia, expected), 1e-12);
}

TEST(MassProperties, TurnAndMoveWithTheBody) {
  const Polyhedron shape = cut(make_box({-0.3, -0.2, -0.5}, {0.4, 0.35, 0.6}), {Vec3(1, 2, 3).normalized(), 0.4});
  const MassProperties here = mass_properties(shape);
  const Mat3 r = turn({1, -2, 0.5}, 0.8);
  const Vec3 shift(60.0, -7.0, 13.0);
  const MassProperties there = mass_properties(placed(shape, r, shift));
  EXPECT_NEAR(there.volume / here.volume, 1.0, 1e-12);
  EXPECT_LT((there.centroid - (r * here.centroid + shift)).norm(), 1e-13);
  EXPECT_LT(relative(there.inertia, r * here.inertia * r.transpose()), 1e-12);
}

TEST(MassProperties, AreNegativeForAnInsideOutBody) {
  Polyhedron cube = unit_cube();
  for (auto& face : cube.faces) std::reverse(face.begin(), face.end());
  EXPECT_NEAR(mass_properties(cube).volume, -1.0, 1e-15);
  EXPECT_EQ(mass_properties(Polyhedron{}).volume, 0.0);
}

TEST(Polygon, HasNormalAreaAndCentroid) {
  const Mat3 r = turn({1, 1, 0}, 0.6);
  const Vec3 shift(40, -3, 9);
  Polygon triangle = {{0, 0, 0}, {3, 0, 0}, {0, 1.5, 0}};
  for (Vec3& p : triangle) p = r * p + shift;
  EXPECT_NEAR(polygon_area(triangle), 2.25, 1e-13);
  EXPECT_LT((polygon_normal(triangle) - r * Vec3::UnitZ()).norm(), 1e-14);
  EXPECT_LT((polygon_centroid(triangle) - (r * Vec3(1.0, 0.5, 0.0) + shift)).norm(), 1e-13);
  // Corners crowded on one side do not draw the area centroid there.
  EXPECT_LT(
      (polygon_centroid({{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}) - Vec3(1, 1, 0)).norm(),
      1e-14);
}

TEST(Polyhedron, BoxFacesLookOutwards) {
  const Polyhedron box = make_box({0, 0, 0}, {1, 2, 3});
  EXPECT_NEAR(surface_area(box), 22.0, 1e-14);
  for (int f = 0; f < 6; ++f) {
    const Plane plane = face_plane(box, f);
    EXPECT_GT(plane.normal.dot(polygon_centroid(face_polygon(box, f)) - Vec3(0.5, 1, 1.5)), 0.4);
    for (const Vec3& p : box.vertices) EXPECT_LE(plane.normal.dot(p), plane.offset + 1e-15);
  }
}

TEST(CutPolyhedron, HalvesABoxAlongItsDiagonal) {
  const Polyhedron half = cut(unit_cube(), {Vec3(1, 0, 1).normalized(), std::sqrt(0.5)});
  EXPECT_NEAR(mass_properties(half).volume, 0.5, 1e-15);
  EXPECT_EQ(half.vertices.size(), 6u);
  EXPECT_EQ(half.faces.size(), 5u);
  EXPECT_NEAR(surface_area(half), 3.0 + std::sqrt(2.0), 1e-14);
}

TEST(CutPolyhedron, TruncatesACorner) {
  const Polyhedron left = cut(unit_cube(), {Vec3(1, 1, 1).normalized(), 2.5 / std::sqrt(3.0)});
  EXPECT_NEAR(mass_properties(left).volume, 1.0 - 0.125 / 6.0, 1e-15);
  EXPECT_EQ(left.faces.size(), 7u);
  EXPECT_EQ(left.vertices.size(), 10u);
  // Exactly through three corners: the corner goes, no crossings are made.
  const Polyhedron most = cut(unit_cube(), {Vec3(1, 1, 1).normalized(), 2.0 / std::sqrt(3.0)});
  EXPECT_NEAR(mass_properties(most).volume, 5.0 / 6.0, 1e-15);
  EXPECT_EQ(most.vertices.size(), 7u);
  EXPECT_EQ(most.faces.size(), 7u);
}

TEST(CutPolyhedron, LeavesNoSliverAlongAnExistingFace) {
  const Polyhedron cube = unit_cube();
  for (double offset : {1.0, 1.0 + 5e-10, 1.0 - 5e-10}) {
    const Polyhedron same = cut(cube, {Vec3::UnitZ(), offset});
    EXPECT_EQ(same.faces.size(), 6u);
    EXPECT_NEAR(mass_properties(same).volume, 1.0, 1e-15);
    EXPECT_TRUE(cut(cube, {-Vec3::UnitZ(), -offset}).faces.empty());
  }
  EXPECT_TRUE(cut(cube, {Vec3::UnitX(), -1.0}).faces.empty());
}

TEST(CutPolyhedron, ByManyPlanesFillsTheBoxAgain) {
  // Both sides of each of many planes: the pieces' volumes add up and each piece is closed.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<Polyhedron> pieces = {make_box({-1, -1, -1}, {1, 1, 1})};
  for (int i = 0; i < 8; ++i) {
    const Vec3 n = Vec3(number(random), number(random), number(random)).normalized();
    const Plane plane{n, 0.5 * number(random)}, other{-n, -plane.offset};
    std::vector<Polyhedron> next;
    for (const Polyhedron& piece : pieces)
      for (const Polyhedron& part : {cut(piece, plane), cut(piece, other)})
        if (!part.faces.empty()) next.push_back(part);
    pieces = next;
  }
  EXPECT_GT(pieces.size(), 40u);
  double volume = 0.0;
  for (const Polyhedron& piece : pieces) {
    const double v = mass_properties(piece).volume;
    EXPECT_GT(v, 0.0);
    volume += v;
    Vec3 closure = Vec3::Zero();
    std::size_t corners = 0;
    for (std::size_t f = 0; f < piece.faces.size(); ++f) {
      const Polygon polygon = face_polygon(piece, static_cast<int>(f));
      closure += polygon_area(polygon) * polygon_normal(polygon);
      corners += polygon.size();
    }
    EXPECT_LT(closure.norm(), 1e-12);
    EXPECT_EQ(piece.vertices.size() + piece.faces.size(), corners / 2 + 2);  // Euler: no T-junctions, no gaps
  }
  EXPECT_NEAR(volume, 8.0, 1e-12);
}

TEST(CutPolyhedron, KeepsWholeThroughRepeatedCutsAtOnePlane) {
  // A barrel cut by 40 tangent planes meeting in shared edges, each cut made twice.
  Polyhedron barrel = make_box({-2, 0, -2}, {2, 1, 2});
  const int sides = 40;
  for (int i = 0; i < 2 * sides; ++i) {
    const double angle = 2.0 * k_pi * i / sides;
    barrel = cut(barrel, {Vec3(std::cos(angle), 0.0, std::sin(angle)), 1.0});
  }
  EXPECT_NEAR(mass_properties(barrel).volume, sides * std::tan(k_pi / sides), 1e-12);
  EXPECT_EQ(barrel.faces.size(), sides + 2u);
  EXPECT_EQ(barrel.vertices.size(), 2u * sides);
}

TEST(CutPolygon, ClipsAndEmpties) {
  const Polygon square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_NEAR(polygon_area(cut(square, {Vec3(1, 1, 0).normalized(), std::sqrt(0.5)})), 0.5, 1e-15);
  EXPECT_TRUE(cut(square, {Vec3::UnitX(), 0.0}).empty());
  EXPECT_EQ(cut(square, {Vec3::UnitX(), 1.0}).size(), 4u);
}

TEST(Intersect, OfTwoSquaresTurnedByAnEighth) {
  const Polygon square = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  Polygon turned = square;
  for (Vec3& p : turned) p = turn(Vec3::UnitZ(), k_pi / 4) * p;
  const Polygon octagon = intersect(square, turned, Vec3::UnitZ());
  EXPECT_EQ(octagon.size(), 8u);
  EXPECT_NEAR(polygon_area(octagon), 8.0 * std::tan(k_pi / 8), 1e-14);
  EXPECT_GT(polygon_normal(octagon).z(), 0.999);
  for (Vec3& p : turned) p.x() += 5.0;
  EXPECT_TRUE(intersect(square, turned, Vec3::UnitZ()).empty());
}

TEST(Cleaned, DropsRepeatedAndStraightCorners) {
  const Polygon square = {{0, 0, 0}, {0, 0, 0},     {0.5, 0, 0}, {1, 0, 0},
                          {1, 1, 0}, {1, 1, 5e-10}, {0, 1, 0},   {0, 0, 4e-10}};
  const Polygon clean = cleaned(square);
  EXPECT_EQ(clean.size(), 4u);
  EXPECT_NEAR(polygon_area(clean), 1.0, 1e-9);
  EXPECT_TRUE(cleaned({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1e-12, 0}}).empty());
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
