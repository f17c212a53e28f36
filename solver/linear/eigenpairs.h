// The lowest eigenpairs of K φ = λ M φ.
#pragma once
#include "solver/linear/factor.h"

namespace voussoir {

/// What a solution leaves for the next one of a similar matrix.
struct EigenMemory {
  Factor factor;             // of the last K − σ M, at the solution's shift
  Eigen::VectorXd start;     // from the last vectors: where the iteration begins; empty: no matter where
  double tolerance = 1e-12;  // relative, of 1/(λ − σ)
  bool repeated = true;      // look for further vectors of repeated eigenvalues
};

struct Eigenpairs {
  Eigen::VectorXd values;   // rad2/s2, ascending
  Eigen::MatrixXd vectors;  // columns, φᵀ M φ = 1
  double shift = 0.0;       // rad2/s2, σ of the last factor
  double zero = 0.0;        // rad2/s2: values below it in size are what rounding leaves of zero
  // What it took:
  double factor_seconds = 0.0, iteration_seconds = 0.0;
  double factor_entries = 0.0;  // non-zeros of the Cholesky factor; 0: solved densely
  double factor_bytes = 0.0;    // most memory that CHOLMOD held
  int solves = 0;               // with the factor
};

/// `k` and `m` hold their lower triangles; `m` is positive definite, `k` positive semi-definite but for rounding or,
/// under geometric stiffness, a few negative directions, which are found too. 1 <= count <= the number of unknowns.
/// Repeated eigenvalues are all found: each search is followed by one in what is M-orthogonal to all that was found.
/// Throws RunError when the iteration does not converge or memory runs out, InputError for so many modes of so large a
/// model that only a dense solution would give them.
Eigenpairs lowest_eigenpairs(const SparseMatrix& k, const SparseMatrix& m, int count);
/// The same from where the last such solution left off; the factor is there afterwards, of small models too.
Eigenpairs lowest_eigenpairs(const SparseMatrix& k, const SparseMatrix& m, int count, EigenMemory& memory);

}  // namespace voussoir
