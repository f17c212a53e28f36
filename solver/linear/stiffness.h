// Stiffness and mass of the whole assembly from the same patches and points as the explicit time step.
#pragma once
#include "solver/contact/jump.h"
#include "solver/linear/block_matrix.h"

namespace voussoir {

/// a × b = skew(a) b.
inline Mat3 skew(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

enum class PatchTangent {
  intact,   // all patches are bonded and elastic
  present,  // open points have no stiffness; sliding points only transverse to their slip direction
};

/// Tangent (n, s, t; Pa/m) at a point after its update: zero if open; if sliding, the normal and the transverse
/// stiffness and a thousandth of ks along the slip.
Mat3 point_tangent(const LawConstants& law, double kn, double ks, const Triple<double>& elastic, bool broken);

/// The same for a point of the composite law, with its remaining stiffness, bond and strength. A point on its cap has
/// the hardening tangent along the normal. Past the peak, where that tangent is negative, it has a thousandth of kn
/// instead.
Mat3 composite_tangent(const LawConstants& law, double kn, double ks, const Triple<double>& elastic, bool broken,
                       double softening, double crushed);

/// Generalised stiffness of one patch in its local axes, for the jump (n, s, t, θn, θs, θt): N/m, N, N m. `index`: of
/// Model::joints, or the number of joints plus the slot of a contact. A joint that is gone has no stiffness.
Matrix6 patch_stiffness(const Model& model, const State& state, std::size_t index, PatchTangent kind);
/// Contributions of that patch to the two diagonal blocks of K, of its bodies a and b.
std::array<Matrix6, 2> own_stiffness(const Model& model, const State& state, std::size_t index, PatchTangent kind);

/// The material part of K with patches in the present placements of the bodies, including the rows and columns of fixed
/// bodies. Units of a block: N/m, N, N m.
BlockMatrix stiffness_blocks(const Model& model, const State& state, PatchTangent kind);
/// Adds the geometric part: the forces of a patch pass in that placement (rows as in Stepper::wrenches) rotate and move
/// with the bodies. It is exact in equilibrium, to first order in the strains.
void add_geometric_stiffness(BlockMatrix& k, const Model& model, const State& state, const Array<double>& wrenches);
/// The material part over the unknowns.
SparseMatrix assemble_stiffness(const Model& model, const State& state, const Unknowns& unknowns, PatchTangent kind);

/// diag(m 1, R Ib Rᵀ) of a body in its present placement: kg, kg m2.
Matrix6 body_mass(const Model& model, const State& state, std::size_t body);
/// Mass blocks of all sites with an unknown.
BlockMatrix mass_blocks(const Model& model, const State& state, const Unknowns& unknowns);

}  // namespace voussoir
