// Edges and corners that meet: a normal of the pair, not of one of the two.
#include "geometry/shortest_link.h"

#include <gtest/gtest.h>

#include "tests/geometry/shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;
using Kind = Meeting::Kind;

constexpr double k_shrink = 0.005;  // m
const double k_degree = k_pi / 180.0;

/// A beam along y whose section has a right angle at the origin; it lies on the side of −x, turned about y by `angle`
/// from where its edge points at +x.
Polyhedron beam(double angle, double from = 0.0, double to = 1.0) {
  const Polyhedron square = make_box({0, from, 0}, {1, to, 1});
  return placed(square, turn(Vec3::UnitY(), angle - k_pi * 0.75), Vec3::Zero());
}
Polyhedron mirrored_x(const Polyhedron& shape) {
  Polyhedron out = shape;
  for (Vec3& p : out.vertices) p.x() = -p.x();
  for (auto& face : out.faces) std::reverse(face.begin(), face.end());
  return out;
}

Vec3 normal_of(const Polyhedron& a, const Polyhedron& b, double shrink = k_shrink) {
  const auto m = sharp_meeting(make_convex(a), make_convex(b), 0.01, shrink);
  return m ? m->normal : Vec3::Zero();
}

TEST(ShortestLink, OfMirroredEdgesIsTheAxisOfSymmetry) {
  for (const double lean : {0.0, 10.0, 30.0, 44.0})
    for (const double gap : {-2e-3, 0.0, 2e-3}) {
      const Polyhedron left = beam(lean * k_degree);
      const Polyhedron right = placed(mirrored_x(left), Mat3::Identity(), {gap, 0, 0});
      const auto m = sharp_meeting(make_convex(left), make_convex(right), 0.01, k_shrink);
      ASSERT_TRUE(m);
      EXPECT_LT((m->normal - Vec3::UnitX()).norm(), 1e-12) << lean << " " << gap;
      EXPECT_NEAR(m->separation, gap, 1e-12);
      ASSERT_EQ(m->on_a.size(), 2u) << "a line carries a moment";
      EXPECT_NEAR((m->on_a[1] - m->on_a[0]).norm(), 1.0, 1e-12);
    }
}

/// Right angles whose free angles are g and 180° − g: the directions that part them span an arc of the smaller of both,
/// and the normal is its middle, up to where the arc has shrunk to the normal of faces that lie flat on each other.
TEST(ShortestLink, OfEdgesIsTheMiddleOfWhatPartsThem) {
  const Polyhedron a = beam(0.0);
  Vec3 before = Vec3::UnitX();
  for (double turned = 0.0; turned <= 90.0; turned += 1.0) {
    const Polyhedron b = placed(beam(0.0), turn(Vec3::UnitY(), k_pi + turned * k_degree), Vec3::Zero());
    const Vec3 n = normal_of(a, b);
    const Vec3 middle = turn(Vec3::UnitY(), 0.5 * turned * k_degree) * Vec3::UnitX();
    EXPECT_LT((n - middle).norm(), 1e-9) << turned;
    EXPECT_LT((n - before).norm(), k_degree) << "no jump as it turns";
    before = n;
  }
}

TEST(ShortestLink, OfCrossingEdgesIsNormalToBoth) {
  const Polyhedron lower = make_prism({{-1, -0.5, -0.5}, {-1, 0, 0}, {-1, 0.5, -0.5}}, {2, 0, 0});
  const Polyhedron upper = make_prism({{-0.5, -1, 0.5}, {0, -1, 0}, {0.5, -1, 0.5}}, {0, 2, 0});
  for (const double angle : {0.0, 0.3, 1.2}) {
    const Polyhedron b = placed(upper, turn(Vec3::UnitZ(), angle), {0.3, -0.1, -1e-3});
    const auto m = sharp_meeting(make_convex(lower), make_convex(b), 0.01, k_shrink);
    ASSERT_TRUE(m);
    EXPECT_LT((m->normal - Vec3::UnitZ()).norm(), 1e-10);
    EXPECT_NEAR(m->separation, -1e-3, 1e-12);
    ASSERT_EQ(m->on_a.size(), 1u);
    EXPECT_LT((m->on_b[0] - m->on_a[0] - Vec3(0, 0, -1e-3)).norm(), 1e-10);
  }
}

/// As an edge slides over the other's the normal turns from face to face without a jump.
TEST(ShortestLink, TurnsSteadilyAsAnEdgeSlidesOverAnother) {
  const Polyhedron a = beam(0.0);
  const double step = 0.01 * k_shrink;
  Vec3 before = Vec3::Zero();
  double least = 1.0, most = -1.0;
  for (int i = -800; i <= 800; ++i) {
    const Polyhedron b = placed(mirrored_x(beam(0.0)), Mat3::Identity(), {0.2 * k_shrink, 0, i * step});
    const Vec3 n = normal_of(a, b);
    ASSERT_NEAR(n.norm(), 1.0, 1e-12) << i;
    if (before.norm() > 0.5) {
      EXPECT_LT((n - before).norm(), 2.0 * step / k_shrink) << i;
    }
    before = n;
    least = std::min(least, n.z()), most = std::max(most, n.z());
  }
  EXPECT_NEAR(least, -std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(most, std::sqrt(0.5), 1e-9);
}

Polyhedron any_wedge(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const Vec3 way(number(random), number(random), number(random));
  return cut(make_box({-0.6, -0.4, -0.3}, {0.5, 0.3, 0.6}), {way.normalized(), 0.3});
}

/// Swapped, renumbered, mirrored, split into more faces and corners: the same normal, where the cells are near.
TEST(ShortestLink, DoesNotDependOnHowThePairIsDescribed) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto any = [&] { return Vec3(number(random), number(random), number(random)); };
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const Polyhedron a = placed(any_wedge(random), turn(any(), 3.0 * number(random)), {10, 20, 30});
    Polyhedron b = placed(any_wedge(random), turn(any(), 3.0 * number(random)), {10, 20, 30});
    const Vec3 way = any().normalized();
    for (int k = 0; k < 1000 && separation(make_convex(a), make_convex(b), 1.0) < -2e-3; ++k)
      for (Vec3& p : b.vertices) p += 2e-3 * way;
    const auto link = shortest_link(make_convex(a), make_convex(b), k_shrink);
    if (!link) continue;
    ++compared;
    const auto back = shortest_link(make_convex(b), make_convex(a), k_shrink);
    ASSERT_TRUE(back);
    EXPECT_LT((back->normal + link->normal).norm(), 1e-9);
    const auto numbered = shortest_link(make_convex(renumbered(a, 5)), make_convex(renumbered(b, 6)), k_shrink);
    ASSERT_TRUE(numbered);
    EXPECT_LT((numbered->normal - link->normal).norm(), 1e-9);
    const auto mirror = shortest_link(make_convex(mirrored_x(a)), make_convex(mirrored_x(b)), k_shrink);
    ASSERT_TRUE(mirror);
    EXPECT_LT((Vec3(-mirror->normal.x(), mirror->normal.y(), mirror->normal.z()) - link->normal).norm(), 1e-9);
    Polyhedron split = a;  // the first face in two, and a corner within one of its edges
    const auto loop = split.faces.front();
    const Vec3 middle = 0.5 * (split.vertices[std::size_t(loop[0])] + split.vertices[std::size_t(loop[1])]);
    const int fresh = int(split.vertices.size());
    split.vertices.push_back(middle);
    for (std::size_t f = 1; f < split.faces.size(); ++f) {
      auto& face = split.faces[f];
      for (std::size_t k = 0; k < face.size(); ++k)
        if (face[k] == loop[1] && face[(k + 1) % face.size()] == loop[0]) {
          face.insert(face.begin() + std::ptrdiff_t(k) + 1, fresh);
          break;
        }
    }
    split.faces.front() = {loop[0], fresh, loop.back()};
    std::vector<int> rest(loop.begin() + 1, loop.end());
    rest.insert(rest.begin(), fresh);
    split.faces.push_back(rest);
    const auto other = shortest_link(make_convex(split), make_convex(b), k_shrink);
    ASSERT_TRUE(other);
    EXPECT_LT((other->normal - link->normal).norm(), 1e-9);
  }
  EXPECT_GT(compared, 150);
}

/// Two boxes like an open book on its spine: each face says something else, the pair half-way between.
TEST(ShortestLink, GivesFacesThatOpenAtAnEdgeTheirCommonPlane) {
  for (const double open : {0.01, 0.2, 0.6}) {
    const Polyhedron left = placed(make_box({-1, 0, 0}, {0, 1, 1}), turn(Vec3::UnitY(), -0.5 * open), Vec3::Zero());
    const Polyhedron right = mirrored_x(left);
    const Convex a = make_convex(left), b = make_convex(right);
    const Meeting m = meeting(a, b, 0.01);
    ASSERT_EQ(m.kind, Kind::face);
    ASSERT_GT(m.area, 0.5);
    ASSERT_TRUE(opens_at_an_edge(a, b, m, 3.0 * k_shrink));
    const Meeting common = on_common_plane(a, b, m, k_shrink);
    EXPECT_LT((common.normal - Vec3::UnitX()).norm(), 1e-12);
    EXPECT_NEAR(common.area, std::cos(0.5 * open), 1e-9);
    for (std::size_t i = 0; i < common.on_a.size(); ++i)
      EXPECT_LT((common.on_b[i] - common.on_a[i]).cross(Vec3::UnitX()).norm(), 1e-12);
  }
  // Flat on each other, or an edge well within a face: no matter of edges.
  const Convex floor = make_convex(make_box({-2, -2, -1}, {2, 2, 0}));
  const Polyhedron box = make_box({0, 0, 0}, {1, 1, 1});
  for (const double tilt : {0.0, 0.3}) {
    const Convex b = make_convex(placed(box, turn(Vec3::UnitY(), -tilt), Vec3::Zero()));
    EXPECT_FALSE(opens_at_an_edge(floor, b, meeting(floor, b, 0.01), 3.0 * k_shrink));
  }
}

/// Corners move to where their faces meet once these have moved inwards; corners within an edge go with it.
TEST(ShrunkVertices, LieOnTheMovedFaces) {
  const Polyhedron wedge = cut(unit_cube(), {Vec3(1, 2, 3).normalized(), 1.2});
  const Convex shape = make_convex(wedge);
  const std::vector<Vec3> shrunk = shrunk_vertices(shape, 0.01);
  for (std::size_t f = 0; f < shape.faces.size(); ++f)
    for (const int v : shape.faces[f])
      EXPECT_NEAR(shape.planes[f].normal.dot(shrunk[std::size_t(v)]), shape.planes[f].offset - 0.01, 1e-9);
}

TEST(ShortestLink, FacesInOnePlaneLieFlushUnlessOnOneSide) {
  const Convex a = make_convex(make_box({0, 0, 0}, {1, 1, 1}));
  const auto flush = [&](const Polyhedron& b) { return lie_flush(a, make_convex(b), 1e-6); };
  EXPECT_TRUE(flush(make_box({1, 0, 1}, {2, 1, 2}))) << "edge on edge";
  EXPECT_TRUE(flush(make_box({1, 1, 1}, {2, 2, 2}))) << "corner on corner";
  EXPECT_FALSE(flush(make_box({1.001, 0, 1.001}, {2, 1, 2}))) << "apart";
  EXPECT_FALSE(flush(make_box({1.001, 0, 0}, {2, 1, 1}))) << "their tops are in one plane, but on the same side";
  EXPECT_FALSE(flush(placed(make_box({1, 0, 1}, {2, 1, 2}), turn(Vec3::UnitY(), 0.01), {0, 0, 0})));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
