// Columns of nodes over the section of a fill: staggered by thirds of a layer, symmetric, within a bound of the edges.
#include "geometry/fill_columns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/fill_mesh.h"
#include "geometry/fill_sweep.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// Rows of equal triangles with sides of `edge` m, that reach from −half to half.
FillSection equal_triangles(int columns, int rows, double edge, double half) {
  FillSection section;
  for (int k = 0; k <= rows; ++k)
    for (int i = 0; i <= columns; ++i)
      section.nodes.emplace_back(edge * (i + 0.5 * (k % 2)), 0.0, edge * std::sqrt(0.75) * k);
  for (std::int32_t k = 0; k < rows; ++k)
    for (std::int32_t i = 0; i < columns; ++i) {
      const std::int32_t a = k * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      const bool even = k % 2 == 0;
      section.triangles.push_back({{a, even ? c : d, b}, -half, half});
      section.triangles.push_back({{even ? b : a, c, d}, -half, half});
    }
  return section;
}

/// A node with triangles around it, as many as given, which is one colour too many if they are odd.
FillSection fan(int triangles, double spoke, double half) {
  FillSection section;
  section.nodes.push_back(Vec3::Zero());
  for (int i = 0; i < triangles; ++i) {
    const double angle = 2.0 * M_PI * i / triangles;
    section.nodes.emplace_back(spoke * std::cos(angle), 0.0, spoke * std::sin(angle));
    section.triangles.push_back({{0, 1 + i, 1 + (i + 1) % triangles}, -half, half});
  }
  return section;
}

double area_of(const FillSection& section) {
  double sum = 0.0;
  for (const auto& t : section.triangles) {
    const Vec3& a = section.nodes[std::size_t(t.nodes[0])];
    const Vec3 b = section.nodes[std::size_t(t.nodes[1])] - a, c = section.nodes[std::size_t(t.nodes[2])] - a;
    sum += 0.5 * b.cross(c).norm();
  }
  return sum;
}

double smallest_step(const FillColumns& columns) {
  double least = 1e300;
  for (const auto& y : columns)
    for (std::size_t k = 0; k + 1 < y.size(); ++k) least = std::min(least, y[k + 1] - y[k]);
  return least;
}

void expect_sound(const FillSection& section, const FillMesh& mesh, double width) {
  EXPECT_NO_THROW(check_fill(mesh, "the swept section"));
  EXPECT_NEAR(fill_volume(mesh), width * area_of(section), 1e-12 * fill_volume(mesh));
}

// Triangles of √(2/3) L swept in staggered layers of √3/2 L give tetrahedra that fill space (Sommerville 1923), with
// edges of L and √3/2 L and a volume of L³/12 each; three in a level prism hold L³/18 at most.
TEST(FillColumns, StaggeredLayersOfEqualTrianglesAreSommervillesTetrahedra) {
  const double bound = 1.0, layer = 0.5 * std::sqrt(3.0), half = 20.0 * layer;
  EXPECT_NEAR(section_bound({-half, half}, bound, layer), std::sqrt(2.0 / 3.0), 1e-12);
  const FillSection section = equal_triangles(12, 9, std::sqrt(2.0 / 3.0), half);
  const FillMesh mesh = sweep(section, bound, layer);
  expect_sound(section, mesh, 2.0 * half);
  EXPECT_NEAR(fill_quality(mesh).longest_edge, bound, 1e-12);
  const double each = fill_volume(mesh) / double(mesh.tets.size());
  EXPECT_NEAR(each, bound / 12.0, 0.04 / 12.0);  // two columns of three have a step more in each half
}

TEST(FillColumns, NeighboursDifferAndStepsAtEndsAreHalfALayerOrMore) {
  const FillSection section = equal_triangles(6, 5, 0.4, 1.5);
  const FillColumns columns = make_columns(section, 0.5, 0.4);
  for (const auto& triangle : section.triangles) {
    std::set<double> lowest;
    for (const std::int32_t node : triangle.nodes) lowest.insert(columns[std::size_t(node)][1]);
    EXPECT_EQ(lowest.size(), 3u);
  }
  EXPECT_NEAR(smallest_step(columns), 0.5 * 1.5 / 4, 1e-12);
}

TEST(FillColumns, MirrorOneAnotherBitForBit) {
  for (const FillSection& section : {equal_triangles(4, 3, 0.4, 1.7), fan(5, 0.42, 1.7)})
    for (const auto& y : make_columns(section, 0.5, 0.4))
      for (std::size_t k = 0; k < y.size(); ++k) EXPECT_EQ(y[k], 0.0 - y[y.size() - 1 - k]);
}

TEST(FillColumns, ThinStripsStayLevel) {
  const double bound = 0.2, layer = 0.16, half = 0.1;
  EXPECT_NEAR(section_bound({-half, half}, bound, layer), std::sqrt(bound * bound - half * half), 1e-15);
  const FillSection section = equal_triangles(4, 3, 0.17, half);
  for (const auto& y : make_columns(section, bound, layer)) EXPECT_EQ(y, (std::vector<double>{-half, 0.0, half}));
}

TEST(FillColumns, HaveNodesWhereTrianglesAroundThemEndOnly) {
  FillSection section = equal_triangles(2, 4, 0.5, 1.0);
  for (std::size_t t = 0; t < 4; ++t)
    section.triangles[t].y0 = -0.77, section.triangles[t].y1 = 0.77;  // the lowest row
  const FillColumns columns = make_columns(section, 0.7, 0.5);
  for (std::size_t node = 0; node < columns.size(); ++node) {
    const std::vector<double>& y = columns[node];
    const auto has = [&](double at) { return std::find(y.begin(), y.end(), at) != y.end(); };
    EXPECT_EQ(has(0.77) && has(-0.77), node < 6) << node;
    EXPECT_EQ(has(1.0) && has(-1.0), node >= 3) << node;
  }
  double width = 0.0;
  for (const auto& t : section.triangles) width += (t.y1 - t.y0) / double(section.triangles.size());
  expect_sound(section, sweep(section, 0.7, 0.5), width);
}

// Five or seven triangles about a node cannot have three colours: steps are halved where an edge would be too long.
TEST(FillColumns, KeepTheBoundWhereThreeColoursDoNotDo) {
  for (const int triangles : {3, 5, 7}) {
    const double edge = 0.42, spoke = std::min(edge, 0.5 * edge / std::sin(M_PI / triangles));
    const FillSection section = fan(triangles, spoke, 2.0);
    ASSERT_LE(longest_edge(section), edge * (1.0 + 1e-12));
    const FillMesh mesh = sweep(section, 0.5, 0.4);
    expect_sound(section, mesh, 4.0);
    EXPECT_LE(fill_quality(mesh).longest_edge, 0.5 * (1.0 + 1e-9)) << triangles;
  }
}

TEST(FillColumns, WhatNoStepsWouldShortenIsLeft) {
  const FillMesh mesh = sweep(fan(5, 0.6, 2.0), 0.5, 0.4);
  EXPECT_GT(fill_quality(mesh).longest_edge, 0.7);
  EXPECT_LT(mesh.nodes.size(), 6u * 14u);  // 11 or 13 of each column, where nothing is halved
}

TEST(FillColumns, AFillBesideTheMiddleNeedsNone) {
  FillSection section = equal_triangles(3, 2, 0.4, 1.0);
  for (auto& triangle : section.triangles) triangle.y0 = 2.0, triangle.y1 = 3.1;
  for (const auto& y : make_columns(section, 0.5, 0.4)) EXPECT_TRUE(y.front() == 2.0 && y.back() == 3.1);
  expect_sound(section, sweep(section, 0.5, 0.4), 1.1);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
