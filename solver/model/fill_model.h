// The deformable fill in the layout of the time step. Nodes are ordered along a space-filling curve and divided into
// tiles. The tetrahedra of a tile are those whose first node in that order lies in it; eight of them are computed side
// by side. A tile sums the forces of its tetrahedra on their nodes, as tiles of bodies sum wrenches.
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

/// Eight tetrahedra of one material, one in each lane. Spare lanes repeat the last tetrahedron and exert no forces. The
/// shapes follow from the node positions; in single precision they are read (FillModel::shapes).
struct alignas(64) TetBatch {
  std::int32_t node[4][lane_count];
  std::int32_t sum[4][lane_count];  // positions at which the tile sums their nodal forces
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
  std::vector<FillLaw> laws;              // of the materials of the fill, for each construction step
  std::vector<std::int32_t> step_of_law;  // of the ConstructionPlan; 0 without a plan
  std::vector<Vec3> nodes;                // m, reference placement
  Array<double> place;                    // the same, node_width per node, the last zero
  std::vector<double> mass;               // kg, lumped
  std::vector<double> inertial;           // kg, differs from mass only in relaxations
  Array<double> weight;            // J, Σ κ V of the tetrahedra around a node: weights its mean volumetric strain
  std::vector<std::uint8_t> held;  // bit c: the velocity along axis c is prescribed
  std::vector<std::array<std::int32_t, 3>> triangles;  // the surface's nodes, in the order of FillMesh::triangles
  std::vector<std::int32_t> node_of;                   // of FillMesh::nodes
  std::vector<std::int32_t> mesh_node;                 // and back
  std::vector<std::int32_t> tet_of_lane;               // of FillMesh::tets; lane_count per batch, −1 in spare lanes
  std::vector<std::int32_t> lane_of_tet;
  Array<TetBatch> batches;
  Array<float> shapes;  // shape_rows of lanes per batch: gradients of corners 1 to 3 (x, y, z each, 1/m), volume (m3)
  std::vector<FillTile> tiles;
  // Sums of each node in the order of addition: first entry of each node (and one past the end), positions of the sums.
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

/// Throws InputError for a material that is not valid for a fill, or a tetrahedron without positive volume. `steps`:
/// the construction step of each tetrahedron; empty: all at once.
FillModel build_fill(const Assembly& assembly, const std::vector<std::int32_t>& steps = {});
/// Masses and weights of the nodes from the laws. Nodes without any present tetrahedron are held.
void lump(FillModel& fill);

}  // namespace voussoir
