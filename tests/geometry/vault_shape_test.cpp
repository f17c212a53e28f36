// Shapes of vaults against the curves they are named after, and what they leave of what is laid around them against an
// integral of its own.
#include "geometry/vault_shape.h"

#include <gtest/gtest.h>

#include <random>

#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// A parabola, as measured at both ends of so many parts.
Polygon survey(double span, double rise, int parts) {
  Polygon points;
  for (int i = 0; i <= parts; ++i) {
    const double x = span * (double(i) / parts - 0.5);
    points.emplace_back(1.0 + 0.5 * span + x, 0.0, 3.0 + rise * (1.0 - 4.0 * x * x / (span * span)));
  }
  return points;
}

VaultShape vault(const std::string& shape, double span, double rise, int voussoirs = 24) {
  VaultShape v;
  v.shape = shape;
  v.left = {1.0, 0.0, 3.0}, v.right = {1.0 + span, 0.0, 3.0};
  v.rise = rise;
  v.crown = v.springing = {0.5};
  v.voussoirs = voussoirs;
  if (shape == "surveyed") v.surveyed = survey(span, rise, 8);
  return v;
}

/// About the middle of the springing line.
Vec3 flat(const VaultShape& v, const Vec3& p) {
  return p - 0.5 * (v.left + v.right);
}

double rise_of(const std::string& shape) {
  return shape == "semicircular" ? 4.0 : shape == "pointed" ? 5.0 : 2.4;
}

TEST(VaultShape, LiesOnItsCurve) {
  const double a = 4.0;
  for (const std::string& shape : vault_shapes()) {
    const double b = rise_of(shape);
    const VaultShape v = vault(shape, 2.0 * a, b);
    const Ring ring = vault_rings(v, "span 1").at(0);
    for (const Vec3& point : ring.intrados) {
      const Vec3 p = flat(v, point);
      double off = 0.0;
      if (shape == "semicircular") off = p.norm() - a;
      if (shape == "segmental")
        off = std::hypot(p.x(), p.z() - b + (a * a + b * b) / (2 * b)) - (a * a + b * b) / (2 * b);
      if (shape == "elliptical") off = std::hypot(p.x() / a, p.z() / b) - 1.0;
      if (shape == "parabolic") off = p.z() - b * (1.0 - p.x() * p.x() / (a * a));
      if (shape == "pointed")
        off = std::hypot(std::abs(p.x()) - a + (a * a + b * b) / (2 * a), p.z()) - (a * a + b * b) / (2 * a);
      EXPECT_NEAR(off, 0.0, 1e-5) << shape << " at " << p.transpose();
    }
    EXPECT_LT((ring.intrados.front() - v.left).norm(), 1e-12) << shape;
    EXPECT_LT((ring.intrados.back() - v.right).norm(), 1e-12) << shape;
    EXPECT_NEAR(ring.intrados[12].z() - 3.0, b, 1e-6) << shape;
  }
}

/// Millimetres for nine points on a span of eight metres, and better with more.
TEST(VaultShape, FollowsASurvey) {
  double worst[2] = {0.0, 0.0};
  for (const int more : {0, 1}) {
    VaultShape v = vault("surveyed", 8.0, 2.4);
    v.surveyed = survey(8.0, 2.4, more ? 16 : 8);
    const Ring ring = vault_rings(v, "").at(0);
    for (const Vec3& point : ring.intrados) {
      const Vec3 p = flat(v, point);
      worst[more] = std::max(worst[more], std::abs(p.z() - 2.4 * (1.0 - p.x() * p.x() / 16.0)));
    }
  }
  EXPECT_LT(worst[0], 6e-3);
  EXPECT_LT(worst[1], 0.3 * worst[0]);
}

/// Upright at the springings, level at the crown, and round where its arcs meet: the middles of three facets side by
/// side turn evenly.
TEST(VaultShape, ThreeCentresMakeOneLine) {
  const VaultShape v = vault("three-centred", 10.0, 3.5, 400);
  const Ring ring = vault_rings(v, "").at(0);
  const auto direction = [&](std::size_t i) {
    const Vec3 t = ring.intrados[i + 1] - ring.intrados[i];
    return std::atan2(t.z(), t.x());
  };
  EXPECT_NEAR(direction(0), 0.5 * pi, 0.02);
  EXPECT_NEAR(direction(199), 0.0, 0.01);
  const double haunch = 2.8095, crown = 6.6293, length = intrados_length(v) / 400.0;
  for (std::size_t i = 0; i + 2 < 400; ++i) {
    const double turn = direction(i) - direction(i + 1);
    EXPECT_GT(turn, 0.99 * length / crown) << i;
    EXPECT_LT(turn, 1.01 * length / haunch) << i;
  }
  EXPECT_NEAR(ring.intrados[200].z() - 3.0, 3.5, 1e-9);
}

TEST(VaultShape, LengthsAreThoseOfTheCurves) {
  EXPECT_NEAR(intrados_length(vault("semicircular", 8.0, 4.0)), pi * 4.0, 1e-5);
  const double r = (16.0 + 4.0) / 4.0;  // of rise 2
  EXPECT_NEAR(intrados_length(vault("segmental", 8.0, 2.0)), 2.0 * r * std::asin(4.0 / r), 1e-5);
  const double h = 2.0, parabola = 0.5 * std::sqrt(64.0 + 16.0 * h * h) + 64.0 / (8.0 * h) * std::asinh(4.0 * h / 8.0);
  EXPECT_NEAR(intrados_length(vault("parabolic", 8.0, h)), parabola, 1e-5);
  // Ramanujan's second formula, exact to 1e-9 here.
  const double a = 4.0, b = 2.4, q = (a - b) * (a - b) / ((a + b) * (a + b));
  EXPECT_NEAR(intrados_length(vault("elliptical", 8.0, b)),
              0.5 * pi * (a + b) * (1.0 + 3.0 * q / (10.0 + std::sqrt(4.0 - 3.0 * q))), 1e-5);
}

TEST(VaultShape, RingsLieOnOneAnotherFacetByFacet) {
  for (const std::string& shape : vault_shapes()) {
    VaultShape v = vault(shape, 8.0, rise_of(shape));
    v.crown = {0.22, 0.22, 0.3}, v.springing = {0.22, 0.3, 0.4};
    const std::vector<Ring> rings = vault_rings(v, "");
    ASSERT_EQ(rings.size(), 3u);
    for (std::size_t k = 0; k + 1 < rings.size(); ++k) EXPECT_EQ(rings[k].extrados, rings[k + 1].intrados) << shape;
    for (std::size_t i = 0; i < rings[0].intrados.size(); ++i) {  // one straight joint through all
      const Vec3 first = rings[0].extrados[i] - rings[0].intrados[i], all = rings[2].extrados[i] - rings[0].intrados[i];
      EXPECT_LT(first.cross(all).norm(), 1e-9) << shape;
    }
    EXPECT_NEAR((rings[2].extrados[0] - rings[0].intrados[0]).norm(), 0.92, 1e-9) << shape;
    if (shape != "pointed") {
      EXPECT_NEAR(rings[2].extrados[12].z() - rings[0].intrados[12].z(), 0.74, 1e-9) << shape;
    }
  }
  // At the crown the extrados of both sides of a pointed vault meet.
  VaultShape v = vault("pointed", 8.0, 5.0);
  const double radius = 41.0 / 8.0;
  EXPECT_NEAR(vault_rings(v, "").at(0).extrados[12].z() - 3.0,
              std::sqrt((radius + 0.5) * (radius + 0.5) - (radius - 4.0) * (radius - 4.0)), 1e-9);
}

TEST(VaultShape, HalvesMirrorOneAnotherAndShearedOnesReachTheirSpringings) {
  for (const std::string& shape : vault_shapes()) {
    if (shape == "surveyed" || shape == "semicircular") continue;
    VaultShape v = vault(shape, 8.0, rise_of(shape));
    v.left.x() = -4.0, v.right.x() = 4.0;
    const Ring ring = vault_rings(v, "").at(0);
    for (std::size_t i = 0; i < ring.extrados.size(); ++i) {
      const Vec3 &p = ring.extrados[i], &q = ring.extrados[ring.extrados.size() - 1 - i];
      EXPECT_EQ(p.x(), -q.x()) << shape;
      EXPECT_EQ(p.z(), q.z()) << shape;
    }
    v.right.z() += 0.8;
    const Ring sheared = vault_rings(v, "").at(0);
    EXPECT_LT((sheared.intrados.front() - v.left).norm(), 1e-12);
    EXPECT_LT((sheared.intrados.back() - v.right).norm(), 1e-12);
  }
}

/// A sliver under a foot that is level up to rounding would be a stone without volume.
TEST(VaultShape, UprightSpringingsHaveLevelFeet) {
  for (const std::string shape : {"elliptical", "three-centred", "pointed"}) {
    VaultShape v = vault(shape, 39.01, shape == "pointed" ? 21.5 : 7.39, 54);
    v.crown = {1.6}, v.springing = {2.18};
    const Ring ring = vault_rings(v, "span 1").at(0);
    EXPECT_EQ(ring.extrados.front().z(), v.left.z()) << shape;
    EXPECT_EQ(ring.extrados.back().z(), v.right.z()) << shape;
  }
}

TEST(VaultShape, WhatCannotBeNamesBothKeys) {
  const auto refused = [](const std::string& shape, double rise, std::vector<double> crown = {0.5},
                          std::vector<double> springing = {0.5}) {
    VaultShape v = vault(shape, 8.0, rise);
    v.crown = std::move(crown), v.springing = std::move(springing);
    return message_of<InputError>([&] { vault_rings(v, "[[bridge.span]] 2"); });
  };
  for (const auto& [shape, rise] :
       {std::pair("segmental", 4.5), {"three-centred", 4.1}, {"pointed", 3.0}, {"semicircular", 3.0}}) {
    const std::string text = refused(shape, rise);
    for (const char* word : {"[[bridge.span]] 2", "rise = ", "clear_span = 8", "such as rise"})
      EXPECT_NE(text.find(word), std::string::npos) << text;
  }
  EXPECT_NE(refused("segmental", 0.6, {0.2}, {3.0}).find("concave"), std::string::npos);
}

/// Inside the ring or the opening below it, by where a vertical line meets it: for vaults whose joints rise.
bool taken(const Ring& ring, double x, double z) {
  const auto height = [x](const Polygon& line) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      if (line[i].x() <= x && x < line[i + 1].x())
        return line[i].z() + (x - line[i].x()) / (line[i + 1].x() - line[i].x()) * (line[i + 1].z() - line[i].z());
    return -1e9;
  };
  if (z >= height(ring.extrados)) return false;
  if (x > ring.intrados.front().x() && x < ring.intrados.back().x()) return true;
  // Beside the opening: above the springing joint.
  const bool left = x <= ring.intrados.front().x();
  const Vec3 &p = left ? ring.intrados.front() : ring.intrados.back(),
             &q = left ? ring.extrados.front() : ring.extrados.back();
  if (std::abs(q.x() - p.x()) < 1e-12 || (left ? x < q.x() : x > q.x())) return false;
  return z > p.z() + (x - p.x()) / (q.x() - p.x()) * (q.z() - p.z());
}

TEST(SectionLimits, LeaveWhatIsOutsideVaultsSupportsAndDeck) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const std::string& shape : vault_shapes()) {
    const VaultShape v = vault(shape, 8.0, rise_of(shape), 14);
    const Ring ring = whole_vault(vault_rings(v, ""));
    SectionLimits limits;
    limits.rings = {ring};
    limits.taken = {{{-2.0, 0.0, 0.0}, {0.8, 0.0, 3.4}}};
    const Vec3 up = Vec3(0.05, 0.0, 1.0).normalized();
    limits.past = {{up, up.dot(Vec3(0.0, 0.0, 8.0))}};
    for (int box = 0; box < 40; ++box) {
      const double x0 = -2.0 + 12.0 * uniform(random), z0 = 9.0 * uniform(random), w = 0.2 + 3.0 * uniform(random),
                   h = 0.2 + 2.0 * uniform(random);
      const Polygon whole = rectangle(x0, x0 + w, z0, z0 + h);
      double area = 0.0;
      for (const Polygon& piece : within(whole, limits)) area += polygon_area(piece);
      constexpr int n = 300;
      int free = 0;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const Vec3 p(x0 + (i + 0.5) / n * w, 0.0, z0 + (j + 0.5) / n * h);
          const bool support = p.x() > -2.0 && p.x() < 0.8 && p.z() < 3.4;
          free += !support && !taken(ring, p.x(), p.z()) && up.dot(p) < limits.past[0].offset;
        }
      EXPECT_NEAR(area, w * h * free / (n * n), 0.012 * w * h) << shape << " box " << box;
      if (!reach(limits, whole)) {
        EXPECT_NEAR(area, w * h, 1e-9);
      }
    }
  }
}

/// The radius of a semicircle, (a² + a²)/(2 a), may be rounded to less than a.
TEST(VaultShape, OfASemicircleHasItsLengthWhateverTheSpan) {
  for (int cm = 100; cm <= 2000; ++cm)
    for (const char* shape : {"segmental", "pointed"}) {
      const double span = 0.01 * cm, length = intrados_length(vault(shape, span, 0.5 * span));
      ASSERT_NEAR(length, 0.5 * pi * span, 1e-6 * span) << shape << " of " << span;
    }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
