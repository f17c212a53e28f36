// Outer surface of the stones, for pictures and for the test of the coverage of joints.
#include <cmath>

#include "geometry/joints.h"

namespace voussoir {
namespace {

constexpr double k_angle = 1e-3;    // rad: faces of sibling cells that are this near to opposed share a plane
constexpr double k_sliver = 1e-12;  // m2

struct CellFace {
  Polygon polygon;
  Vec3 normal, centre;
};

CellFace make_cell_face(const Polyhedron& cell, int face) {
  CellFace out{face_polygon(cell, face), {}, {}};
  out.normal = polygon_normal(out.polygon);
  out.centre = polygon_centroid(out.polygon);
  return out;
}

/// Appends the part of a convex polygon outside another one in the same plane to `out`, as convex pieces.
void subtract(const Polygon& from, const CellFace& hole, std::vector<Polygon>& out) {
  std::vector<Polygon> pieces;
  Polygon inside = from;
  const std::size_t n = hole.polygon.size();
  for (std::size_t i = 0; i < n && !inside.empty(); ++i) {
    const Vec3& p = hole.polygon[i];
    // The hole's face looks the other way, but out of the hole is out of the hole.
    const Vec3 outward = (hole.polygon[(i + 1) % n] - p).cross(hole.normal);
    if (outward.norm() < 1e-12) continue;
    const Vec3 unit = outward.normalized();
    Polygon outside = cut(inside, Plane{-unit, -unit.dot(p)});
    if (!outside.empty() && polygon_area(outside) > k_sliver) pieces.push_back(std::move(outside));
    inside = cut(inside, Plane{unit, unit.dot(p)});
  }
  if (inside.empty() || polygon_area(inside) <= k_sliver) pieces = {from};  // no overlap: keep it in one piece
  for (Polygon& piece : pieces) out.push_back(std::move(piece));
}

bool shared(const CellFace& face, const CellFace& other, double gap) {
  return (face.normal + other.normal).norm() <= k_angle && std::abs(face.normal.dot(other.centre - face.centre)) <= gap;
}

}  // namespace

std::vector<Polygon> outer_faces(const Block& block, double gap) {
  std::vector<std::vector<CellFace>> cells;
  for (const Polyhedron& cell : block.cells) {
    auto& faces = cells.emplace_back();
    for (std::size_t f = 0; f < cell.faces.size(); ++f) faces.push_back(make_cell_face(cell, static_cast<int>(f)));
  }
  std::vector<Polygon> out;
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const CellFace& face : cells[c]) {
      std::vector<Polygon> pieces = {face.polygon};
      for (std::size_t d = 0; d < cells.size(); ++d)
        for (const CellFace& other : cells[d]) {
          if (d == c || !shared(face, other, gap)) continue;
          std::vector<Polygon> left;
          for (const Polygon& piece : pieces) subtract(piece, other, left);
          pieces = std::move(left);
        }
      for (Polygon& piece : pieces) out.push_back(std::move(piece));
    }
  return out;
}

double covered_area(const Assembly& assembly) {
  double sum = 0.0;
  for (const Joint& joint : assembly.joints) sum += joint.area;
  return sum;
}

double uncovered_surface(const Assembly& assembly) {
  double sum = 0.0;
  for (const Block& block : assembly.blocks)
    for (const Polygon& polygon : outer_faces(block)) sum += polygon_area(polygon);
  for (const FillJoint& joint : assembly.fill_joints) sum -= joint.area;
  return sum - 2.0 * covered_area(assembly);
}

}  // namespace voussoir
