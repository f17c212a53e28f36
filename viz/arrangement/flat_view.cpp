#include "viz/arrangement/flat_view.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace voussoir {

namespace {

using FaceKey = std::tuple<std::int64_t, std::int32_t, std::int32_t>;  // block, cell, face

/// What joints and patches of the fill cover, m2.
struct Covered {
  std::map<FaceKey, double> faces;
  std::vector<double> triangles;
};

Covered covered_area(const Assembly& assembly, const std::vector<bool>& left_out) {
  Covered covered;
  covered.triangles.assign(assembly.fill.triangles.size(), 0.0);
  for (const Joint& j : assembly.joints) {
    if (assembly.laws[std::size_t(j.law)].kind == JointLaw::Kind::tie) continue;
    if (left_out[std::size_t(j.a)] || left_out[std::size_t(j.b)]) continue;
    covered.faces[{j.a, j.cell_a, j.face_a}] += j.area;
    covered.faces[{j.b, j.cell_b, j.face_b}] += j.area;
  }
  for (const FillJoint& j : assembly.fill_joints) {
    if (left_out[std::size_t(j.block)]) continue;
    covered.faces[{j.block, j.cell, j.face}] += j.area;
    covered.triangles[std::size_t(j.triangle)] += j.area;
  }
  return covered;
}

constexpr double nearly_all = 0.999;  // share of the area of a face; more counts as covered

/// The face in the axes of the sheet; none if it is turned away or seen edge-on.
std::optional<FlatFace> flattened(const Polygon& polygon, const SheetAxes& axes) {
  FlatFace face;
  face.normal = polygon_normal(polygon);
  const double towards = -face.normal.dot(axes.forward);
  if (!(towards > 1e-6)) return std::nullopt;
  for (const Vec3& x : polygon) face.corners.emplace_back(axes.u(x), axes.v(x), 0.0);
  // n·x = n·x0 with x = u right + v up + d forward.
  const double offset = face.normal.dot(polygon_centroid(polygon));
  face.depth = Vec3(face.normal.dot(axes.right), face.normal.dot(axes.up), -offset) / towards;
  return face;
}

/// Corners of the section of a convex cell by forward·x = place; points in the plane count as beyond it.
Polygon section_of(const Polyhedron& cell, const Vec3& forward, double place) {
  std::vector<bool> beyond(cell.vertices.size());
  bool any = false, all = true;
  for (std::size_t i = 0; i < cell.vertices.size(); ++i) {
    beyond[i] = forward.dot(cell.vertices[i]) - place >= -1e-9;
    any = any || beyond[i], all = all && beyond[i];
  }
  Polygon points;
  if (!any || all) return points;
  for (const std::vector<int>& loop : cell.faces)
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const auto a = std::size_t(loop[k]), b = std::size_t(loop[(k + 1) % loop.size()]);
      if (a > b || beyond[a] == beyond[b]) continue;  // each edge once
      const Vec3 &p = cell.vertices[a], &q = cell.vertices[b];
      const double dp = forward.dot(p) - place, dq = forward.dot(q) - place;
      points.push_back(p + std::clamp(dp / (dp - dq), 0.0, 1.0) * (q - p));
    }
  return points;
}

/// Sorts the corners of a convex polygon counter-clockwise and removes repeated ones.
Polygon sorted_corners(Polygon points) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : points) middle += p / double(points.size());
  std::sort(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
    return std::atan2(a.y() - middle.y(), a.x() - middle.x()) < std::atan2(b.y() - middle.y(), b.x() - middle.x());
  });
  return cleaned(points);
}

std::optional<FlatFace> cut_face(const Polyhedron& cell, const SheetAxes& axes, double place) {
  const Polygon points = section_of(cell, axes.forward, place);
  if (points.size() < 3) return std::nullopt;
  FlatFace face;
  for (const Vec3& x : points) face.corners.emplace_back(axes.u(x), axes.v(x), 0.0);
  face.corners = sorted_corners(face.corners);
  if (face.corners.size() < 3) return std::nullopt;
  face.depth = Vec3(0.0, 0.0, place);
  face.normal = -axes.forward;
  face.cut = true;
  return face;
}

Polyhedron tetrahedron(const FillMesh& fill, const std::array<std::int32_t, 4>& tet) {
  Polyhedron cell;
  for (const std::int32_t n : tet) cell.vertices.push_back(fill.nodes[std::size_t(n)]);
  cell.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return cell;
}

void take_over(FlatFace& face, const Block& block, std::size_t number) {
  face.component = block.component, face.part = block.part;
  face.block = std::int64_t(number), face.fixed = block.fixed;
}

/// The part of a polygon that a section shows.
Polygon beyond(const Polygon& polygon, const SheetAxes& axes, const std::optional<ViewCut>& section) {
  if (!section) return polygon;
  if (std::ranges::all_of(polygon, [&](const Vec3& x) { return axes.forward.dot(x) > section->to; })) return {};
  return cut(polygon, Plane{-axes.forward, -section->place}, 1e-9);
}

}  // namespace

SheetAxes seen_from_front() {
  return {};
}

SheetAxes seen_from_behind() {
  return {-Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY()};
}

SheetAxes seen_from_above() {
  return {Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitZ()};
}

SheetAxes seen_from_left() {
  return {-Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
}

std::vector<FlatFace> cut_faces(const Assembly& assembly, const SheetAxes& axes, double place) {
  std::vector<FlatFace> faces;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    for (const Polyhedron& cell : assembly.blocks[i].cells)
      if (auto face = cut_face(cell, axes, place)) {
        take_over(*face, assembly.blocks[i], i);
        faces.push_back(std::move(*face));
      }
  for (const auto& tet : assembly.fill.tets)
    if (auto face = cut_face(tetrahedron(assembly.fill, tet), axes, place)) {
      face->component = Component::backfill;
      faces.push_back(std::move(*face));
    }
  return faces;
}

FlatView flat_view(const Assembly& assembly, const SheetAxes& axes, const std::optional<ViewCut>& section,
                   const std::vector<std::int64_t>& without) {
  std::vector<bool> left_out(assembly.blocks.size(), false);
  for (const std::int64_t block : without) left_out[std::size_t(block)] = true;
  const Covered covered = covered_area(assembly, left_out);
  FlatView view{axes, {}};
  const auto add = [&](const Polygon& whole, double under, const auto& take_over_from) {
    if (under > 0.0 && under > nearly_all * polygon_area(whole)) return;
    const Polygon left = beyond(whole, axes, section);
    if (left.size() < 3) return;
    if (auto face = flattened(left, axes)) {
      take_over_from(*face);
      view.faces.push_back(std::move(*face));
    }
  };
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    if (left_out[i]) continue;
    const Block& block = assembly.blocks[i];
    for (std::size_t c = 0; c < block.cells.size(); ++c)
      for (std::size_t f = 0; f < block.cells[c].faces.size(); ++f) {
        const auto under = covered.faces.find({std::int64_t(i), std::int32_t(c), std::int32_t(f)});
        add(face_polygon(block.cells[c], int(f)), under == covered.faces.end() ? 0.0 : under->second,
            [&](FlatFace& face) { take_over(face, block, i); });
      }
  }
  for (std::size_t t = 0; t < assembly.fill.triangles.size(); ++t) {
    Polygon whole;
    for (const std::int32_t n : assembly.fill.triangles[t]) whole.push_back(assembly.fill.nodes[std::size_t(n)]);
    add(whole, covered.triangles[t], [](FlatFace& face) { face.component = Component::backfill; });
  }
  if (section)
    for (FlatFace& face : cut_faces(assembly, axes, section->place))
      if (face.block < 0 || !left_out[std::size_t(face.block)]) view.faces.push_back(std::move(face));
  return view;
}

Box extent_of(const std::vector<FlatFace>& faces) {
  if (faces.empty()) return {Vec3::Zero(), Vec3::Zero()};
  Box box;
  for (const FlatFace& face : faces) {
    const Box own = bounding_box(face.corners);
    box.low = box.low.cwiseMin(own.low), box.high = box.high.cwiseMax(own.high);
  }
  return box;
}

bool holds(const FlatFace& face, const Vec3& at) {
  for (std::size_t i = 0; i < face.corners.size(); ++i) {
    const Vec3 &a = face.corners[i], &b = face.corners[(i + 1) % face.corners.size()];
    const Vec3 side = b - a, to = at - a;
    if (side.x() * to.y() - side.y() * to.x() < -1e-12) return false;
  }
  return true;
}

}  // namespace voussoir
