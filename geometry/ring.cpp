#include "geometry/ring.h"

#include <algorithm>
#include <boost/iterator/counting_iterator.hpp>
#include <cmath>

#include "solver/base/constants.h"

namespace voussoir {

namespace {

double perimeter(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) sum += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  return sum;
}

/// The half-plane past joint i of a ring, going from left to right.
Plane past_joint(const Ring& ring, int i) {
  const Vec3& from = ring.centre ? *ring.centre : ring.intrados[std::size_t(i)];
  const Vec3 along = (ring.extrados[std::size_t(i)] - from).normalized();
  const Vec3 backward(-along.z(), 0.0, along.x());
  return {backward, backward.dot(from)};
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

/// The part under a springing joint: on this side of the opening.
Polygon under_foot(const Polygon& polygon, const Ring& ring, bool left) {
  const int joint = left ? 0 : ring.wedges();
  const Vec3& spring = ring.intrados[std::size_t(joint)];
  const Vec3 inward(left ? 1.0 : -1.0, 0.0, 0.0);
  Polygon piece = cut(polygon, left ? before_joint(ring, 0) : past_joint(ring, joint), 1e-9);
  if (piece.size() >= 3) piece = cut(piece, {inward, inward.dot(spring)}, 1e-9);
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

double lowest_foot(const Ring& ring) {
  return std::min(
      {ring.intrados.front().z(), ring.intrados.back().z(), ring.extrados.front().z(), ring.extrados.back().z()});
}

double highest(const Ring& ring) {
  double top = -1e300;
  for (const Vec3& p : ring.extrados) top = std::max(top, p.z());
  return top;
}

/// First wedge whose sector a polygon may reach, and one past the last. Above the springing its corners lie past a
/// joint or before it in the joints' order, so that both are found by halving; where the joints do not meet in one
/// point that holds outside the ring only, and all sectors are tried.
std::pair<int, int> sectors_reached(const Polygon& polygon, const Ring& ring) {
  const auto below = [&](const Vec3& p) { return p.z() < lowest_foot(ring); };
  if (!ring.centre || std::any_of(polygon.begin(), polygon.end(), below)) return {0, ring.wedges()};
  const auto reaches = [&](const Plane& plane) {
    const auto inside = [&](const Vec3& p) { return plane.normal.dot(p) - plane.offset < no_masonry; };
    return std::any_of(polygon.begin(), polygon.end(), inside);
  };
  const boost::counting_iterator<int> begin(0), end(ring.wedges());
  const auto first = std::partition_point(begin, end, [&](int i) { return !reaches(before_joint(ring, i + 1)); });
  const auto last = std::partition_point(begin, end, [&](int i) { return reaches(past_joint(ring, i)); });
  return {*first, *last};
}

/// Beside the ring and the opening below it, or above both.
bool clear_of(const Polygon& polygon, const Ring& ring) {
  const Box box = bounding_box(polygon);
  const double left = std::min(ring.intrados.front().x(), ring.extrados.front().x()),
               right = std::max(ring.intrados.back().x(), ring.extrados.back().x());
  return box.high.x() <= left || box.low.x() >= right || box.low.z() >= highest(ring);
}

bool clear_of(const Polygon& polygon, const Box& taken) {
  const Box box = bounding_box(polygon);
  return box.high.x() <= taken.low.x() || box.low.x() >= taken.high.x() || box.low.z() >= taken.high.z() ||
         box.high.z() <= taken.low.z();
}

bool clear_of(const Polygon& polygon, const Plane& side) {
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](const Vec3& p) { return side.normal.dot(p) <= side.offset + no_masonry; });
}

/// Left of a support, right of it, above it.
std::vector<Polygon> outside(const Polygon& polygon, const Box& taken) {
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  const Plane left = {x, taken.low.x()}, right = {-x, -taken.high.x()};
  Polygon above = cut(cut(polygon, {-x, -taken.low.x()}, 1e-9), {x, taken.high.x()}, 1e-9);
  above = cut(above, {-z, -taken.high.z()}, 1e-9);
  std::vector<Polygon> pieces = {cut(polygon, left, 1e-9), std::move(above), cut(polygon, right, 1e-9)};
  std::erase_if(pieces, is_nothing);
  return pieces;
}

std::vector<Polygon> outside(const Polygon& polygon, const Plane& side) {
  Polygon piece = cut(polygon, side, 1e-9);
  return is_nothing(piece) ? std::vector<Polygon>{} : std::vector<Polygon>{std::move(piece)};
}

template <class Limit>
void cut_all(std::vector<Polygon>& pieces, const Polygon& whole, const std::vector<Limit>& limits) {
  for (const Limit& limit : limits) {
    if (clear_of(whole, limit)) continue;
    std::vector<Polygon> next;
    for (const Polygon& piece : pieces)
      for (Polygon& part : outside(piece, limit)) next.push_back(std::move(part));
    pieces = std::move(next);
  }
}

}  // namespace

int quarter_of(const Polygon& intrados, int wedge) {
  const double left = intrados.front().x(), span = intrados.back().x() - left;
  const auto k = std::size_t(wedge);
  const double low = std::min(intrados[k].x(), intrados[k + 1].x()),
               high = std::max(intrados[k].x(), intrados[k + 1].x());
  for (const int side : {0, 1}) {
    const double at = left + (side == 0 ? 0.25 : 0.75) * span;
    if (at >= low - no_masonry && at <= high + no_masonry) return side;
  }
  return -1;
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

Polygon rectangle(double x0, double x1, double z0, double z1) {
  return {{x0, 0.0, z0}, {x1, 0.0, z0}, {x1, 0.0, z1}, {x0, 0.0, z1}};
}

bool is_nothing(const Polygon& polygon) {
  return polygon.size() < 3 || polygon_area(polygon) < no_masonry * perimeter(polygon);
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
  for (const bool left : {true, false})
    if (Polygon foot = under_foot(polygon, ring, left); !is_nothing(foot)) result.push_back(std::move(foot));
  return result;
}

std::vector<Polygon> within(const Polygon& polygon, const SectionLimits& limits) {
  std::vector<Polygon> pieces = {polygon};
  cut_all(pieces, polygon, limits.rings);
  cut_all(pieces, polygon, limits.taken);
  cut_all(pieces, polygon, limits.past);
  return pieces;
}

bool reach(const SectionLimits& limits, const Polygon& polygon) {
  const auto into = [&](const auto& limit) { return !clear_of(polygon, limit); };
  return std::any_of(limits.rings.begin(), limits.rings.end(), into) ||
         std::any_of(limits.taken.begin(), limits.taken.end(), into) ||
         std::any_of(limits.past.begin(), limits.past.end(), into);
}

}  // namespace voussoir
