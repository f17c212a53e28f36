#include "geometry/convex.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/segment.h"

namespace voussoir {
namespace {

constexpr double k_parallel = 1e-8;  // sine below which two edges have one direction
// Sine below which two edges that meet lie side by side: they do not cross, and the cross product says nothing of use.
// In masonry every stone has such neighbours, edge along edge.
constexpr double k_side_by_side = 0.05;
constexpr double k_tie = 1e-9;   // m, or of a unit vector's components
constexpr double k_steep = 0.1;  // cosine below which a face is too steep to carry a patch

/// A separating axis: unit, from a to b. Face axes name the face, of a or of b.
struct Axis {
  double separation = -1e300;
  Vec3 normal = Vec3::UnitZ();
  int face_a = -1, face_b = -1;
};

double lowest(const std::vector<Vec3>& points, const Vec3& along) {
  double low = 1e300;
  for (const Vec3& p : points) low = std::min(low, along.dot(p));
  return low;
}

struct Interval {
  double low = 1e300, high = -1e300;
};
Interval extent(const std::vector<Vec3>& points, const Vec3& along) {
  Interval out;
  for (const Vec3& p : points) {
    const double d = along.dot(p);
    out.low = std::min(out.low, d);
    out.high = std::max(out.high, d);
  }
  return out;
}

/// −1 or +1 by the first component that differs, 0 if none does.
int compare(const Vec3& p, const Vec3& q) {
  for (int i = 0; i < 3; ++i)
    if (std::abs(p[i] - q[i]) > k_tie) return p[i] < q[i] ? -1 : 1;
  return 0;
}

/// The line's direction with a sign that does not depend on which body is called a.
Vec3 unsigned_direction(const Vec3& n) {
  return compare(n, Vec3::Zero()) < 0 ? Vec3(-n) : n;
}

/// Whether an axis is better: larger separation; in a tie nearer to the line of centres; then an order that depends
/// neither on the numbering of faces nor on the order of the bodies.
bool better(const Axis& axis, const Axis& best, const Vec3& centres) {
  if (std::abs(axis.separation - best.separation) > k_tie) return axis.separation > best.separation;
  const double here = std::abs(axis.normal.dot(centres)), there = std::abs(best.normal.dot(centres));
  if (std::abs(here - there) > k_tie * centres.norm()) return here > there;
  return compare(unsigned_direction(axis.normal), unsigned_direction(best.normal)) < 0;
}

/// The best axis over the face normals of both, or the first that separates by more than `enough`.
Axis best_face_axis(const Convex& a, const Convex& b, const Vec3& centres, double enough) {
  Axis best;
  for (int side = 0; side < 2; ++side) {
    const Convex &own = side ? b : a, &other = side ? a : b;
    for (int f = 0; f < static_cast<int>(own.planes.size()); ++f) {
      const Plane& plane = own.planes[f];
      if (plane.normal.squaredNorm() < 0.5) continue;  // a face without area
      Axis axis{lowest(other.vertices, plane.normal) - plane.offset, side ? Vec3(-plane.normal) : plane.normal, -1, -1};
      (side ? axis.face_b : axis.face_a) = f;
      if (axis.separation > enough) return axis;
      if (better(axis, best, centres)) best = axis;
    }
  }
  return best;
}

Axis best_edge_axis(const Convex& a, const Convex& b, const Vec3& centres, double enough, double least_sine) {
  Axis best;
  for (const Vec3& u : a.directions)
    for (const Vec3& v : b.directions) {
      const Vec3 cross = u.cross(v);
      const double sine = cross.norm();
      if (sine < least_sine) continue;
      const Vec3 normal = cross / sine;
      const Interval ia = extent(a.vertices, normal), ib = extent(b.vertices, normal);
      const bool forward = ib.low - ia.high >= ia.low - ib.high;
      const Axis axis{forward ? ib.low - ia.high : ia.low - ib.high, forward ? normal : Vec3(-normal), -1, -1};
      if (axis.separation > enough) return axis;
      if (better(axis, best, centres)) best = axis;
    }
  return best;
}

/// The edges that lie at the far end along a direction, or the far corner as an edge of no length.
std::vector<std::pair<Vec3, Vec3>> support_edges(const Convex& shape, const Vec3& along) {
  const double far = extent(shape.vertices, along).high;
  const auto at_end = [&](int v) { return along.dot(shape.vertices[v]) >= far - k_tie; };
  std::vector<std::pair<Vec3, Vec3>> out;
  for (const auto& [i, j] : shape.edges)
    if (at_end(i) && at_end(j)) out.emplace_back(shape.vertices[i], shape.vertices[j]);
  for (int v = 0; out.empty(); ++v)
    if (at_end(v)) out.emplace_back(shape.vertices[v], shape.vertices[v]);
  return out;
}

Meeting edge_meeting(const Convex& a, const Convex& b, const Axis& axis) {
  Meeting out{Meeting::Kind::edge, axis.separation, axis.normal, -1, -1, {}, {}, 0.0};
  double best = 1e300;
  for (const auto& p : support_edges(a, axis.normal))
    for (const auto& q : support_edges(b, -axis.normal)) {
      const auto [on_a, on_b] = nearest_points({p.first, p.second}, {q.first, q.second});
      const double distance = (on_b - on_a).norm();
      if (distance >= best) continue;
      best = distance;
      out.on_a = {on_a};
      out.on_b = {on_b};
    }
  return out;
}

Polygon loop_of(const Convex& shape, int face) {
  Polygon out;
  for (int v : shape.faces[face]) out.push_back(shape.vertices[v]);
  return out;
}

Vec3 plain_mean(const Polygon& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// The face of `shape` that looks against `normal` most, of those at its deepest corner. A face elsewhere could look
/// more against it, but a patch there would miss the corner that touches.
int facing(const Convex& shape, const Vec3& normal, const Vec3& near) {
  const double deep = lowest(shape.vertices, normal) + k_tie;
  int best = -1;
  double best_cosine = 0.0;
  for (int f = 0; f < static_cast<int>(shape.faces.size()); ++f) {
    const auto& loop = shape.faces[f];
    if (std::none_of(loop.begin(), loop.end(), [&](int v) { return normal.dot(shape.vertices[v]) <= deep; })) continue;
    const double cosine = shape.planes[f].normal.dot(normal);
    bool take = best < 0 || cosine < best_cosine - k_tie;
    if (!take && cosine <= best_cosine + k_tie) {
      const Vec3 here = plain_mean(loop_of(shape, f)) - near, there = plain_mean(loop_of(shape, best)) - near;
      const double difference = here.norm() - there.norm();
      take = std::abs(difference) > k_tie ? difference < 0.0 : compare(here, there) < 0;
    }
    if (!take) continue;
    best = f;
    best_cosine = cosine;
  }
  return best;
}

/// The middle of the part of the support edge (or corner) above a convex polygon; empty if no part is above it.
std::optional<Vec3> tip_over(const Convex& shape, const Polygon& polygon, const Vec3& normal) {
  const auto [p, q] = support_edges(shape, -normal).front();
  double low = 0.0, high = 1.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 outward = (polygon[(i + 1) % polygon.size()] - polygon[i]).cross(normal).normalized();
    const double dp = outward.dot(p - polygon[i]), dq = outward.dot(q - polygon[i]);
    if (dp > k_tie && dq > k_tie) return std::nullopt;
    if (dp > k_tie) low = std::max(low, dp / (dp - dq));
    if (dq > k_tie) high = std::min(high, dp / (dp - dq));
  }
  if (low > high) return std::nullopt;
  return p + 0.5 * (low + high) * (q - p);
}

/// The patch seen from the reference body: `normal` points out of its face.
struct Patch {
  int facing = -1;
  bool tip = false;
  Polygon on_reference, on_other;
  double area = 0.0;
};

Patch clip(const Convex& reference, int face, const Convex& other) {
  const Plane& plane = reference.planes[face];
  const Vec3& n = plane.normal;
  const Polygon window = loop_of(reference, face);
  Patch out;
  out.facing = facing(other, n, plain_mean(window));
  const Plane& opposite = other.planes[out.facing];
  const double cosine = opposite.normal.dot(n);
  if (cosine > -k_steep) {
    const auto tip = tip_over(other, window, n);
    if (!tip) return out;
    out.tip = true;
    out.on_other = {*tip};
    out.on_reference = {*tip - (n.dot(*tip) - plane.offset) * n};
    return out;
  }
  Polygon shadow = loop_of(other, out.facing);
  for (Vec3& p : shadow) p -= (n.dot(p) - plane.offset) * n;
  std::reverse(shadow.begin(), shadow.end());
  out.on_reference = cleaned(intersect(shadow, window, n));
  for (const Vec3& p : out.on_reference)
    out.on_other.push_back(p + (opposite.offset - opposite.normal.dot(p)) / cosine * n);
  if (!out.on_reference.empty()) out.area = polygon_area(out.on_reference);
  return out;
}

Meeting face_meeting(const Convex& a, const Convex& b, const Axis& axis) {
  const bool of_a = axis.face_a >= 0;
  Patch patch = of_a ? clip(a, axis.face_a, b) : clip(b, axis.face_b, a);
  Meeting out{Meeting::Kind::face, axis.separation, axis.normal, -1, -1, {}, {}, patch.area};
  if (patch.tip) out.kind = Meeting::Kind::edge;
  if (!patch.tip) {
    out.face_a = of_a ? axis.face_a : patch.facing;
    out.face_b = of_a ? patch.facing : axis.face_b;
  }
  if (!of_a) {  // counter-clockwise about b's normal is clockwise about the one from a to b
    std::reverse(patch.on_reference.begin(), patch.on_reference.end());
    std::reverse(patch.on_other.begin(), patch.on_other.end());
  }
  out.on_a = std::move(of_a ? patch.on_reference : patch.on_other);
  out.on_b = std::move(of_a ? patch.on_other : patch.on_reference);
  return out;
}

Meeting apart(const Axis& axis) {
  return {Meeting::Kind::apart, axis.separation, axis.normal, -1, -1, {}, {}, 0.0};
}

}  // namespace

Convex make_convex(const Polyhedron& shape) {
  Convex out;
  out.vertices = shape.vertices;
  out.faces = shape.faces;
  out.planes.reserve(shape.faces.size());
  std::vector<std::pair<int, int>> sides;  // of all faces: each edge twice
  sides.reserve(4 * shape.faces.size());
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    Plane plane = face_plane(shape, static_cast<int>(f));
    // A support plane even where a sliver of a face has a poor normal; a plane inside the body would tell of a
    // separation that is none.
    if (plane.normal.squaredNorm() > 0.5) plane.offset = extent(shape.vertices, plane.normal).high;
    out.planes.push_back(plane);
    const auto& face = shape.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) sides.push_back(std::minmax({face[i], face[(i + 1) % face.size()]}));
  }
  std::sort(sides.begin(), sides.end());
  out.edges.assign(sides.begin(), std::unique(sides.begin(), sides.end()));
  out.directions.reserve(3);  // of a cuboid
  for (const auto& [i, j] : out.edges) {
    const Vec3 edge = shape.vertices[j] - shape.vertices[i];
    if (edge.norm() < k_tie) continue;
    const Vec3 unit = edge.normalized();
    const auto same = [&](const Vec3& known) { return known.cross(unit).norm() < k_parallel; };
    if (std::none_of(out.directions.begin(), out.directions.end(), same)) out.directions.push_back(unit);
  }
  if (!shape.vertices.empty()) out.centre = plain_mean(shape.vertices);
  return out;
}

Convex moved(const Convex& shape, const Mat3& rotation, const Vec3& pivot, const Vec3& shift) {
  Convex out = shape;
  const Vec3 to = pivot + shift;
  for (Vec3& p : out.vertices) p = to + rotation * (p - pivot);
  out.centre = to + rotation * (shape.centre - pivot);
  for (Plane& plane : out.planes) {
    const double height = plane.offset - plane.normal.dot(pivot);  // of the plane over the pivot
    plane.normal = rotation * plane.normal;
    plane.offset = plane.normal.dot(to) + height;
  }
  for (Vec3& direction : out.directions) direction = rotation * direction;
  return out;
}

double separation(const Convex& a, const Convex& b, double enough) {
  const Vec3 centres = b.centre - a.centre;
  const double faces = best_face_axis(a, b, centres, enough).separation;
  if (faces > enough) return faces;
  return std::max(faces, best_edge_axis(a, b, centres, enough, k_parallel).separation);
}

Meeting meeting(const Convex& a, const Convex& b, double within) {
  const Vec3 centres = b.centre - a.centre;
  const Axis face = best_face_axis(a, b, centres, within);
  if (face.separation > within) return apart(face);
  const Axis edge = best_edge_axis(a, b, centres, within, k_side_by_side);
  if (edge.separation > within) return apart(edge);
  if (edge.separation > face.separation + 1e-6 + 0.02 * std::abs(face.separation)) return edge_meeting(a, b, edge);
  return face_meeting(a, b, face);
}

}  // namespace voussoir
