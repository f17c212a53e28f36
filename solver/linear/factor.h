// Sparse Cholesky factorisation with CHOLMOD (Chen, Davis, Hager & Rajamanickam 2008).
#pragma once
#include <Eigen/CholmodSupport>

#include "solver/linear/block_matrix.h"

namespace voussoir {

/// The supernodal factor of a symmetric matrix, ordered by nested dissection. The analysis of a sparsity pattern is
/// kept for later matrices with the same pattern.
class Factor {
 public:
  Factor();
  /// `a` contains its lower triangle. Returns false if it is not positive definite, if memory is insufficient, or if
  /// the number of operations would exceed the limit. A core performs 13e9 to 27e9 operations per second
  /// (docs/theory/equilibrium.md).
  bool compute(const SparseMatrix& a, double most_operations = 1e300);
  /// Whether the last compute() failed because memory was insufficient.
  bool lacked_memory();
  /// a⁻¹ x for all columns of x. Several threads may call it at the same time.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& x) const;
  double operations() { return cholesky_.cholmod().fl; }  // known after the analysis of the pattern
  double entries() { return cholesky_.cholmod().lnz; }    // non-zeros of the factor, known at the same time
  double bytes() { return double(cholesky_.cholmod().memory_usage); }

 private:
  struct Supernodal : Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Lower> {
    cholmod_factor* factor() const { return m_cholmodFactor; }
  };
  Supernodal cholesky_;
  std::vector<int> outer_, inner_;  // the analysed pattern
};

}  // namespace voussoir
