// The lowest eigenpairs of K φ = λ M φ.
#pragma once
#include "solver/linear/factor.h"

namespace voussoir {

/// Data of a solution that accelerate the next one with a similar matrix.
struct EigenMemory {
  Factor factor;             // of the last K − σ M, at the shift of the solution
  Eigen::VectorXd start;     // start vector of the iteration, from the last vectors; empty: any
  double tolerance = 1e-12;  // relative, of 1/(λ − σ)
  bool repeated = true;      // search for further vectors of repeated eigenvalues
};

struct Eigenpairs {
  Eigen::VectorXd values;   // rad2/s2, ascending
  Eigen::MatrixXd vectors;  // columns, φᵀ M φ = 1
  double shift = 0.0;       // rad2/s2, σ of the last factorisation
  double zero = 0.0;        // rad2/s2: smaller absolute values are zero within rounding
  // Cost of the solution:
  double factor_seconds = 0.0, iteration_seconds = 0.0;
  double factor_entries = 0.0;  // non-zeros of the Cholesky factor; 0: solved densely
  double factor_bytes = 0.0;    // most memory that CHOLMOD held
  int solves = 0;               // number of solutions with the factor
};

/// `k` and `m` contain their lower triangles. `m` is positive definite. `k` is positive semi-definite except for
/// rounding, or has a few negative directions with geometric stiffness, which are also found. 1 <= count <= number of
/// unknowns. All repeated eigenvalues are found: each search is followed by one in the space that is M-orthogonal to
/// all known vectors. Throws RunError if the iteration does not converge or memory is insufficient, and InputError if
/// the number of modes and the size of the model would need a dense solution that is too large.
Eigenpairs lowest_eigenpairs(const SparseMatrix& k, const SparseMatrix& m, int count);
/// The same with the data of the last solution in `memory`. Afterwards it contains the factor, also for small models.
Eigenpairs lowest_eigenpairs(const SparseMatrix& k, const SparseMatrix& m, int count, EigenMemory& memory);

}  // namespace voussoir
