// The road of a bridge: the uppermost faces between the parapets, and the blocks and nodes below a pressure on it.
#pragma once
#include "geometry/assembly.h"
#include "geometry/road_area.h"

namespace voussoir {

/// The shares of blocks and nodes in a rectangle of the road. A downward pressure p in plan gives the force p A on a
/// block, at `centre`, and p times `area` on a node (∫ N dA, consistent with linear tetrahedra). For any mesh the sum
/// and the moment of these forces are those of the pressure.
struct RoadShare {
  struct OfBlock {
    std::int64_t block = 0;
    double area = 0.0;           // m2 in plan
    Vec3 centre = Vec3::Zero();  // m
  };
  struct OfNode {
    std::int32_t node = 0;  // of FillMesh::nodes
    double area = 0.0;      // m2 in plan
  };
  std::vector<OfBlock> blocks;  // ascending
  std::vector<OfNode> nodes;    // ascending
  double area = 0.0;            // m2 in plan, of both
};

/// The assembly must outlive this object.
class Road {
 public:
  /// Finds the road: the open upper faces of the fill or of its blocks, and of walls of the same height; without a fill
  /// the upper faces of the group "deck". Throws InputError if there is neither.
  explicit Road(const Assembly& assembly);

  RoadArea extent() const { return extent_; }
  /// The shares in a rectangle; the parts of it beyond the road do not count.
  RoadShare under(const RoadArea& area) const;

 private:
  /// A part of the road, or a face that covers a part (with a negative sign).
  struct Piece {
    Polygon polygon;
    Box box;
    std::int64_t block = -1;  // −1: the piece is a triangle of the surface of the fill
    std::int32_t triangle = -1;
    double sign = 1.0;
  };
  void add(Polygon polygon, std::int64_t block, std::int32_t triangle, double sign);
  void add_fill(const Assembly& assembly);
  void add_blocks(const Assembly& assembly, const std::vector<char>& wanted);
  void add_walls(const Assembly& assembly);
  double height_at(const Vec3& point) const;

  const Assembly* assembly_;
  std::vector<Piece> pieces_;
  RoadArea extent_;
};

}  // namespace voussoir
