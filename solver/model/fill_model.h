// The deformable fill as the step sees it: nodes ordered along a space-filling curve and cut into tiles; the tetrahedra
// of a tile are those whose first node in that order lies in it, eight of them side by side. A tile adds up what its
// tetrahedra put on their nodes, as tiles of bodies do with wrenches.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/assembly.h"
#include "solver/base/arrays.h"
#include "solver/base/lanes.h"
#include "solver/model/fill_law.h"

namespace voussoir {

constexpr int node_width = 4;

/// Eight tetrahedra of one material, a lane each; further lanes repeat the last one and put nothing on its nodes. Their
/// shapes follow from where the nodes are; in single precision they are read (FillModel::shapes).
struct alignas(64) TetBatch {
  std::int32_t node[4][lane_count];
  std::int32_t sum[4][lane_count];  // where the tile adds up what they put on their nodes
  std::int32_t count = 0;
  std::int32_t law = 0;
};

constexpr int shape_rows = 10;

struct FillTile {
  std::int32_t first_node = 0, end_node = 0;
  std::int32_t first_batch = 0, end_batch = 0;
  std::int32_t first_sum = 0, end_sum = 0;  // its nodes in order, then nodes of later tiles that its tetrahedra touch
  std::vector<std::int32_t> followers;      // those later tiles
};
constexpr std::int32_t tile_nodes = 128;

struct FillModel {
  std::vector<FillLaw> laws;  // of the assembly's materials that the fill is made of, for each step of building
  std::vector<std::int32_t> step_of_law;  // of the ConstructionPlan; 0 without any
  std::vector<Vec3> nodes;                // m, reference placement
  Array<double> place;                    // the same, node_width a node, the last zero
  std::vector<double> mass;               // kg, lumped
  std::vector<double> inertial;           // kg, differs from mass only in relaxations
  Array<double> weight;            // J, Σ κ V of the tetrahedra around a node: weights its mean volumetric strain
  std::vector<std::uint8_t> held;  // bit c: displacement c keeps the velocity it has
  std::vector<std::array<std::int32_t, 3>> triangles;  // the surface's nodes, in the order of FillMesh::triangles
  std::vector<std::int32_t> node_of;                   // of FillMesh::nodes
  std::vector<std::int32_t> mesh_node;                 // and back
  std::vector<std::int32_t> tet_of_lane;               // of FillMesh::tets; lane_count a batch, −1 in spare lanes
  std::vector<std::int32_t> lane_of_tet;
  Array<TetBatch> batches;
  Array<float> shapes;  // shape_rows of lanes a batch: gradients of corners 1 to 3 (x, y, z each, 1/m), volume (m3)
  std::vector<FillTile> tiles;
  // Sums of each node in the order they are added up: first of each node (and one past the end), places of the sums.
  std::vector<std::int32_t> first_sum, sums;
  std::size_t sum_count() const { return tiles.empty() ? 0 : std::size_t(tiles.back().end_sum); }
  bool empty() const { return nodes.empty(); }
  const FillLaw& law_of(std::size_t batch) const { return laws[std::size_t(batches[batch].law)]; }
};

/// One tetrahedron in the reference placement.
struct TetShape {
  std::array<std::int32_t, 4> nodes = {};
  std::array<Vec3, 4> gradient;  // 1/m: of the shape functions
  double volume = 0.0;           // m3
};
TetShape tet_shape(const std::array<std::int32_t, 4>& corners, const std::vector<Vec3>& nodes);
TetShape tet_shape(const FillModel& fill, std::size_t batch, int lane);

/// Throws InputError for a material that cannot be one of a fill, or a tetrahedron without positive volume.
/// `steps`: in which step of building each tetrahedron comes; empty: all at once.
FillModel build_fill(const Assembly& assembly, const std::vector<std::int32_t>& steps = {});
/// Masses and weights of the nodes from the laws. Nodes that nothing is there of are held.
void lump(FillModel& fill);

}  // namespace voussoir
