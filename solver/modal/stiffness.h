// Stiffness and mass of the whole assembly from the same patches and points as the explicit step.
#pragma once
#include <Eigen/Sparse>
#include <vector>

#include "solver/contact/jump.h"

namespace voussoir {

using SparseMatrix = Eigen::SparseMatrix<double>;  // symmetric ones hold their lower triangle

/// Unknowns: six a free body (displacement, rotation vector; world axes, at the centroid), in body order. A guided body
/// has six too; where it is held K is zero and so are forces and accelerations.
struct Unknowns {
  std::vector<std::int32_t> of_body;  // first unknown of each body, −1 where all of it is fixed
  std::int32_t count = 0;
};
Unknowns number_unknowns(const Model& model);

enum class PatchTangent {
  intact,   // every patch as if bonded and elastic
  present,  // open points nothing, sliding points only across their slip direction
};

/// Generalised stiffness of one patch in its local axes, for the jump (n, s, t, θn, θs, θt): N/m, N, N m.
Eigen::Matrix<double, 6, 6> patch_stiffness(const Model& model, const State& state, std::size_t index,
                                            PatchTangent kind);

/// The 6 × 6 block of K that belongs to each body alone (displacement, rotation vector; world axes), fixed bodies too.
std::vector<Eigen::Matrix<double, 6, 6>> body_stiffness(const Model& model, const State& state, PatchTangent kind);

/// K with patches taken at the bodies' present placements (material part; lower triangle). `shift` is added to every
/// diagonal entry as a share of that entry, so that a loose block leaves the matrix positive.
SparseMatrix assemble_stiffness(const Model& model, const State& state, const Unknowns& unknowns, PatchTangent kind,
                                double shift = 0.0);

/// y = M⁻¹ x with M = diag(m 1, R Ib Rᵀ).
Eigen::VectorXd divide_by_mass(const Model& model, const State& state, const Unknowns& unknowns,
                               const Eigen::VectorXd& x);

}  // namespace voussoir
