// Stiffness of the fill and of its interface with the stones, from the same elements and points as the explicit time
// step.
#pragma once
#include "solver/linear/stiffness.h"

namespace voussoir {

/// A tetrahedron in its present placement: gradients of the shape functions, and reference volume.
struct FillElement {
  std::array<std::int32_t, 4> nodes = {};
  std::array<Vec3, 4> gradient;    // 1/m
  double volume = 0.0;             // m3
  double bulk = 0.0, shear = 0.0;  // κ, μ, Pa
};
/// Coupling of two corners of an element by 2 μ e:e with V μ = 1, from their gradients: 1/m2.
Mat3 shear_block(const Vec3& gi, const Vec3& gj);

/// Elements around a node, coupled by its mean volumetric strain: stiffness Σ pull pullᵀ/(4 weight) over the nodes of
/// the ring.
struct FillRing {
  std::vector<std::int32_t> nodes;  // ascending
  std::vector<Vec3> pull;           // N: Σ κ V ∇N
  double weight = 0.0;              // J: Σ κ V
};
/// The ring of each node.
std::vector<FillRing> fill_rings(const std::vector<FillElement>& elements, std::size_t nodes);

/// Stiffness blocks of a patch with the fill: between corners of its triangle, between corners (rows) and the stone,
/// and of the stone.
struct InterfaceStiffness {
  std::array<std::array<Mat3, 3>, 3> corners;
  std::array<Eigen::Matrix<double, 3, 6>, 3> across;
  Matrix6 own = Matrix6::Zero();
};
/// `corners`: Σ w N_i N_j D over the patch's points, world axes, N/m. `reach`: m, of the corners from the centroid of
/// the stone. A corner's jump is δu_i − δu_a − δθ × r_i = δu_i − G_i δ_a with G_i = (1, −[r_i]×).
InterfaceStiffness interface_stiffness(const std::array<std::array<Mat3, 3>, 3>& corners,
                                       const std::array<Vec3, 3>& reach);

using SitePairs = std::vector<std::pair<std::int32_t, std::int32_t>>;
/// Pairs of nodes that elements couple, as sites from `first` on. The mean volumetric strain about a node couples all
/// nodes of the elements around it.
void couple_nodes(const std::vector<std::array<std::int32_t, 4>>& elements, std::size_t nodes, std::int32_t first,
                  SitePairs& coupled);
/// Pairs of sites that the elements and the interface of the fill couple. Nodes of the fill are sites after the bodies.
void couple_fill(const Model& model, const State& state, SitePairs& coupled);
/// Adds the elastic stiffness in the present placement.
void add_fill(const Model& model, const State& state, BlockMatrix& k);
void add_interface(const Model& model, const State& state, PatchTangent kind, BlockMatrix& k);

}  // namespace voussoir
