// A time step of the fill, in two rounds over its tiles (docs/theory/fill.md).
//
// Round 1: elastic volumetric strain of the tetrahedra, then its mean about each node.
// Round 2: stresses and nodal forces, then the nodes move.
//
// The strain is total: the deformation gradient of a tetrahedron is F = 1 + Σ u ∇N from the reference placement. With
// the plastic memory Cp⁻¹ the elastic left Cauchy–Green tensor is b = F Cp⁻¹ Fᵀ, and e = dev ½ ln b is the elastic
// strain, so that rotations of any size are exact and no stress is accumulated (Simo 1992; de Souza Neto, Perić & Owen
// 2008, ch. 14). The elastic volumetric strain θ = ϑ(J) − θp of a tetrahedron (J = det F, θp the plastic volumetric
// strain) is replaced by the mean of its nodes' means, because elements would otherwise lock in plastic flow at
// constant volume (average nodal pressure: Bonet & Burton 1998; nodal mixed discretisation: Detournay & Dzik 2006). The
// mean is taken of the elastic part, not of the total strain. Otherwise neighbours that dilate would drift apart, and
// tensile opening would return energy.
#pragma once
#include "solver/model/branches.h"
#include "solver/model/fill_memory.h"

namespace voussoir {

struct FillReport {
  std::int32_t inverted = -1;  // lowest tetrahedron (of FillMesh::tets) that has lost its volume
  std::int32_t runaway = -1;   // lowest node (of FillMesh::nodes) whose velocity is not finite or exceeds the limit
  std::int64_t yielding = 0;   // tetrahedra that flow
  bool search = false;         // a node has moved far enough for a new contact search
  void merge(const FillReport& other);
};

struct FillEnergy {
  double elastic = 0.0, branches = 0.0;  // J
};

/// Out-of-balance force on a node (N) and the velocity that follows (m/s); the fourth number is not used.
struct NodeUpdate {
  Quad force, velocity;
};

struct FillPass {
  const FillModel* fill = nullptr;
  FillMemory* memory = nullptr;
  Branches branches;
  double* sums = nullptr;         // node_width × FillModel::sum_count(): forces
  double* volume_sums = nullptr;  // FillModel::sum_count(): κ V θ, J
  // Forces from outside, N: node_width for each slot, and the slots of each node; null: none.
  const double* outside = nullptr;
  const std::vector<std::int32_t>*first_of_node = nullptr, *of_node = nullptr;
  FillEnergy* energies = nullptr;                           // of each tile, or null
  Vec3 gravity = Vec3::Zero();                              // m/s2
  double dt = 0.0;                                          // s
  double mass_rate = 0.0;                                   // 1/s, Rayleigh
  double local = 0.0;                                       // coefficient of local damping (Cundall)
  bool loaded = false;                                      // whether the following loads act in addition to gravity
  const double *loads_from = nullptr, *loads_to = nullptr;  // N, node_width for each node, in addition to gravity; or
                                                            // null
  Vec3 load_acceleration = Vec3::Zero();                    // m/s2, of all nodes, in addition to gravity, at this time
                                                            // step
  double load_share = 1.0;                                  // share between the two loads, at this time step
  double search_distance = 1e300;  // m: a node that has moved farther since FillMemory::searched requires a search
  Vec3 base_displacement = Vec3::Zero();  // m, at the end of the time step
  Vec3 base_velocity = Vec3::Zero();      // m/s, mean of those at the half steps before and after
  bool averaged = true;                   // false: standard tetrahedra, which lock; for comparison
  bool single = false;                    // strain and stress in single precision, for time steps of an earthquake

  /// Round 1: sums κ V θ of the tetrahedra of a tile about their nodes. It does nothing without `averaged`.
  void volumes(std::size_t tile) const;
  /// The mean about each node of a tile (fourth number of FillMemory::pose). Call it when volumes() of this tile and of
  /// the tiles that share its nodes are done.
  void means(std::size_t tile) const;
  /// Round 2: stresses of the tetrahedra of a tile, which update their memory, and the sums of their nodal forces.
  FillReport stresses(std::size_t tile) const;
  /// Moves the nodes of a tile over one time step.
  FillReport nodes(std::size_t tile) const;

  /// Force on a node at present and its velocity at the next half step. Changes nothing.
  NodeUpdate update(std::size_t node) const;
  /// Loads in addition to gravity at this time step, N.
  Quad load(std::size_t node) const;
  /// Work of these loads over half a time step at this velocity (m/s), J.
  double load_work(std::size_t node, const Quad& velocity) const;

 private:
  void fetch_forces(std::size_t node) const;
};

}  // namespace voussoir
