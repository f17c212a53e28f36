#include "geometry/road.h"

#include <algorithm>
#include <map>

#include "geometry/joints.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr double looks_up = 0.5;    // least share of a face's normal that points upwards
constexpr double same_road = 0.02;  // m: a wall's top this far below the fill's still belongs to the road
constexpr const char* deck_group = "deck";

/// Area in plan, m2, and its moment.
struct InPlan {
  double area = 0.0;
  Vec3 centroid = Vec3::Zero();  // of the area in plan, which is that of the polygon: planes map evenly
};

InPlan in_plan(const Polygon& polygon) {
  return {polygon_area(polygon) * std::abs(polygon_normal(polygon).z()), polygon_centroid(polygon)};
}

Polygon within(const Polygon& polygon, const RoadArea& area) {
  const Plane sides[] = {
      {-Vec3::UnitX(), -area.x0}, {Vec3::UnitX(), area.x1}, {-Vec3::UnitY(), -area.y0}, {Vec3::UnitY(), area.y1}};
  Polygon inside = polygon;
  for (const Plane& side : sides)
    if (!inside.empty()) inside = cut(inside, side);
  return inside;
}

/// Values of the three linear shape functions of a triangle at a point of its plane.
Vec3 shape_functions(const std::array<Vec3, 3>& corner, const Vec3& at) {
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double whole = normal.squaredNorm();
  const double b = (at - corner[0]).cross(corner[2] - corner[0]).dot(normal) / whole;
  const double c = (corner[1] - corner[0]).cross(at - corner[0]).dot(normal) / whole;
  return {1.0 - b - c, b, c};
}

}  // namespace

void Road::add(Polygon polygon, std::int64_t block, std::int32_t triangle, double sign) {
  const Box box = bounding_box(polygon);
  pieces_.push_back({std::move(polygon), box, block, triangle, sign});
}

void Road::add_fill(const Assembly& assembly) {
  const FillMesh& fill = assembly.fill;
  std::vector<char> upper(fill.triangles.size(), 0);
  for (std::size_t i = 0; i < fill.triangles.size(); ++i) {
    Polygon corners;
    for (const std::int32_t node : fill.triangles[i]) corners.push_back(fill.nodes[std::size_t(node)]);
    upper[i] = polygon_normal(corners).z() > looks_up;
    if (upper[i]) add(corners, -1, std::int32_t(i), 1.0);
  }
  for (const FillJoint& joint : assembly.fill_joints)
    if (upper[std::size_t(joint.triangle)]) add(joint.polygon, -1, joint.triangle, -1.0);
}

/// Upper faces of blocks, without the parts below other blocks.
void Road::add_blocks(const Assembly& assembly, const std::vector<char>& wanted) {
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    if (!wanted[i]) continue;
    for (const Polygon& face : outer_faces(assembly.blocks[i]))
      if (polygon_normal(face).z() > looks_up) add(face, std::int64_t(i), -1, 1.0);
  }
  const auto covers = [&](const Polygon& polygon, const Vec3& out, std::int64_t block) {
    if (wanted[std::size_t(block)] && out.z() > looks_up) add(polygon, block, -1, -1.0);
  };
  for (const Joint& joint : assembly.joints) {
    covers(joint.polygon, joint.normal, joint.a);
    covers(joint.polygon, -joint.normal, joint.b);
  }
  for (const FillJoint& joint : assembly.fill_joints) covers(joint.polygon, joint.normal, joint.block);
}

/// z of the highest piece that lies at x, m, its plane continued across to the point.
double Road::height_at(const Vec3& point) const {
  double z = -1e300;
  for (const Piece& piece : pieces_)
    if (piece.sign > 0.0 && piece.box.low.x() <= point.x() && point.x() <= piece.box.high.x()) {
      const Vec3 normal = polygon_normal(piece.polygon), from = point - polygon_centroid(piece.polygon);
      z = std::max(z, point.z() - normal.dot(from) / normal.z());
    }
  return z;
}

/// Walls that reach up to the fill's top.
void Road::add_walls(const Assembly& assembly) {
  std::vector<char> wanted(assembly.blocks.size(), 0);
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    const bool wall = block.component == Component::spandrel || block.component == Component::backing;
    if (!wall || block.fixed) continue;
    for (const Polygon& face : outer_faces(block)) {
      if (polygon_normal(face).z() <= looks_up) continue;
      const Vec3 middle = polygon_centroid(face);
      if (middle.z() > height_at(middle) - same_road) wanted[i] = 1;
    }
  }
  add_blocks(assembly, wanted);
}

Road::Road(const Assembly& assembly) : assembly_(&assembly) {
  std::vector<char> wanted(assembly.blocks.size(), 0);
  const auto deck = assembly.groups.find(deck_group);
  bool any = !assembly.fill.empty();
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    if (assembly.blocks[i].component == Component::backfill) wanted[i] = 1, any = true;
  if (!any && deck != assembly.groups.end()) {
    for (const std::int64_t block : deck->second) wanted[std::size_t(block)] = 1;
    any = true;
  }
  if (!any)
    throw InputError(
        "there is no road: the assembly has neither a fill nor a group \"{}\". Set backfill = \"rigid\" or "
        "\"deformable\" in [bridge], or put the stones of the deck into this group when you import them.",
        deck_group);
  add_fill(assembly);
  add_blocks(assembly, wanted);
  // Faces below the road, such as fill that is visible below it, do not belong to it.
  std::vector<Piece> all = std::move(pieces_);
  pieces_.clear();
  for (const Piece& piece : all)
    if (piece.sign > 0.0) pieces_.push_back(piece);
  std::vector<Piece> kept;
  for (Piece& piece : all) {
    const Vec3 middle = polygon_centroid(piece.polygon);
    if (middle.z() > height_at(middle) - same_road) kept.push_back(std::move(piece));
  }
  pieces_ = std::move(kept);
  add_walls(assembly);
  Box box;
  for (const Piece& piece : pieces_)
    box.low = box.low.cwiseMin(piece.box.low), box.high = box.high.cwiseMax(piece.box.high);
  extent_ = {box.low.x(), box.high.x(), box.low.y(), box.high.y()};
}

RoadShare Road::under(const RoadArea& area) const {
  std::map<std::int64_t, RoadShare::OfBlock> blocks;
  std::map<std::int32_t, double> nodes;
  RoadShare share;
  for (const Piece& piece : pieces_) {
    if (piece.box.high.x() <= area.x0 || piece.box.low.x() >= area.x1 || piece.box.high.y() <= area.y0 ||
        piece.box.low.y() >= area.y1)
      continue;
    const Polygon inside = within(piece.polygon, area);
    if (inside.size() < 3) continue;
    const InPlan part = in_plan(inside);
    const double a = piece.sign * part.area;
    share.area += a;
    if (piece.block >= 0) {
      RoadShare::OfBlock& of = blocks[piece.block];
      of.block = piece.block, of.area += a, of.centre += a * part.centroid;
      continue;
    }
    const auto& triangle = assembly_->fill.triangles[std::size_t(piece.triangle)];
    std::array<Vec3, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = assembly_->fill.nodes[std::size_t(triangle[k])];
    const Vec3 n = shape_functions(corner, part.centroid);
    for (std::size_t k = 0; k < 3; ++k) nodes[triangle[k]] += a * n[Eigen::Index(k)];
  }
  constexpr double nothing = 1e-12;  // m2
  for (auto& [number, of] : blocks) {
    if (of.area <= nothing) continue;
    of.centre /= of.area;
    share.blocks.push_back(of);
  }
  for (const auto& [node, a] : nodes) share.nodes.push_back({node, a});
  return share;
}

}  // namespace voussoir
