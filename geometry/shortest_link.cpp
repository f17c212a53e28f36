#include "geometry/shortest_link.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/segment.h"

namespace voussoir {
namespace {

constexpr double k_flat = 1e-3;   // rad: faces that meet flatter than this are no matter of edges (as for joints)
constexpr double k_along = 0.05;  // sine below which two edges lie along each other
constexpr double k_farthest_inset = 4.0;  // of the shrinking: sharper tips are cut off by that much

/// The least vector w with n · w = −1 for the given unit normals (one to three); none if they do not allow it.
template <int Count>
std::optional<Vec3> least_vector(const Eigen::Matrix<double, 3, Count>& normals) {
  const Eigen::Matrix<double, Count, Count> gram = normals.transpose() * normals;
  if (gram.determinant() < 1e-9) return std::nullopt;
  return normals * gram.inverse() * -Eigen::Matrix<double, Count, 1>::Ones();
}

/// Displacement of a corner if its faces move inwards by one: to the intersection of three of them that is behind all
/// others. If more than three faces meet in a corner, there may be several such points; the farthest out is used (along
/// the shortest way behind all faces). Within an edge or a face, two faces or one determine it.
Vec3 inset(const std::vector<Vec3>& normals) {
  std::vector<Vec3> ways[3];  // by one, two, three faces
  const auto take = [&](int faces, const std::optional<Vec3>& w) {
    if (w && std::none_of(normals.begin(), normals.end(), [&](const Vec3& n) { return n.dot(*w) > -1.0 + 1e-6; }))
      ways[faces - 1].push_back(*w);
  };
  const std::size_t count = normals.size();
  for (std::size_t i = 0; i < count; ++i) {
    take(1, Vec3(-normals[i]));
    for (std::size_t j = i + 1; j < count; ++j) {
      Eigen::Matrix<double, 3, 2> two;
      two << normals[i], normals[j];
      take(2, least_vector<2>(two));
      for (std::size_t k = j + 1; k < count; ++k) {
        Mat3 three;
        three << normals[i], normals[j], normals[k];
        take(3, least_vector<3>(three));
      }
    }
  }
  Vec3 shortest = Vec3::Constant(1e9);
  for (const auto& some : ways)
    for (const Vec3& w : some)
      if (w.squaredNorm() < shortest.squaredNorm()) shortest = w;
  for (const auto* some : {&ways[2], &ways[1], &ways[0]}) {
    if (some->empty()) continue;
    Vec3 best = some->front();
    for (const Vec3& w : *some) {
      const double farther = shortest.dot(best - w) / shortest.norm();
      if (farther > 1e-9 || (farther > -1e-9 && w.squaredNorm() < best.squaredNorm())) best = w;
    }
    const double length = best.norm();
    return length > k_farthest_inset ? Vec3(best * (k_farthest_inset / length)) : best;
  }
  return Vec3::Zero();
}

/// A corner of the difference of two shapes, and which two corners it is of.
struct Corner {
  Vec3 y = Vec3::Zero();
  int a = 0, b = 0;
  double weight = 0.0;
};
using Simplex = std::vector<Corner>;  // at most four

int farthest(const std::vector<Vec3>& points, const Vec3& along) {
  int best = 0;
  double high = -1e300;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double d = along.dot(points[i]); d > high) high = d, best = int(i);
  return best;
}

/// The point of the plane (line, corner) through some corners that is nearest to the origin, by its weights in them.
/// False if it lies outside them, or they do not span anything.
bool nearest_of(Simplex& corners) {
  const auto more = Eigen::Index(corners.size()) - 1;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> sides(3, more);
  for (Eigen::Index i = 0; i < more; ++i) sides.col(i) = corners[std::size_t(i) + 1].y - corners[0].y;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> weights(more);
  if (more > 0) {
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram = sides.transpose() * sides;
    double scale = 1.0;
    for (Eigen::Index i = 0; i < more; ++i) scale *= gram(i, i);
    if (!(gram.determinant() > 1e-12 * scale)) return false;
    weights = gram.inverse() * (sides.transpose() * -corners[0].y);
  }
  corners[0].weight = 1.0 - weights.sum();
  for (Eigen::Index i = 0; i < more; ++i) corners[std::size_t(i) + 1].weight = weights[i];
  return std::all_of(corners.begin(), corners.end(), [](const Corner& c) { return c.weight >= 0.0; });
}

Vec3 point_of(const Simplex& corners) {
  Vec3 sum = Vec3::Zero();
  for (const Corner& c : corners) sum += c.weight * c.y;
  return sum;
}

/// The corners among these that span the nearest point to the origin; the last one is among them, as it was nearer.
Simplex nearest_part(const Simplex& corners) {
  Simplex best = {corners.back()};
  double least = 1e300;
  for (unsigned chosen = 0; chosen < 1u << (corners.size() - 1); ++chosen) {
    Simplex part = {corners.back()};
    for (std::size_t i = 0; i + 1 < corners.size(); ++i)
      if (chosen & 1u << i) part.push_back(corners[i]);
    if (!nearest_of(part)) continue;
    const double here = point_of(part).squaredNorm();
    if (here < least) least = here, best = part;
  }
  if (best.size() == 1) best.front().weight = 1.0;
  return best;
}

/// Corners that span the point of the difference b − a nearest to the origin; four if it contains the origin.
Simplex nearest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const Vec3& begin) {
  const auto support = [&](const Vec3& towards) {  // the corner of the difference farthest along −towards
    const int i = farthest(a, towards), j = farthest(b, -towards);
    return Corner{b[std::size_t(j)] - a[std::size_t(i)], i, j, 1.0};
  };
  Simplex simplex = {support(begin)};
  for (int turn = 0; turn < 64 && simplex.size() < 4; ++turn) {
    const Vec3 near = point_of(simplex);
    const Corner next = support(near);
    const double scale = std::max(near.squaredNorm(), 1e-12 * next.y.squaredNorm());
    if (near.squaredNorm() - near.dot(next.y) <= 1e-13 * scale) break;
    const auto same = [&](const Corner& c) { return c.a == next.a && c.b == next.b; };
    if (std::any_of(simplex.begin(), simplex.end(), same)) break;
    Simplex more = simplex;
    more.push_back(next);
    more = nearest_part(more);
    if (point_of(more).squaredNorm() >= near.squaredNorm()) break;  // rounding
    simplex = std::move(more);
  }
  return simplex;
}

Segment segment_of(const std::vector<Vec3>& vertices, const std::vector<int>& ends) {
  return {vertices[std::size_t(ends.front())], vertices[std::size_t(ends.back())]};
}

/// The common part of two parallel edges: a pair of points at each end.
struct Stretch {
  double length = 0.0;  // m
  std::array<Vec3, 2> on_a, on_b;
};

Stretch shared_stretch(const Segment& p, Segment q) {
  if ((p.to - p.from).dot(q.to - q.from) < 0.0) std::swap(q.from, q.to);
  const Vec3 along = ((p.to - p.from).normalized() + (q.to - q.from).normalized()).normalized();
  const double low = std::max(along.dot(p.from), along.dot(q.from));
  const double high = std::min(along.dot(p.to), along.dot(q.to));
  const auto at = [&](const Segment& s, double where) -> Vec3 {
    const double from = along.dot(s.from), to = along.dot(s.to);
    return s.from + (where - from) / (to - from) * (s.to - s.from);
  };
  return {high - low, {at(p, low), at(p, high)}, {at(q, low), at(q, high)}};
}

/// The longest stretch that edges at the ends of the link share.
Stretch longest_stretch(const Convex& a, const Convex& b, const ShortestLink& link, double shrink) {
  const std::vector<Vec3> shrunk_a = shrunk_vertices(a, shrink), shrunk_b = shrunk_vertices(b, shrink);
  const double near = link.distance + 1e-3 * shrink;
  Stretch best;
  for (const auto& [i, j] : a.edges) {
    const Segment p{a.vertices[std::size_t(i)], a.vertices[std::size_t(j)]};
    const Segment shrunk_p{shrunk_a[std::size_t(i)], shrunk_a[std::size_t(j)]};
    for (const auto& [k, l] : b.edges) {
      const Segment q{b.vertices[std::size_t(k)], b.vertices[std::size_t(l)]};
      const Vec3 u = p.to - p.from, v = q.to - q.from;
      if (u.cross(v).norm() >= k_along * u.norm() * v.norm()) continue;
      const auto [x, y] = nearest_points(shrunk_p, {shrunk_b[std::size_t(k)], shrunk_b[std::size_t(l)]});
      if ((y - x).norm() > near) continue;
      const Stretch stretch = shared_stretch(p, q);
      if (stretch.length > best.length) best = stretch;
    }
  }
  return best;
}

/// The pair of points at the ends of the link, on the cells as they are.
std::pair<Vec3, Vec3> link_points(const Convex& a, const Convex& b, const ShortestLink& link) {
  if (link.of_a.size() <= 2 && link.of_b.size() <= 2)
    return nearest_points(segment_of(a.vertices, link.of_a), segment_of(b.vertices, link.of_b));
  const double apart = link.normal.dot(link.on_b - link.on_a);
  if (link.of_a.size() > 2) return {link.on_b - apart * link.normal, link.on_b};
  return {link.on_a, link.on_a + apart * link.normal};
}

Vec3 weighted(const std::vector<Vec3>& points, const Simplex& corners, int Corner::*which) {
  Vec3 sum = Vec3::Zero();
  for (const Corner& c : corners) sum += c.weight * points[std::size_t(c.*which)];
  return sum;
}

std::vector<int> spanning(const Simplex& corners, int Corner::*which) {
  std::vector<int> out;
  for (const Corner& c : corners)
    if (std::find(out.begin(), out.end(), c.*which) == out.end()) out.push_back(c.*which);
  return out;
}

/// Corners of a face on the plane through the origin, and their heights over it.
Polygon shadow_of(const Convex& shape, int face, const Vec3& normal) {
  Polygon out;
  for (const int v : shape.faces[std::size_t(face)]) {
    const Vec3& p = shape.vertices[std::size_t(v)];
    out.push_back(p - normal.dot(p) * normal);
  }
  return out;
}

/// The point of a plane above (or below) another, along a direction.
Vec3 raised(const Vec3& p, const Plane& to, const Vec3& along) {
  return p + (to.offset - to.normal.dot(p)) / to.normal.dot(along) * along;
}

}  // namespace

std::vector<Vec3> shrunk_vertices(const Convex& shape, double shrink) {
  std::vector<std::vector<Vec3>> normals(shape.vertices.size());
  for (std::size_t f = 0; f < shape.faces.size(); ++f)
    for (const int v : shape.faces[f])
      if (shape.planes[f].normal.squaredNorm() > 0.5) normals[std::size_t(v)].push_back(shape.planes[f].normal);
  std::vector<Vec3> out = shape.vertices;
  for (std::size_t v = 0; v < out.size(); ++v) out[v] += shrink * inset(normals[v]);
  return out;
}

std::optional<ShortestLink> shortest_link(const Convex& a, const Convex& b, double shrink) {
  std::vector<Vec3> from = shrunk_vertices(a, shrink), to = shrunk_vertices(b, shrink);
  for (auto* points : {&from, &to})
    for (Vec3& p : *points) p -= a.centre;  // near the origin nothing cancels
  const Simplex corners = nearest_difference(from, to, b.centre - a.centre);
  const Vec3 way = point_of(corners);
  ShortestLink link;
  link.distance = way.norm();
  if (corners.size() == 4 || link.distance < 1e-3 * shrink) return std::nullopt;
  link.normal = way / link.distance;
  // It parts the shrunk cells by its whole length, or is not the shortest.
  const double apart = link.normal.dot(to[std::size_t(farthest(to, -link.normal))]) -
                       link.normal.dot(from[std::size_t(farthest(from, link.normal))]);
  if (std::abs(apart - link.distance) > 1e-6 * shrink) return std::nullopt;
  link.of_a = spanning(corners, &Corner::a), link.of_b = spanning(corners, &Corner::b);
  link.on_a = weighted(a.vertices, corners, &Corner::a), link.on_b = weighted(b.vertices, corners, &Corner::b);
  return link;
}

std::optional<Meeting> sharp_meeting(const Convex& a, const Convex& b, double within, double shrink) {
  const auto link = shortest_link(a, b, shrink);
  if (!link) return std::nullopt;
  Meeting out{Meeting::Kind::edge, 0.0, link->normal, -1, -1, {}, {}, 0.0};
  const Stretch stretch = longest_stretch(a, b, *link, shrink);
  if (stretch.length > 0.0) {
    out.on_a.assign(stretch.on_a.begin(), stretch.on_a.end());
    out.on_b.assign(stretch.on_b.begin(), stretch.on_b.end());
  } else {
    const auto [on_a, on_b] = link_points(a, b, *link);
    out.on_a = {on_a}, out.on_b = {on_b};
  }
  out.separation = 1e300;
  for (std::size_t i = 0; i < out.on_a.size(); ++i)
    out.separation = std::min(out.separation, out.normal.dot(out.on_b[i] - out.on_a[i]));
  if (out.separation <= within) return out;
  return Meeting{Meeting::Kind::apart, out.separation, out.normal, -1, -1, {}, {}, 0.0};
}

bool lie_flush(const Convex& a, const Convex& b, double within) {
  const auto touches = [&](const std::vector<int>& loop, const Plane& plane) {
    return std::any_of(loop.begin(), loop.end(), [&](int v) {
      return std::abs(plane.normal.dot(a.vertices[std::size_t(v)]) - plane.offset) <= within;
    });
  };
  for (std::size_t i = 0; i < a.faces.size(); ++i)
    for (const Plane& plane : b.planes)
      if (a.planes[i].normal.squaredNorm() > 0.5 &&
          (a.planes[i].normal + plane.normal).squaredNorm() < k_flat * k_flat && touches(a.faces[i], plane))
        return true;
  return false;
}

bool opens_at_an_edge(const Convex& a, const Convex& b, const Meeting& m, double margin) {
  const Vec3 &na = a.planes[std::size_t(m.face_a)].normal, &nb = b.planes[std::size_t(m.face_b)].normal;
  if ((na + nb).squaredNorm() < k_flat * k_flat) return false;
  std::size_t low = 0;
  const auto gap = [&](std::size_t i) { return m.normal.dot(m.on_b[i] - m.on_a[i]); };
  for (std::size_t i = 1; i < m.on_a.size(); ++i)
    if (gap(i) < gap(low)) low = i;
  const bool of_a = (na - m.normal).squaredNorm() < (nb + m.normal).squaredNorm();
  const Convex& reference = of_a ? a : b;
  const auto& loop = reference.faces[std::size_t(of_a ? m.face_a : m.face_b)];
  const Vec3& outward = of_a ? na : nb;
  const Vec3& at = of_a ? m.on_a[low] : m.on_b[low];
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3& p = reference.vertices[std::size_t(loop[i])];
    const Vec3 side = reference.vertices[std::size_t(loop[(i + 1) % loop.size()])] - p;
    if (std::abs(side.cross(outward).dot(at - p)) <= margin * side.norm()) return true;
  }
  return false;
}

Meeting on_common_plane(const Convex& a, const Convex& b, const Meeting& m, double shrink) {
  const auto link = shortest_link(a, b, shrink);
  if (!link || (link->normal - m.normal).squaredNorm() < 1e-12) return m;
  const Vec3& n = link->normal;
  const Plane &pa = a.planes[std::size_t(m.face_a)], &pb = b.planes[std::size_t(m.face_b)];
  Meeting out{Meeting::Kind::face, 0.0, n, m.face_a, m.face_b, {}, {}, 0.0};
  out.separation = m.separation;
  if (pa.normal.dot(n) < std::sqrt(0.5) || -pb.normal.dot(n) < std::sqrt(0.5)) return out;
  Polygon other = shadow_of(b, m.face_b, n);
  std::reverse(other.begin(), other.end());
  const Polygon shared = cleaned(intersect(shadow_of(a, m.face_a, n), other, n));
  if (shared.empty()) return out;
  out.area = polygon_area(shared);
  for (const Vec3& p : shared) out.on_a.push_back(raised(p, pa, n)), out.on_b.push_back(raised(p, pb, n));
  return out;
}

}  // namespace voussoir
