#include "geometry/fill_joints.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/fill_mesh.h"
#include "geometry/neighbours.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr double kExact = 1e-9;  // m: gaps below this are rounding

struct Triangle {
  Polygon corners;
  Vec3 normal = Vec3::Zero(), centre = Vec3::Zero();  // out of the fill
  double area = 0.0;                                  // m2
};

struct Cell {
  std::int64_t block = 0;
  std::int32_t cell = 0;
};

/// The boxes of the broad phase: cells first, then triangles.
struct Scene {
  std::vector<Cell> cells;
  std::vector<Triangle> triangles;
  std::vector<Box> boxes;
};

Box joined(const Box& a, const Box& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

bool apart(const Box& a, const Box& b, double distance) {
  return ((b.low - a.high).array() > distance).any() || ((a.low - b.high).array() > distance).any();
}

Scene collect(const Assembly& assembly, double distance) {
  Scene scene;
  Box whole;
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < assembly.fill.triangles.size(); ++i) {
    Triangle t;
    t.corners = triangle_polygon(assembly.fill, std::int32_t(i));
    t.normal = polygon_normal(t.corners);
    t.centre = polygon_centroid(t.corners);
    t.area = polygon_area(t.corners);
    boxes.push_back(bounding_box(t.corners));
    whole = joined(whole, boxes.back());
    scene.triangles.push_back(std::move(t));
  }
  for (std::size_t b = 0; b < assembly.blocks.size(); ++b) {
    for (std::size_t c = 0; c < assembly.blocks[b].cells.size(); ++c) {
      const Box box = bounding_box(assembly.blocks[b].cells[c]);
      if (apart(box, whole, distance)) continue;
      scene.cells.push_back({std::int64_t(b), std::int32_t(c)});
      scene.boxes.push_back(box);
    }
  }
  scene.boxes.insert(scene.boxes.end(), boxes.begin(), boxes.end());
  return scene;
}

/// The part of a triangle that one face covers, and how far the face is from it there.
struct Overlay {
  Polygon polygon;  // counter-clockwise about the face's side, out of the stone
  double area = 0.0, gap = 0.0;
};

Overlay overlay(const Triangle& triangle, const Polygon& face, const Plane& plane) {
  const Vec3 normal = -triangle.normal;
  Polygon flat = face;
  for (Vec3& p : flat) p -= normal.dot(p - triangle.centre) * normal;
  Overlay out;
  out.polygon = cleaned(intersect(Polygon(triangle.corners.rbegin(), triangle.corners.rend()), flat, normal));
  if (out.polygon.empty()) return out;
  out.area = polygon_area(out.polygon);
  out.gap = plane.normal.dot(polygon_centroid(out.polygon)) - plane.offset;
  return out;
}

/// Convex cells and triangles touch in one plane; a tolerance may offer a second face, and the larger overlap is meant.
void search_pair(const Polyhedron& shape, const Triangle& triangle, const JointSearch& search, FillJoint& best,
                 double& gap) {
  for (int f = 0; f < int(shape.faces.size()); ++f) {
    const Plane plane = face_plane(shape, f);
    if ((plane.normal + triangle.normal).norm() > search.angle) continue;
    const double reach = search.gap + search.angle * std::sqrt(triangle.area) * 4.0;
    if (std::abs(plane.normal.dot(triangle.centre) - plane.offset) > reach) continue;
    Overlay found = overlay(triangle, face_polygon(shape, f), plane);
    if (found.area < search.smallest_area || std::abs(found.gap) > search.gap || found.area <= best.area) continue;
    best.face = f;
    best.polygon = std::move(found.polygon);
    best.normal = -triangle.normal;
    best.area = found.area;
    gap = found.gap;
  }
}

std::string point_text(const Vec3& p) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x(), p.y(), p.z());
}

/// No part of a triangle may be covered twice: patches on it add up to no more than its area.
void check_cover(const Assembly& assembly, const std::vector<Triangle>& triangles) {
  std::vector<double> covered(triangles.size(), 0.0);
  std::vector<std::int64_t> other(triangles.size(), -1);
  for (const FillJoint& joint : assembly.fill_joints) {
    const auto t = std::size_t(joint.triangle);
    covered[t] += joint.area;
    if (covered[t] > triangles[t].area * (1.0 + 1e-6) + 1e-7) {
      throw InputError(
          "{} and {} both cover the surface of the fill at {} m: the stones overlap each other, or one of them "
          "overlaps the fill. Move them apart.",
          block_label(assembly, other[t]), block_label(assembly, joint.block), point_text(triangles[t].centre));
    }
    other[t] = joint.block;
  }
}

void check_touch(const Assembly& assembly) {
  const FillMesh& fill = assembly.fill;
  const std::vector<std::int32_t> parts = fill_parts(fill);
  if (parts.empty()) return;
  std::vector<std::int32_t> part_of_node(fill.nodes.size(), 0);
  for (std::size_t i = 0; i < fill.tets.size(); ++i) {
    for (const std::int32_t k : fill.tets[i]) part_of_node[std::size_t(k)] = parts[i];
  }
  const auto count = std::size_t(*std::max_element(parts.begin(), parts.end())) + 1;
  std::vector<char> touches(count, 0);
  for (const FillJoint& joint : assembly.fill_joints) {
    const std::int32_t node = fill.triangles[std::size_t(joint.triangle)][0];
    touches[std::size_t(part_of_node[std::size_t(node)])] = 1;
  }
  const auto lost = std::find(touches.begin(), touches.end(), 0);
  if (lost == touches.end()) return;
  Box box;
  for (std::size_t i = 0; i < fill.nodes.size(); ++i) {
    if (part_of_node[i] != lost - touches.begin()) continue;
    box = joined(box, {fill.nodes[i], fill.nodes[i]});
  }
  throw InputError(
      "a part of the fill, from {} to {} m, does not touch the masonry: its surface is on no face of a stone. Check "
      "the unit (metres) and the place of the mesh, or raise the gap tolerance.",
      point_text(box.low), point_text(box.high));
}

void count(FillJointReport& report, const FillJoint& joint, double gap) {
  ++report.patches;
  report.covered += joint.area;
  if (std::abs(gap) <= kExact) return;
  ++report.closed_gaps;
  report.largest_closed_gap = std::max(report.largest_closed_gap, std::abs(gap));
}

}  // namespace

FillJointReport find_fill_joints(Assembly& assembly, const JointSearch& search) {
  assembly.fill_joints.clear();
  const Scene scene = collect(assembly, search.gap);
  FillJointReport report;
  for (const Triangle& triangle : scene.triangles) report.surface += triangle.area;
  const auto first = int(scene.cells.size());  // triangle in the list of boxes
  for (const auto& [i, j] : neighbours(scene.boxes, search.gap)) {
    if (i >= first || j < first) continue;
    const Cell& cell = scene.cells[std::size_t(i)];
    FillJoint joint;
    joint.block = cell.block;
    joint.cell = cell.cell;
    joint.triangle = std::int32_t(j - first);
    double gap = 0.0;
    search_pair(assembly.blocks[std::size_t(cell.block)].cells[std::size_t(cell.cell)],
                scene.triangles[std::size_t(joint.triangle)], search, joint, gap);
    if (joint.polygon.empty()) continue;
    count(report, joint, gap);
    assembly.fill_joints.push_back(std::move(joint));
  }
  std::sort(assembly.fill_joints.begin(), assembly.fill_joints.end(), [](const FillJoint& p, const FillJoint& q) {
    return std::tie(p.block, p.cell, p.face, p.triangle) < std::tie(q.block, q.cell, q.face, q.triangle);
  });
  check_cover(assembly, scene.triangles);
  check_touch(assembly);
  return report;
}

}  // namespace voussoir
