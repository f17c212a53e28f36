// Cutting of convex polyhedra and polygons by planes.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "geometry/polyhedron.h"

namespace voussoir {
namespace {

using Edge = std::pair<int, int>;

/// −1 inside, 0 on the plane within the tolerance, +1 outside.
int side_of(double distance, double tolerance) {
  return distance > tolerance ? 1 : distance < -tolerance ? -1 : 0;
}

/// The point where p → q crosses the plane; `dp` and `dq` are the distances, of opposite sign. The same bits for either
/// direction, so that neighbouring faces get the same point.
Vec3 crossing(const Vec3& p, double dp, const Vec3& q, double dq) {
  if (dp > dq) return crossing(q, dq, p, dp);
  return p + (dp / (dp - dq)) * (q - p);
}

/// Removes consecutive repetitions from a cyclic loop.
void drop_repeats(std::vector<int>& loop) {
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
}

/// Work area of one cut of a polyhedron.
struct Cutter {
  const Polyhedron& shape;
  std::vector<double> distance;
  std::vector<int> side;
  std::vector<Vec3> vertices;     // old ones, then the crossings
  std::map<Edge, int> crossings;  // by edge (low, high)
  std::vector<std::vector<int>> faces;

  bool on_plane(int v) const { return v >= static_cast<int>(side.size()) || side[v] == 0; }

  int crossing_on(int u, int v) {
    const auto [at, fresh] = crossings.try_emplace({std::min(u, v), std::max(u, v)}, static_cast<int>(vertices.size()));
    if (fresh) vertices.push_back(crossing(vertices[u], distance[u], vertices[v], distance[v]));
    return at->second;
  }

  std::vector<int> clip(const std::vector<int>& face) {
    std::vector<int> out;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int u = face[i], v = face[(i + 1) % face.size()];
      if (side[u] <= 0) out.push_back(u);
      if (side[u] * side[v] < 0) out.push_back(crossing_on(u, v));
    }
    return out;
  }

  /// Points on the plane closer than the tolerance become one, so that no edge is shorter than it.
  std::vector<int> welded(double tolerance) const {
    std::vector<int> to(vertices.size()), on;
    for (int v = 0; v < static_cast<int>(vertices.size()); ++v) {
      to[v] = v;
      if (!on_plane(v)) continue;
      const auto near = [&](int w) { return (vertices[w] - vertices[v]).squaredNorm() <= tolerance * tolerance; };
      const auto found = std::find_if(on.begin(), on.end(), near);
      if (found != on.end()) {
        to[v] = *found;
      } else {
        on.push_back(v);
      }
    }
    return to;
  }

  /// A face that lies wholly on the plane is dropped: the cap takes its place.
  void clip_all(double tolerance) {
    for (const auto& face : shape.faces) faces.push_back(clip(face));
    const std::vector<int> to = welded(tolerance);
    for (auto& face : faces) {
      for (int& v : face) v = to[v];
      drop_repeats(face);
    }
    std::erase_if(faces, [&](const std::vector<int>& face) {
      return face.size() < 3 || std::all_of(face.begin(), face.end(), [&](int v) { return on_plane(v); });
    });
  }

  /// The edges that the clipped faces leave without a partner bound the cap.
  void add_cap() {
    std::set<Edge> open;
    for (const auto& face : faces)
      for (std::size_t i = 0; i < face.size(); ++i) {
        const Edge edge{face[i], face[(i + 1) % face.size()]};
        if (open.erase({edge.second, edge.first}) == 0) open.insert(edge);
      }
    std::map<int, int> next;
    for (const Edge& edge : open) next[edge.second] = edge.first;
    while (!next.empty()) {
      std::vector<int> loop;
      auto node = next.extract(next.begin());
      while (node) {
        loop.push_back(node.key());
        node = next.extract(node.mapped());
      }
      drop_repeats(loop);
      if (loop.size() >= 3) faces.push_back(loop);
    }
  }

  Polyhedron result() const {
    Polyhedron out;
    std::vector<int> to(vertices.size(), -1);
    for (const auto& face : faces) {
      auto& loop = out.faces.emplace_back();
      for (int v : face) {
        if (to[v] < 0) {
          to[v] = static_cast<int>(out.vertices.size());
          out.vertices.push_back(vertices[v]);
        }
        loop.push_back(to[v]);
      }
    }
    return out;
  }
};

}  // namespace

Polyhedron cut(const Polyhedron& convex, const Plane& keep, double tolerance) {
  Cutter cutter{convex, {}, {}, convex.vertices, {}, {}};
  for (const Vec3& p : convex.vertices) {
    cutter.distance.push_back(keep.normal.dot(p) - keep.offset);
    cutter.side.push_back(side_of(cutter.distance.back(), tolerance));
  }
  if (std::find(cutter.side.begin(), cutter.side.end(), -1) == cutter.side.end()) return {};
  if (std::find(cutter.side.begin(), cutter.side.end(), 1) == cutter.side.end()) return convex;
  cutter.clip_all(tolerance);
  cutter.add_cap();
  if (cutter.faces.size() < 4) return {};
  return cutter.result();
}

Polygon cut(const Polygon& convex, const Plane& keep, double tolerance) {
  const std::size_t n = convex.size();
  Polygon out;
  out.reserve(n + 2);
  bool inside = false;
  double d = n ? keep.normal.dot(convex[0]) - keep.offset : 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& p = convex[i];
    const Vec3& q = convex[i + 1 < n ? i + 1 : 0];
    const double e = keep.normal.dot(q) - keep.offset;
    const int sp = side_of(d, tolerance), sq = side_of(e, tolerance);
    inside = inside || sp < 0;
    if (sp <= 0) out.push_back(p);
    if (sp * sq < 0) out.push_back(crossing(p, d, q, e));
    d = e;
  }
  if (!inside || out.size() < 3) out.clear();
  return out;
}

Polygon intersect(const Polygon& a, const Polygon& b, const Vec3& normal) {
  Polygon out = a;
  for (std::size_t i = 0; i < b.size() && !out.empty(); ++i) {
    const Vec3 outward = (b[(i + 1) % b.size()] - b[i]).cross(normal);
    const double length = outward.norm();
    if (length < 1e-12) continue;
    const Vec3 unit = outward / length;
    out = cut(out, Plane{unit, unit.dot(b[i])});
  }
  return out;
}

Polygon cleaned(const Polygon& polygon, double tolerance) {
  Polygon out = polygon;
  const auto superfluous = [&](std::size_t i) {
    const std::size_t n = out.size();
    const Vec3 in = out[i] - out[(i + n - 1) % n], chord = out[(i + 1) % n] - out[(i + n - 1) % n];
    if (in.norm() <= tolerance) return true;
    // Beside a repeated corner the chord says nothing; that corner goes first.
    if ((out[(i + 1) % n] - out[i]).norm() <= tolerance) return false;
    return in.cross(chord).norm() <= tolerance * chord.norm();
  };
  for (std::size_t unchanged = 0, i = 0; unchanged < out.size() && out.size() >= 3;) {
    if (superfluous(i)) {
      out.erase(out.begin() + static_cast<std::ptrdiff_t>(i));
      unchanged = 0;
    } else {
      ++unchanged, ++i;
    }
    if (i >= out.size()) i = 0;
  }
  if (out.size() < 3) out.clear();
  return out;
}

}  // namespace voussoir
