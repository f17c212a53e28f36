#include "geometry/masonry.h"

#include <algorithm>
#include <cmath>

#include "solver/base/error.h"

namespace voussoir {

namespace {

Polyhedron sweep_across(Polygon polygon, double y0, double y1) {
  for (Vec3& p : polygon) p.y() = y0;
  return make_prism(polygon, Vec3(0.0, y1 - y0, 0.0));
}

/// Length over which two convex polygons of one plane share an edge.
double shared_edge(const Polygon& a, const Polygon& b) {
  double shared = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 &p = a[i], &q = a[(i + 1) % a.size()];
    const double length = (q - p).norm();
    if (length < no_masonry) continue;
    const Vec3 t = (q - p) / length;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vec3 u = b[j] - p, v = b[(j + 1) % b.size()] - p;
      const double off = std::max((u - t.dot(u) * t).norm(), (v - t.dot(v) * t).norm());
      if (off > 1e-6) continue;
      shared +=
          std::max(0.0, std::min(length, std::max(t.dot(u), t.dot(v))) - std::max(0.0, std::min(t.dot(u), t.dot(v))));
    }
  }
  return shared;
}

/// Sorts polygons into groups that hang together through shared edges.
std::vector<std::vector<Polygon>> connected_groups(std::vector<Polygon> polygons) {
  std::vector<std::vector<Polygon>> groups;
  while (!polygons.empty()) {
    std::vector<Polygon> group = {polygons.front()};
    polygons.erase(polygons.begin());
    for (std::size_t i = 0; i < group.size(); ++i) {
      for (std::size_t j = 0; j < polygons.size();) {
        if (shared_edge(group[i], polygons[j]) > 1e-4) {
          group.push_back(polygons[j]);
          polygons.erase(polygons.begin() + std::ptrdiff_t(j));
        } else {
          ++j;
        }
      }
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

/// Lays one box of a course, cut by the limits of the section.
void lay_box(Layout& layout, const Vec3& low, const Vec3& high, const Unit& unit, const Vec3& nominal) {
  const Polygon whole = rectangle(low.x(), high.x(), low.z(), high.z());
  const bool was_cut = reach(layout.limits, whole);
  for (const auto& group : connected_groups(within(whole, layout.limits))) {
    std::vector<Polyhedron> solids;
    for (const Polygon& cell : group) solids.push_back(sweep_across(cell, low.y(), high.y()));
    lay_stone(layout, std::move(solids), unit, nominal, was_cut);
  }
}

}  // namespace

void check_stones(double stones) {
  constexpr double most = 2e6;  // they take some kilobytes each before there is a model of them
  if (!(stones <= most))
    throw InputError(
        "[bridge] gives {:.3g} blocks; at most {:g} are allowed. Make the blocks larger (block_scale, or the sizes of "
        "the blocks), or the structure smaller.",
        stones, most);
}

std::vector<double> split(double from, double to, double size, bool half) {
  const int n = std::max(1, int(std::lround((to - from) / size)));
  const double step = (to - from) / n;
  std::vector<double> at = {from};
  if (half && n > 1) {
    for (int i = 0; i < n; ++i) at.push_back(from + (i + 0.5) * step);
  } else {
    for (int i = 1; i < n; ++i) at.push_back(from + i * step);
  }
  at.push_back(to);
  return at;
}

void lay_across(Layout& layout, const std::vector<Polygon>& polygons, const std::vector<double>& y, const Unit& unit,
                const Vec3& nominal) {
  for (std::size_t j = 0; j + 1 < y.size(); ++j) {
    std::vector<Polyhedron> cells;
    for (const Polygon& polygon : polygons) cells.push_back(sweep_across(polygon, y[j], y[j + 1]));
    lay_stone(layout, std::move(cells), unit, nominal, false);
  }
}

std::vector<std::int64_t> lay_ring(Layout& layout, const Ring& ring, double y0, double y1, const Unit& unit, int bond) {
  std::vector<std::int64_t> first;
  for (std::size_t i = 0; i + 1 < ring.intrados.size(); ++i) {
    first.push_back(std::int64_t(layout.stones.size()));
    lay_across(layout, {ring.wedge(int(i))}, split(y0, y1, unit.size.y(), (i + std::size_t(bond)) % 2 == 1), unit,
               unit.size);
  }
  first.push_back(std::int64_t(layout.stones.size()));
  return first;
}

void lay_courses(Layout& layout, const Vec3& low, const Vec3& high, const Unit& unit, int first) {
  if ((high - low).minCoeff() <= 0.0) return;
  const std::vector<double> z = split(low.z(), high.z(), unit.size.z());
  const Vec3 counts = ((high - low).cwiseQuotient(unit.size)).array().round().max(1.0);
  check_stones(double(layout.stones.size()) + counts.prod());
  const Vec3 nominal = (high - low).cwiseQuotient(counts);
  for (std::size_t k = 0; k + 1 < z.size(); ++k) {
    const std::vector<double> y = split(low.y(), high.y(), unit.size.y());
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      const bool half = unit.bonded && (j + k + std::size_t(first)) % 2 == 1;
      const std::vector<double> x = split(low.x(), high.x(), unit.size.x(), half);
      for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        lay_box(layout, {x[i], y[j], z[k]}, {x[i + 1], y[j + 1], z[k + 1]}, unit, nominal);
      }
    }
  }
}

void lay_stone(Layout& layout, std::vector<Polyhedron> cells, const Unit& unit, const Vec3& nominal, bool was_cut) {
  check_stones(double(layout.stones.size()) + 1.0);
  Stone stone;
  stone.cells = std::move(cells);
  stone.component = unit.component;
  stone.part = unit.part;
  stone.material = unit.material;
  stone.fixed = unit.component == Component::base || unit.component == Component::restraint;
  stone.was_cut = was_cut;
  stone.nominal = nominal;
  layout.stones.push_back(std::move(stone));
}

}  // namespace voussoir
