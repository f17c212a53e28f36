// Stiffness of the fill and of its interface with the stones, from the same elements and points as the explicit step.
#pragma once
#include "solver/linear/stiffness.h"

namespace voussoir {

/// A tetrahedron where it is: gradients of the shape functions in the present placement, reference volume.
struct FillElement {
  std::array<std::int32_t, 4> nodes = {};
  std::array<Vec3, 4> gradient;    // 1/m
  double volume = 0.0;             // m3
  double bulk = 0.0, shear = 0.0;  // κ, μ, Pa
};
/// What 2 μ e:e of an element with V μ = 1 couples two of its corners by, given their gradients: 1/m2.
Mat3 shear_block(const Vec3& gi, const Vec3& gj);

/// Elements about a node through its mean volumetric strain: stiffness Σ pull pullᵀ/(4 weight) over the ring's nodes.
struct FillRing {
  std::vector<std::int32_t> nodes;  // ascending
  std::vector<Vec3> pull;           // N: Σ κ V ∇N
  double weight = 0.0;              // J: Σ κ V
};
/// Of each node.
std::vector<FillRing> fill_rings(const std::vector<FillElement>& elements, std::size_t nodes);

/// What a patch with the fill couples: corner with corner of its triangle, corners (rows) with the stone, and the stone
/// with itself.
struct InterfaceStiffness {
  std::array<std::array<Mat3, 3>, 3> corners;
  std::array<Eigen::Matrix<double, 3, 6>, 3> across;
  Matrix6 own = Matrix6::Zero();
};
/// `corners`: Σ w N_i N_j D over the patch's points, world axes, N/m. `reach`: m, of the corners from the stone's
/// centroid. A corner's jump is δu_i − δu_a − δθ × r_i = δu_i − G_i δ_a with G_i = (1, −[r_i]×).
InterfaceStiffness interface_stiffness(const std::array<std::array<Mat3, 3>, 3>& corners,
                                       const std::array<Vec3, 3>& reach);

using SitePairs = std::vector<std::pair<std::int32_t, std::int32_t>>;
/// Pairs of nodes that elements couple, as sites from `first` on: through the mean volumetric strain about a node all
/// nodes of the elements around it know of each other.
void couple_nodes(const std::vector<std::array<std::int32_t, 4>>& elements, std::size_t nodes, std::int32_t first,
                  SitePairs& coupled);
/// Pairs of sites that the fill's elements and interface couple. Nodes of the fill are sites after the bodies.
void couple_fill(const Model& model, const State& state, SitePairs& coupled);
/// Elastic, at the present placement.
void add_fill(const Model& model, const State& state, BlockMatrix& k);
void add_interface(const Model& model, const State& state, PatchTangent kind, BlockMatrix& k);

}  // namespace voussoir
