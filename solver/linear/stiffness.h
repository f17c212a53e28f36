// Stiffness and mass of the whole assembly from the same patches and points as the explicit step.
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
  intact,   // every patch as if bonded and elastic
  present,  // open points nothing, sliding points only across their slip direction
};

/// Tangent (n, s, t; Pa/m) at a point that has just been updated: nothing where open, normal and transverse stiffness
/// where sliding.
Mat3 point_tangent(const LawConstants& law, double kn, double ks, const Triple<double>& elastic, bool broken);

/// The same of a composite point: with what is left of its stiffness, its bond and its strength. A point on its cap has
/// the hardening tangent along the normal, past the peak a thousandth of kn: positive, as friction keeps a thousandth.
Mat3 composite_tangent(const LawConstants& law, double kn, double ks, const Triple<double>& elastic, bool broken,
                       double softening, double crushed);

/// Generalised stiffness of one patch in its local axes, for the jump (n, s, t, θn, θs, θt): N/m, N, N m.
Matrix6 patch_stiffness(const Model& model, const State& state, std::size_t index, PatchTangent kind);
/// What that patch adds to the two diagonal blocks of K: of its bodies a and b.
std::array<Matrix6, 2> own_stiffness(const Model& model, const State& state, std::size_t index, PatchTangent kind);

/// The material part of K with patches taken at the bodies' present placements, fixed bodies' rows and columns
/// included. The unit of a block: N/m, N, N m.
BlockMatrix stiffness_blocks(const Model& model, const State& state, PatchTangent kind);
/// Adds the geometric part: the forces of a patch pass at that placement (rows as Stepper::wrenches) turn and shift
/// with the bodies. Exact in equilibrium, to first order in the strains.
void add_geometric_stiffness(BlockMatrix& k, const Model& model, const State& state, const Array<double>& wrenches);
/// The material part over the unknowns.
SparseMatrix assemble_stiffness(const Model& model, const State& state, const Unknowns& unknowns, PatchTangent kind);

/// diag(m 1, R Ib Rᵀ) of a body where it is: kg, kg m2.
Matrix6 body_mass(const Model& model, const State& state, std::size_t body);
/// Of all sites that have an unknown.
BlockMatrix mass_blocks(const Model& model, const State& state, const Unknowns& unknowns);

}  // namespace voussoir
