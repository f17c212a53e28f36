// Interface between the fill and the stones. Each overlap of a face of a stone with a triangle of the surface of the
// fill is a patch. One side is the rigid stone, and the other side deforms with the triangle (docs/theory/fill.md).
//
// The local axes (n, s, t) and the origin are fixed to the stone. The jump at a point p is Σ N_k(p) d_k. d_k is the
// displacement of corner k of the triangle in those axes since the patch was made, so that the jump is affine over the
// patch. The traction on the stone and the traction on the nodes both act at the point of the triangle. Force and
// moment therefore balance at any placement, and the work of the tractions is their work on the jump.
#pragma once
#include <vector>

#include "solver/model/model.h"

namespace voussoir {

/// Eight patches of one tile of bodies, one in each lane. Spare lanes repeat the last patch.
struct alignas(64) InterfaceBatch {
  PatchBatch patch;
  Lanes lever[3][3];  // m, of each corner from the patch's centroid, both in the reference placement
  Lanes rest[3][3];   // as InterfacePatch: its s, t give the shape functions, too
  Lanes point[2][2];  // m: s, t of the first two points; the others lie opposite, see moment_points()
  std::int32_t node[3][lane_count];
  std::int32_t sum[3][lane_count];  // positions at which the tile sums the forces on them
  std::int32_t tile = 0;
};

/// All patches in the order of their batches: lane i % lane_count of batch i / lane_count, spare lanes included (area
/// zero). A removed patch keeps its lane, without area, until a new interface is made.
struct Interface {
  std::vector<InterfacePatch> patches;
  Array<InterfaceBatch> batches;
  std::size_t point_rows = 0;                        // of tables of points, eight patches side by side
  std::vector<std::int32_t> first_batch;             // of each tile of bodies, and one past the end
  std::vector<std::int32_t> first_of_node, of_node;  // patches of each node: 3 × slot + corner
  // Each tile of bodies sums the forces of its patches on each node: first sum of each tile (and one past the end), and
  // the sums of each node.
  std::vector<std::int32_t> first_sum, first_sum_of_node, sum_of_node;
  bool empty() const { return batches.empty(); }
  std::size_t sum_count() const { return first_sum.empty() ? 0 : std::size_t(first_sum.back()); }
  bool used(std::size_t slot) const { return patches[slot].area > 0.0; }
  bool spare(std::size_t slot) const {
    return std::int32_t(slot % lane_count) >= batches[slot / lane_count].patch.count;
  }
  /// Index of number `c` of `columns` at point `i` of a patch.
  std::size_t point_index(std::size_t slot, std::size_t i, std::size_t columns, std::size_t c) const {
    const auto row = std::size_t(batches[slot / lane_count].patch.first_point) + i;
    return (row * columns + c) * lane_count + slot % lane_count;
  }
};

/// The patches of the assembly. Throws InputError for a patch without stiffness.
std::vector<InterfacePatch> interface_patches(const Assembly& assembly, const Model& model);
/// N_k = m(k, 0) + m(k, 1) s + m(k, 2) t: one at corner k of the triangle, zero at the others.
Mat3 shape_functions(const InterfacePatch& patch);
/// Patches as rows of numbers, for files, and back; spare lanes are left out. The order of the rows is that of the
/// slots, so that make_interface() finds it again.
constexpr int interface_columns = 29;
void flatten(const Interface& interface, Array<double>& rows, Array<double>& points, Array<double>& corners);
std::vector<InterfacePatch> unflatten(const Array<double>& rows, const Array<double>& points,
                                      const Array<double>& corners, const FillModel& fill);
/// Arranges patches in batches.
Interface make_interface(std::vector<InterfacePatch> patches, const Model& model);
/// Replaces a patch by one between the same stone and triangle with the same number of points.
void replace_patch(std::size_t slot, const InterfacePatch& patch, const Model& model, Interface& interface);
/// Removes a patch: sets its area to zero.
void empty_patch(std::size_t slot, const Model& model, Interface& interface);

}  // namespace voussoir
