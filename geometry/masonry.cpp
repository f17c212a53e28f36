#include "geometry/masonry.h"

#include <algorithm>
#include <boost/iterator/counting_iterator.hpp>
#include <cmath>

#include "solver/base/constants.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// Thickness in m below which a piece of a polygon is rounding, not masonry: its neighbours then touch across it.
constexpr double kNothing = 1e-7;

/// Blocks of one layout, which take some kilobytes each before there is a model of them.
constexpr double kMostStones = 2e6;

void check_number(double stones) {
  if (!(stones <= kMostStones))
    throw InputError(
        "[bridge] asks for {:.3g} blocks, expected at most {:g}: make them larger (block_scale, or the sizes of the "
        "blocks), or the structure smaller",
        stones, kMostStones);
}

double perimeter(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) sum += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  return sum;
}

bool is_nothing(const Polygon& polygon) {
  return polygon.size() < 3 || polygon_area(polygon) < kNothing * perimeter(polygon);
}

Polygon rectangle(double x0, double x1, double z0, double z1) {
  return {{x0, 0.0, z0}, {x1, 0.0, z0}, {x1, 0.0, z1}, {x0, 0.0, z1}};
}

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
    if (length < kNothing) continue;
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

/// The half-plane past joint i of a ring, going from left to right.
Plane past_joint(const Ring& ring, int i) {
  const Vec3 along = (ring.extrados[std::size_t(i)] - ring.centre).normalized();
  const Vec3 backward(-along.z(), 0.0, along.x());
  return {backward, backward.dot(ring.centre)};
}

Plane before_joint(const Ring& ring, int i) {
  const Plane past = past_joint(ring, i);
  return {-past.normal, -past.offset};
}

/// The half-plane outside the extrados of wedge i.
Plane above_wedge(const Ring& ring, int i) {
  const Vec3 &p = ring.extrados[std::size_t(i)], &q = ring.extrados[std::size_t(i) + 1];
  const Vec3 inward = Vec3(q.z() - p.z(), 0.0, p.x() - q.x()).normalized();
  return {inward, inward.dot(0.5 * (p + q))};
}

/// The part of a polygon between joints `first` and `last` + 1 of a ring, outside the extrados of wedge `facet`.
Polygon sector(const Polygon& polygon, const Ring& ring, int first, int last, int facet) {
  Polygon piece = cut(polygon, past_joint(ring, first), 1e-9);
  if (piece.size() >= 3) piece = cut(piece, before_joint(ring, last + 1), 1e-9);
  if (piece.size() >= 3) piece = cut(piece, above_wedge(ring, facet), 1e-9);
  return piece;
}

struct Piece {
  int first = 0, last = 0, facet = 0;  // wedges it reaches over; the one whose extrados cuts it
  Polygon polygon;
};

/// One piece instead of two neighbours, if the extrados of one of them bounds both. (A point of another sector outside
/// that facet's line is outside the convex ring, so equal areas mean equal sets.)
bool join(const Polygon& polygon, const Ring& ring, Piece& left, const Piece& right) {
  const double both = polygon_area(left.polygon) + polygon_area(right.polygon);
  for (const int facet : {left.facet, right.facet}) {
    const Polygon whole = sector(polygon, ring, left.first, right.last, facet);
    if (whole.size() < 3 || std::abs(polygon_area(whole) - both) > 1e-9 * (1.0 + both)) continue;
    left = {left.first, right.last, facet, whole};
    return true;
  }
  return false;
}

/// First wedge whose sector a polygon may reach, and one past the last. Above the springing its corners lie past a
/// joint or before it in the joints' order, so that both are found by halving.
std::pair<int, int> sectors_reached(const Polygon& polygon, const Ring& ring) {
  const auto below = [&](const Vec3& p) { return p.z() < ring.centre.z(); };
  if (std::any_of(polygon.begin(), polygon.end(), below)) return {0, ring.wedges()};
  const auto reaches = [&](const Plane& plane) {
    const auto inside = [&](const Vec3& p) { return plane.normal.dot(p) - plane.offset < kNothing; };
    return std::any_of(polygon.begin(), polygon.end(), inside);
  };
  const boost::counting_iterator<int> begin(0), end(ring.wedges());
  const auto first = std::partition_point(begin, end, [&](int i) { return !reaches(before_joint(ring, i + 1)); });
  const auto last = std::partition_point(begin, end, [&](int i) { return reaches(past_joint(ring, i)); });
  return {*first, *last};
}

bool clear_of(const Polygon& polygon, const Ring& ring) {
  Vec3 low = polygon[0], high = polygon[0];
  for (const Vec3& p : polygon) low = low.cwiseMin(p), high = high.cwiseMax(p);
  double top = ring.centre.z();
  for (const Vec3& p : ring.extrados) top = std::max(top, p.z());
  return high.x() <= ring.extrados.front().x() || low.x() >= ring.extrados.back().x() || low.z() >= top ||
         high.z() <= ring.centre.z();
}

/// Lays one box of a course, cut by the rings.
void lay_box(Layout& layout, const Vec3& low, const Vec3& high, const Unit& unit, const Vec3& nominal) {
  const Polygon whole = rectangle(low.x(), high.x(), low.z(), high.z());
  const auto reaches = [&](const Ring& ring) { return !clear_of(whole, ring); };
  const bool was_cut = std::any_of(layout.rings.begin(), layout.rings.end(), reaches);
  for (const auto& group : connected_groups(outside(low, high, layout.rings))) {
    std::vector<Polyhedron> solids;
    for (const Polygon& cell : group) solids.push_back(sweep_across(cell, low.y(), high.y()));
    lay_stone(layout, std::move(solids), unit, nominal, was_cut);
  }
}

}  // namespace

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

Ring make_semicircle(const Vec3& centre, double inner_radius, double outer_radius, int wedges) {
  Ring ring;
  ring.centre = centre;
  const auto point = [&](double radius, double c, double s) {
    return Vec3(centre.x() + radius * c, 0.0, centre.z() + radius * s);
  };
  for (int i = 0; i <= wedges; ++i) {
    // The right half mirrors the left one, so that both have the same bits.
    const int j = std::min(i, wedges - i);
    const double angle = pi * j / wedges;
    const bool crown = 2 * i == wedges;
    const double c = crown ? 0.0 : (i == j ? -1.0 : 1.0) * std::cos(angle), s = crown ? 1.0 : std::sin(angle);
    ring.intrados.push_back(point(inner_radius, c, s));
    ring.extrados.push_back(point(outer_radius, c, s));
  }
  return ring;
}

std::vector<std::int64_t> lay_ring(Layout& layout, const Ring& ring, double y0, double y1, const Unit& unit) {
  std::vector<std::int64_t> first;
  for (std::size_t i = 0; i + 1 < ring.intrados.size(); ++i) {
    first.push_back(std::int64_t(layout.stones.size()));
    const Polygon wedge = {ring.intrados[i], ring.intrados[i + 1], ring.extrados[i + 1], ring.extrados[i]};
    const std::vector<double> y = split(y0, y1, unit.size.y(), i % 2 == 1);
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      lay_stone(layout, {sweep_across(wedge, y[j], y[j + 1])}, unit, unit.size, false);
    }
  }
  first.push_back(std::int64_t(layout.stones.size()));
  return first;
}

std::vector<Polygon> outside(const Polygon& polygon, const Ring& ring) {
  std::vector<Piece> pieces;
  const auto [first, last] = sectors_reached(polygon, ring);
  for (int i = first; i < last; ++i) {
    Piece piece = {i, i, i, sector(polygon, ring, i, i, i)};
    if (is_nothing(piece.polygon)) continue;
    const bool next = !pieces.empty() && pieces.back().last == i - 1;
    if (!next || !join(polygon, ring, pieces.back(), piece)) pieces.push_back(std::move(piece));
  }
  std::vector<Polygon> result;
  for (Piece& piece : pieces) result.push_back(std::move(piece.polygon));
  return result;
}

std::vector<Polygon> outside(const Vec3& low, const Vec3& high, const std::vector<Ring>& rings) {
  const Polygon whole = rectangle(low.x(), high.x(), low.z(), high.z());
  std::vector<Polygon> pieces = {whole};
  for (const Ring& ring : rings) {
    if (clear_of(whole, ring)) continue;
    std::vector<Polygon> next;
    for (const Polygon& piece : pieces) {
      for (Polygon& part : outside(piece, ring)) next.push_back(std::move(part));
    }
    pieces = std::move(next);
  }
  return pieces;
}

void lay_courses(Layout& layout, const Vec3& low, const Vec3& high, const Unit& unit, int first) {
  if ((high - low).minCoeff() <= 0.0) return;
  const std::vector<double> z = split(low.z(), high.z(), unit.size.z());
  const Vec3 counts = ((high - low).cwiseQuotient(unit.size)).array().round().max(1.0);
  check_number(double(layout.stones.size()) + counts.prod());
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
  check_number(double(layout.stones.size()) + 1.0);
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
