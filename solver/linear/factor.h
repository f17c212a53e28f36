// Sparse Cholesky factors, by CHOLMOD (Chen, Davis, Hager & Rajamanickam 2008).
#pragma once
#include <Eigen/CholmodSupport>

#include "solver/linear/block_matrix.h"

namespace voussoir {

/// The supernodal factor of a symmetric matrix, ordered by nested dissection. The analysis of a pattern is kept for the
/// next matrices that have the same.
class Factor {
 public:
  Factor();
  /// `a` holds its lower triangle. False when it is not positive definite, memory runs out, or it would take more than
  /// so many operations, of which a core did 13e9 to 27e9 a second (docs/theory/equilibrium.md).
  bool compute(const SparseMatrix& a, double most_operations = 1e300);
  bool lacked_memory();
  /// a⁻¹ x, of as many columns as x has; several threads may ask at once.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& x) const;
  double operations() { return cholesky_.cholmod().fl; }  // known as soon as the pattern is analysed
  double entries() { return cholesky_.cholmod().lnz; }
  double bytes() { return double(cholesky_.cholmod().memory_usage); }

 private:
  struct Supernodal : Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Lower> {
    cholmod_factor* factor() const { return m_cholmodFactor; }
  };
  Supernodal cholesky_;
  std::vector<int> outer_, inner_;  // the pattern that was analysed
};

}  // namespace voussoir
