#include "geometry/fill_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr double kFlat = 1e-6;  // of its longest edge: a lower tetrahedron is flat

using Triple = std::array<std::int32_t, 3>;

/// Faces of a tetrahedron, counter-clockwise seen from outside; face i lies across corner i.
constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

struct Tet {
  Vec3 x[4];
  double volume() const { return (x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0])) / 6.0; }
  Vec3 centroid() const { return 0.25 * (x[0] + x[1] + x[2] + x[3]); }
  /// Outward, as long as twice the face's area.
  Vec3 face(int i) const {
    const auto& f = kFaces[i];
    return (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]);
  }
  double largest_face() const {
    double largest = 0.0;
    for (int i = 0; i < 4; ++i) largest = std::max(largest, 0.5 * face(i).norm());
    return largest;
  }
  std::pair<double, double> edges() const {  // shortest and longest
    double low = 1e300, high = 0.0;
    for (const auto& e : kEdges) {
      const double length = (x[e[1]] - x[e[0]]).norm();
      low = std::min(low, length), high = std::max(high, length);
    }
    return {low, high};
  }
  double height() const { return 3.0 * volume() / largest_face(); }  // the smallest
  double smallest_angle() const {
    double largest = -1.0;
    for (const auto& e : kEdges) {
      const double cosine = -face(e[0]).normalized().dot(face(e[1]).normalized());
      largest = std::max(largest, cosine);
    }
    return std::acos(std::clamp(largest, -1.0, 1.0));
  }
};

Tet tet_at(const FillMesh& mesh, std::size_t i) {
  Tet tet;
  for (std::size_t k = 0; k < 4; ++k) tet.x[k] = mesh.nodes[std::size_t(mesh.tets[i][k])];
  return tet;
}

std::string place(const Vec3& p) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f}) m", p.x(), p.y(), p.z());
}

std::string place(const FillMesh& mesh, std::size_t tet) {
  return place(tet_at(mesh, tet).centroid());
}

/// A face of one tetrahedron: its nodes sorted, which finds its twin, and as they stand.
struct Face {
  Triple key, nodes;
  std::int32_t tet = 0;
};

Triple lowest_first(Triple t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// All faces of all tetrahedra, sorted so that faces with equal nodes follow each other.
std::vector<Face> sorted_faces(const FillMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(4 * mesh.tets.size());
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    for (const auto& f : kFaces) {
      const auto& t = mesh.tets[i];
      Face face = {
          {}, lowest_first({t[std::size_t(f[0])], t[std::size_t(f[1])], t[std::size_t(f[2])]}), std::int32_t(i)};
      face.key = face.nodes;
      std::sort(face.key.begin(), face.key.end());
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end(),
            [](const Face& p, const Face& q) { return std::tie(p.key, p.tet) < std::tie(q.key, q.tet); });
  return faces;
}

void check_nodes(const FillMesh& mesh, const std::string& what) {
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vec3& p = mesh.nodes[i];
    if (!p.allFinite()) {
      throw InputError("{}: node {} is at ({}, {}, {}). Coordinates must be finite numbers in m. Mesh it again.", what,
                       i, p.x(), p.y(), p.z());
    }
  }
  std::vector<char> used(mesh.nodes.size(), 0);
  const auto n = std::int32_t(mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    for (const std::int32_t k : mesh.tets[i]) {
      if (k < 0 || k >= n) {
        throw InputError("{}: tetrahedron {} has the node {}, but nodes count from 0 to {}", what, i, k, n - 1);
      }
      used[std::size_t(k)] = 1;
    }
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused == used.end()) return;
  const auto i = std::size_t(unused - used.begin());
  throw InputError("{}: node {} at {} belongs to no tetrahedron, so nothing would hold it. Leave it out.", what, i,
                   place(mesh.nodes[i]));
}

void check_shapes(const FillMesh& mesh, const std::string& what) {
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet tet = tet_at(mesh, i);
    const double volume = tet.volume(), longest = tet.edges().second;
    if (std::abs(volume) * 3.0 <= kFlat * longest * tet.largest_face()) {
      throw InputError(
          "{}: tetrahedron {} at {} is flat: its longest edge is {:.3g} m and its height {:.3g} m. The height must be "
          "more than {:g} of that edge. Mesh it again with shorter edges at this place.",
          what, i, place(tet.centroid()), longest, tet.largest_face() > 0.0 ? tet.height() : 0.0, kFlat);
    }
    if (volume < 0.0) {
      throw InputError(
          "{}: tetrahedron {} at {} is inverted: its volume is {:.3g} m3. It must be above 0. Exchange two of its "
          "nodes.",
          what, i, place(tet.centroid()), volume);
    }
  }
}

void check_faces(const FillMesh& mesh, const std::string& what) {
  const std::vector<Face> faces = sorted_faces(mesh);
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
    const Face &p = faces[i], &q = faces[i + 1];
    if (p.key != q.key) continue;
    const auto tets = [&] {
      return fmt::format("tetrahedra {} at {} and {} at {}", p.tet, place(mesh, std::size_t(p.tet)), q.tet,
                         place(mesh, std::size_t(q.tet)));
    };
    if (i + 2 < faces.size() && faces[i + 2].key == p.key) {
      throw InputError(
          "{}: the face of nodes {}, {} and {} is shared by {} and a further one, {}. At most two may share a face. "
          "Mesh it again.",
          what, p.key[0], p.key[1], p.key[2], tets(), faces[i + 2].tet);
    }
    // Seen from outside one and the other a shared face runs opposite ways round.
    if (p.nodes == q.nodes) {
      throw InputError("{}: {} overlap: they are on the same side of the face they share. Mesh it again.", what,
                       tets());
    }
  }
}

/// The faces that belong to one tetrahedron only, sorted by their nodes.
std::vector<Face> surface_faces(const FillMesh& mesh) {
  const std::vector<Face> faces = sorted_faces(mesh);
  std::vector<Face> surface;
  for (std::size_t i = 0, next; i < faces.size(); i = next) {
    for (next = i + 1; next < faces.size() && faces[next].key == faces[i].key;) ++next;
    if (next == i + 1) surface.push_back(faces[i]);
  }
  std::sort(surface.begin(), surface.end(), [](const Face& p, const Face& q) { return p.nodes < q.nodes; });
  return surface;
}

}  // namespace

void orient_tets(FillMesh& mesh) {
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    if (tet_at(mesh, i).volume() < 0.0) std::swap(mesh.tets[i][2], mesh.tets[i][3]);
  }
}

void find_surface(FillMesh& mesh) {
  mesh.triangles.clear();
  for (const Face& face : surface_faces(mesh)) mesh.triangles.push_back(face.nodes);
}

std::vector<std::int32_t> triangle_tets(const FillMesh& mesh) {
  std::map<Triple, std::int32_t> tets;
  for (const Face& face : surface_faces(mesh)) tets[face.nodes] = face.tet;
  std::vector<std::int32_t> out;
  for (const Triple& triangle : mesh.triangles) out.push_back(tets.at(lowest_first(triangle)));
  return out;
}

void check_fill(const FillMesh& mesh, const std::string& what) {
  check_nodes(mesh, what);
  check_shapes(mesh, what);
  check_faces(mesh, what);
}

void check_volume(const FillMesh& mesh, double expected) {
  const double volume = fill_volume(mesh);
  if (std::abs(volume - expected) <= 1e-3 * expected) return;
  throw InputError(
      "the mesh of the fill has a volume of {:.6g} m3, but the space for it has {:.6g} m3. They may differ by 0.1 %. "
      "Choose a smaller fill_edge, or backfill = \"rigid\".",
      volume, expected);
}

double fill_volume(const FillMesh& mesh) {
  double volume = 0.0;
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) volume += tet_at(mesh, i).volume();
  return volume;
}

FillQuality fill_quality(const FillMesh& mesh) {
  FillQuality q;
  q.shortest_edge = q.smallest_angle = q.smallest_height = 1e300;
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet tet = tet_at(mesh, i);
    const auto [shortest, longest] = tet.edges();
    q.volume += tet.volume();
    q.shortest_edge = std::min(q.shortest_edge, shortest);
    q.longest_edge = std::max(q.longest_edge, longest);
    q.edge_ratio = std::max(q.edge_ratio, longest / shortest);
    q.smallest_angle = std::min(q.smallest_angle, tet.smallest_angle());
    if (const double height = tet.height(); height < q.smallest_height) {
      q.smallest_height = height;
      q.lowest = tet.centroid();
    }
  }
  return mesh.empty() ? FillQuality{} : q;
}

Polygon triangle_polygon(const FillMesh& mesh, std::int32_t triangle) {
  Polygon polygon;
  for (const std::int32_t k : mesh.triangles[std::size_t(triangle)]) polygon.push_back(mesh.nodes[std::size_t(k)]);
  return polygon;
}

std::vector<std::int32_t> fill_parts(const FillMesh& mesh) {
  std::vector<std::int32_t> root(mesh.nodes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t i) {
    while (root[std::size_t(i)] != i) i = root[std::size_t(i)] = root[std::size_t(root[std::size_t(i)])];
    return i;
  };
  for (const auto& tet : mesh.tets) {
    for (std::size_t k = 1; k < 4; ++k) {
      const std::int32_t a = find(tet[0]), b = find(tet[k]);
      root[std::size_t(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<std::int32_t> number(mesh.nodes.size(), -1), parts;
  std::int32_t count = 0;
  for (const auto& tet : mesh.tets) {
    std::int32_t& part = number[std::size_t(find(tet[0]))];
    if (part < 0) part = count++;
    parts.push_back(part);
  }
  return parts;
}

}  // namespace voussoir
