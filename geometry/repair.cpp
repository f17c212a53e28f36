#include "geometry/repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "solver/base/counted.h"

namespace voussoir {
namespace {

constexpr double k_relative = 1e-6;  // of the shape's size: single-precision coordinates still pass

using Edge = std::pair<int, int>;
using Loop = std::vector<int>;

double size_of(const Polyhedron& shape) {
  const Box box = bounding_box(shape);
  return shape.vertices.empty() ? 0.0 : (box.high - box.low).norm();
}

/// Vertices within the tolerance become one (the first), unused ones go, collapsed faces go.
Polyhedron welded(const Polyhedron& shape, double tolerance) {
  Polyhedron out;
  std::vector<int> to;
  for (const Vec3& p : shape.vertices) {
    const auto near = [&](const Vec3& q) { return (p - q).norm() <= tolerance; };
    const auto at = std::find_if(out.vertices.begin(), out.vertices.end(), near);
    to.push_back(static_cast<int>(at - out.vertices.begin()));
    if (at == out.vertices.end()) out.vertices.push_back(p);
  }
  for (const Loop& face : shape.faces) {
    Loop loop;
    for (int v : face)
      if (loop.empty() || loop.back() != to[v]) loop.push_back(to[v]);
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() >= 3) out.faces.push_back(loop);
  }
  return out;
}

std::map<Edge, int> face_of_edge(const std::vector<Loop>& faces) {
  std::map<Edge, int> owner;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t i = 0; i < faces[f].size(); ++i)
      owner[{faces[f][i], faces[f][(i + 1) % faces[f].size()]}] = static_cast<int>(f);
  return owner;
}

/// A face no wider than the tolerance: its normal is noise. Its length does not matter: the short end of a thin wedge
/// is a face like any other.
bool is_sliver(const Polygon& polygon, double tolerance) {
  double longest = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    longest = std::max(longest, (polygon[(i + 1) % polygon.size()] - polygon[i]).norm());
  return polygon_area(polygon) <= longest * tolerance;
}

/// Group number of each face: flooded from the largest free face over edges while normals agree with that face.
std::vector<int> coplanar_groups(const Polyhedron& shape, double angle, double tolerance) {
  const int n = static_cast<int>(shape.faces.size());
  std::vector<Vec3> normals;
  std::vector<double> areas;
  std::vector<char> slivers;
  for (int f = 0; f < n; ++f) {
    const Polygon polygon = face_polygon(shape, f);
    normals.push_back(polygon_normal(polygon));
    areas.push_back(polygon_area(polygon));
    slivers.push_back(is_sliver(polygon, tolerance));
  }
  std::vector<int> order(n), group(n, -1);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int p, int q) { return areas[p] > areas[q]; });
  const auto owner = face_of_edge(shape.faces);
  for (int seed : order) {
    if (group[seed] >= 0) continue;
    group[seed] = seed;
    for (Loop todo = {seed}; !todo.empty();) {
      const Loop face = shape.faces[todo.back()];
      todo.pop_back();
      for (std::size_t i = 0; i < face.size(); ++i) {
        const auto twin = owner.find({face[(i + 1) % face.size()], face[i]});
        if (twin == owner.end() || group[twin->second] >= 0) continue;
        const Vec3 &u = normals[seed], &v = normals[twin->second];
        const bool agrees = std::atan2(u.cross(v).norm(), u.dot(v)) <= angle;
        if (!agrees && !slivers[twin->second]) continue;
        group[twin->second] = seed;
        todo.push_back(twin->second);
      }
    }
  }
  return group;
}

/// The one loop around a group of faces; empty if their outline is not a single loop.
Loop outline(const std::vector<Loop>& faces) {
  const auto owner = face_of_edge(faces);
  std::map<int, int> next;
  std::size_t edges = 0;
  for (const auto& [edge, face] : owner) {
    if (owner.count({edge.second, edge.first})) continue;
    next[edge.first] = edge.second;
    ++edges;
  }
  if (next.size() != edges || next.empty()) return {};
  Loop loop;
  for (auto node = next.extract(next.begin()->first); node; node = next.extract(node.mapped()))
    loop.push_back(node.key());
  return next.empty() ? loop : Loop{};
}

/// Drops vertices that no face uses and those on a straight edge between two faces.
void drop_loose_vertices(Polyhedron& shape, double tolerance) {
  std::vector<int> uses(shape.vertices.size(), 0), to(shape.vertices.size(), -1);
  std::vector<bool> corner(shape.vertices.size(), false);
  for (const Loop& face : shape.faces)
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vec3& here = shape.vertices[face[i]];
      const Vec3 in = here - shape.vertices[face[(i + face.size() - 1) % face.size()]];
      const Vec3 on = shape.vertices[face[(i + 1) % face.size()]] - here;
      ++uses[face[i]];
      if (in.cross(on).norm() > tolerance * (in + on).norm()) corner[face[i]] = true;
    }
  std::vector<Vec3> kept;
  for (std::size_t v = 0; v < uses.size(); ++v) {
    if (uses[v] == 0 || (uses[v] < 3 && !corner[v])) continue;
    to[v] = static_cast<int>(kept.size());
    kept.push_back(shape.vertices[v]);
  }
  for (Loop& face : shape.faces) {
    for (int& v : face) v = to[v];
    std::erase(face, -1);
  }
  std::erase_if(shape.faces, [](const Loop& face) { return face.size() < 3; });
  shape.vertices = std::move(kept);
}

std::string check_indices(const Polyhedron& shape) {
  for (std::size_t v = 0; v < shape.vertices.size(); ++v)
    if (!shape.vertices[v].allFinite()) return fmt::format("vertex {} is not finite", v);
  if (shape.faces.size() < 4)
    return fmt::format("it has {}; a closed solid has at least 4", counted(shape.faces.size(), "face"));
  const int count = static_cast<int>(shape.vertices.size());
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    if (shape.faces[f].size() < 3) return fmt::format("face {} has fewer than 3 corners", f);
    for (int v : shape.faces[f])
      if (v < 0 || v >= count) return fmt::format("face {} uses vertex {}, but there are {} vertices", f, v, count);
  }
  return "";
}

std::string check_closed(const Polyhedron& shape) {
  std::map<Edge, int> owner;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const Loop& face = shape.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Edge edge{face[i], face[(i + 1) % face.size()]};
      const auto [at, fresh] = owner.try_emplace(edge, static_cast<int>(f));
      if (!fresh)
        return fmt::format(
            "faces {} and {} run along the edge from vertex {} to {} in the same direction; reverse one of them",
            at->second, f, edge.first, edge.second);
    }
  }
  for (const auto& [edge, face] : owner)
    if (!owner.count({edge.second, edge.first}))
      return fmt::format("it is not closed: the edge from vertex {} to {} belongs to face {} only", edge.first,
                         edge.second, face);
  return "";
}

std::string check_volume(const Polyhedron& shape, double size) {
  const double volume = mass_properties(shape).volume;
  if (std::abs(volume) <= 1e-12 * size * size * size) return fmt::format("it has no volume ({:g} m3)", volume);
  if (volume < 0.0) return "it is inside-out: list the corners of every face counter-clockwise seen from outside";
  return "";
}

/// Every vertex must lie on the inner side of every face, and the face's own on it.
std::string check_convex(const Polyhedron& shape, double tolerance) {
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const Polygon polygon = face_polygon(shape, static_cast<int>(f));
    if (polygon_area(polygon) <= tolerance * tolerance) continue;
    const Plane plane = face_plane(shape, static_cast<int>(f));
    double off = 0.0;
    for (const Vec3& p : polygon) off = std::max(off, std::abs(plane.normal.dot(p) - plane.offset));
    if (off > tolerance)
      return fmt::format("face {} is not planar: its corners lie up to {:.3g} m off a plane", f, off);
    for (std::size_t v = 0; v < shape.vertices.size(); ++v) {
      const double height = plane.normal.dot(shape.vertices[v]) - plane.offset;
      if (height > tolerance)
        return fmt::format("it is not convex: vertex {} is {:.3g} m outside the plane of face {}", v, height, f);
    }
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()], &r = polygon[(i + 2) % polygon.size()];
      if ((q - p).cross(r - q).dot(plane.normal) < -tolerance * (r - p).norm())
        return fmt::format("face {} is not convex at its corner {}", f, (i + 1) % polygon.size());
    }
  }
  return "";
}

}  // namespace

Polyhedron merge_coplanar_faces(const Polyhedron& triangulated, double angle) {
  const double tolerance = k_relative * size_of(triangulated);
  Polyhedron shape = welded(triangulated, tolerance);
  const std::vector<int> group = coplanar_groups(shape, angle, tolerance);
  std::map<int, std::vector<Loop>> members;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) members[group[f]].push_back(shape.faces[f]);
  shape.faces.clear();
  for (const auto& [seed, faces] : members) {
    const Loop loop = outline(faces);
    if (loop.size() >= 3) {
      shape.faces.push_back(loop);
    } else {
      shape.faces.insert(shape.faces.end(), faces.begin(), faces.end());
    }
  }
  drop_loose_vertices(shape, tolerance);
  return shape;
}

std::string convexity_error(const Polyhedron& shape) {
  if (std::string error = check_indices(shape); !error.empty()) return error;
  if (std::string error = check_closed(shape); !error.empty()) return error;
  const double size = size_of(shape);
  if (std::string error = check_volume(shape, size); !error.empty()) return error;
  return check_convex(shape, k_relative * size);
}

}  // namespace voussoir
