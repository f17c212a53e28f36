#include "io/vtk/block_shape.h"

#include <algorithm>

#include "geometry/joints.h"

namespace voussoir {
namespace {

constexpr double kWeld = 1e-6;  // m: corners nearer than this are one

int weld(std::vector<Vec3>& vertices, const Vec3& point) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if ((vertices[i] - point).squaredNorm() < kWeld * kWeld) return int(i);
  vertices.push_back(point);
  return int(vertices.size()) - 1;
}

/// The loop with every vertex that lies inside one of its edges inserted there, in order along the edge.
std::vector<int> with_corners_on_edges(const std::vector<int>& loop, const std::vector<Vec3>& vertices) {
  std::vector<int> out;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const int from = loop[k], to = loop[(k + 1) % loop.size()];
    const Vec3 edge = vertices[to] - vertices[from];
    const double length = edge.norm();
    std::vector<std::pair<double, int>> between;
    for (int v = 0; v < int(vertices.size()); ++v) {
      if (v == from || v == to) continue;
      const Vec3 d = vertices[v] - vertices[from];
      const double along = d.dot(edge) / length;
      if (along > kWeld && along < length - kWeld && (d - edge * (along / length)).norm() < kWeld)
        between.push_back({along, v});
    }
    std::sort(between.begin(), between.end());
    out.push_back(from);
    for (const auto& [along, v] : between) out.push_back(v);
  }
  return out;
}

/// The vertex joined to `corner` by an edge that is not in `face`, or −1.
int neighbour_off_face(const Polyhedron& shape, int face, int corner) {
  const auto& base = shape.faces[face];
  for (const auto& loop : shape.faces)
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if (loop[k] != corner) continue;
      const int next = loop[(k + 1) % loop.size()];
      if (std::find(base.begin(), base.end(), next) == base.end()) return next;
    }
  return -1;
}

}  // namespace

Polyhedron outer_surface(const Block& block) {
  if (block.cells.size() == 1) return block.cells[0];
  Polyhedron shape;
  for (const Polygon& polygon : outer_faces(block)) {
    std::vector<int> loop;
    for (const Vec3& corner : polygon) {
      const int v = weld(shape.vertices, corner);
      if (loop.empty() || (loop.back() != v && loop.front() != v)) loop.push_back(v);
    }
    if (loop.size() >= 3) shape.faces.push_back(loop);
  }
  for (auto& loop : shape.faces) loop = with_corners_on_edges(loop, shape.vertices);
  return shape;
}

std::optional<std::array<int, 8>> hexahedron_order(const Polyhedron& shape) {
  if (shape.vertices.size() != 8 || shape.faces.size() != 6) return std::nullopt;
  for (const auto& loop : shape.faces)
    if (loop.size() != 4) return std::nullopt;
  std::array<int, 8> order{};
  for (int k = 0; k < 4; ++k) {
    order[k] = shape.faces[0][3 - k];  // outward loop reversed: seen from inside it turns counter-clockwise
    order[k + 4] = neighbour_off_face(shape, 0, order[k]);
    if (order[k + 4] < 0) return std::nullopt;
  }
  auto sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (int k = 0; k < 8; ++k)
    if (sorted[k] != k) return std::nullopt;
  return order;
}

}  // namespace voussoir
