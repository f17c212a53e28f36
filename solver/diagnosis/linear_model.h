// Stiffness and mass of an assembly whose joints are all intact, straight from its joints and blocks, without building
// a model for runs.
#pragma once
#include "geometry/assembly.h"
#include "solver/linear/block_matrix.h"

namespace voussoir {

using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Stiffness of a joint for the motions (du_a, dθ_a, du_b, dθ_b) of its blocks: N/m, N, N m. The patch as in
/// solver/linear/stiffness.h, all of it bonded.
Matrix12 pair_stiffness(const Assembly& assembly, const Joint& joint);
/// diag(m 1, I) of a block: kg, kg m2.
Matrix6 block_mass(const Block& block);

struct LinearModel {
  Unknowns unknowns;  // sites are the assembly's blocks
  SparseMatrix k, m;  // lower triangles; ways that nothing holds are held as in solver/linear/loose.h
};
/// Throws InputError when nothing is held together.
LinearModel linear_model(const Assembly& assembly);

}  // namespace voussoir
