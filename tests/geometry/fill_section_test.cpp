// The section of a fill: nodes of equal triangles, and edges that are shortened to a bound.
#include "geometry/fill_section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace voussoir {
namespace VOUSSOIR_FILE {

std::vector<Side> outline(const std::vector<Vec3>& corners) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < corners.size(); ++i) sides.push_back({corners[i], corners[(i + 1) % corners.size()]});
  return sides;
}

double area_of(const FillSection& section, std::size_t t) {
  const auto& n = section.triangles[t].nodes;
  const Vec3 &a = section.nodes[std::size_t(n[0])], &b = section.nodes[std::size_t(n[1])],
             &c = section.nodes[std::size_t(n[2])];
  return 0.5 * ((b - a).cross(c - a)).y();
}
double area_of(const FillSection& section) {
  double sum = 0.0;
  for (std::size_t t = 0; t < section.triangles.size(); ++t) sum += area_of(section, t);
  return sum;
}

/// A rectangle in cells of two triangles with all diagonals one way; the right half reaches farther across if `parts`.
FillSection cells(int nx, int nz, double dx, double dz, bool parts = false) {
  FillSection section;
  for (int k = 0; k <= nz; ++k)
    for (int i = 0; i <= nx; ++i) section.nodes.emplace_back(i * dx, 0.0, k * dz);
  for (std::int32_t k = 0; k < nz; ++k)
    for (std::int32_t i = 0; i < nx; ++i) {
      const std::int32_t a = k * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
      const double half = parts && 2 * i >= nx ? 2.0 : 1.0;
      section.triangles.push_back({{a, d, b}, -half, half});
      section.triangles.push_back({{a, c, d}, -half, half});
    }
  return section;
}

/// Every inner edge has two triangles, and those lie on its two sides.
void expect_sound(const FillSection& section) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (std::size_t t = 0; t < section.triangles.size(); ++t) {
    EXPECT_GT(area_of(section, t), 0.0);
    const auto& n = section.triangles[t].nodes;
    for (std::size_t i = 0; i < 3; ++i) ++edges[{n[i], n[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) EXPECT_EQ(count, 1);  // each way at most once
}

TEST(FillSection, LatticeHasEqualTriangles) {
  const double edge = 0.5;
  const auto sides = outline({{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}});
  const std::vector<Vec3> points = lattice_inside(sides, edge);
  ASSERT_GT(points.size(), 30u);
  for (const Vec3& p : points) {
    EXPECT_GE(std::min({p.x(), 4.0 - p.x(), p.z(), 3.0 - p.z()}), 0.45 * edge);
    double nearest = 1e300;
    for (const Vec3& q : points)
      if (&p != &q) nearest = std::min(nearest, (p - q).norm());
    EXPECT_NEAR(nearest, edge, 1e-12);
  }
}

TEST(FillSection, LatticeDividesTheTopEvenlyAndKeepsOutOfHoles) {
  auto sides = outline({{0, 0, 0}, {3, 0, 0}, {3, 0, 3}, {0, 0, 3}});
  for (const Side& side : outline({{1, 0, 1}, {2, 0, 1}, {2, 0, 2}, {1, 0, 2}})) sides.push_back(side);
  const std::vector<Vec3> points = lattice_inside(sides, 0.4);  // eight along the top, 0.375 m each
  ASSERT_FALSE(points.empty());
  for (const Vec3& p : points) {
    EXPECT_NEAR(std::remainder(p.x(), 0.5 * 0.375), 0.0, 1e-12);
    EXPECT_FALSE(std::abs(p.x() - 1.5) < 0.5 && std::abs(p.z() - 1.5) < 0.5);
  }
}

TEST(FillSection, NoLatticeWithoutALevelTop) {
  EXPECT_TRUE(lattice_inside(outline({{0, 0, 0}, {4, 0, 1}, {2, 0, 4}}), 0.3).empty());
}

TEST(FillSection, LongDiagonalsAreShortened) {
  FillSection section = cells(10, 8, 1.0, 1.0);
  const std::size_t before = section.triangles.size();
  ASSERT_NEAR(longest_edge(section), std::sqrt(2.0), 1e-12);
  shorten_edges(section, 1.2);
  EXPECT_LE(longest_edge(section), 1.2);
  expect_sound(section);
  EXPECT_NEAR(area_of(section), 80.0, 1e-9);
  EXPECT_LT(section.triangles.size(), 2 * before);  // halving every diagonal would make twice as many
}

TEST(FillSection, OutlineAndBordersBetweenPartsStay) {
  FillSection section = cells(8, 6, 1.0, 1.0, true);
  const FillSection before = section;
  shorten_edges(section, 1.15);
  expect_sound(section);
  double left = 0.0;
  for (std::size_t t = 0; t < section.triangles.size(); ++t)
    if (section.triangles[t].y1 == 1.0) left += area_of(section, t);
  EXPECT_NEAR(left, 24.0, 1e-9);
  for (std::size_t i = 0; i < before.nodes.size(); ++i) {
    const Vec3& p = before.nodes[i];
    const bool rim = p.x() == 0.0 || p.x() == 4.0 || p.x() == 8.0 || p.z() == 0.0 || p.z() == 6.0;
    if (rim) {
      EXPECT_EQ(section.nodes[i], p);
    }
  }
}

TEST(FillSection, ABoundBelowTheOutlinesEdgesIsNotReached) {
  FillSection section = cells(2, 2, 1.0, 1.0);
  shorten_edges(section, 0.8);
  expect_sound(section);
  EXPECT_NEAR(longest_edge(section), 1.0, 1e-12);  // the outline's
}

TEST(FillSection, WhatIsShortEnoughKeepsItsTriangles) {
  FillSection section = cells(4, 3, 1.0, 1.0);
  shorten_edges(section, 2.0);
  EXPECT_EQ(section.triangles.size(), 24u);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
