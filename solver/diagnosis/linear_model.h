// Stiffness and mass of an assembly whose joints are all intact, straight from its joints and blocks, and how they
// differ between two assemblies: what the diagnosis asks for hundreds of times, without building a model for runs.
#pragma once
#include "geometry/assembly.h"
#include "solver/linear/block_matrix.h"

namespace voussoir {

using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Stiffness of a joint for the motions (du_a, dθ_a, du_b, dθ_b) of its blocks: N/m, N, N m. The patch as in
/// solver/linear/stiffness.h, all of it bonded.
Matrix12 pair_stiffness(const Assembly& assembly, const Joint& joint);

struct LinearModel {
  Unknowns unknowns;  // sites are the assembly's blocks
  SparseMatrix k, m;  // lower triangles; ways that nothing holds are held as in solver/linear/loose.h
};
/// Throws InputError when nothing is held together.
LinearModel linear_model(const Assembly& assembly);

/// How K and M change with a parameter: only the joints and blocks that do.
struct Derivative {
  struct Pair {
    std::int64_t a = 0, b = 0;  // blocks
    Matrix12 k;
  };
  struct Own {
    std::int64_t block = 0;
    Matrix6 m;
  };
  std::vector<Pair> pairs;
  std::vector<Own> blocks;
};
/// (K, M of `high` − K, M of `low`)/apart. Both have the same blocks, but for their mass; joints are matched by the
/// faces that they join.
Derivative derivative(const Assembly& low, const Assembly& high, double apart);

/// K′ x and M′ x.
Eigen::VectorXd times_stiffness(const Derivative& d, const Unknowns& unknowns, const Eigen::VectorXd& x);
Eigen::VectorXd times_mass(const Derivative& d, const Unknowns& unknowns, const Eigen::VectorXd& x);

}  // namespace voussoir
