// Solves K x = b for large assemblies: conjugate gradients with a multigrid preconditioner over smoothed aggregates
// (Vaněk, Mandel & Brezina 1996). Nearby sites form one coarse site that moves as a rigid body. The coarse equations
// are therefore again those of bodies, and the next level is made in the same way. Time and memory are in proportion to
// the number of sites; those of a factorisation grow faster (docs/theory/equilibrium.md). The cycle need not be exact
// and uses single precision.
#pragma once
#include <Eigen/Cholesky>
#include <optional>

#include "solver/linear/single_rows.h"

namespace voussoir {

class Multigrid {
 public:
  /// Makes the levels of `k`. It must be positive definite, assembled from patches between two sites each, and held
  /// (BlockMatrix::hold()) at components that are not unknowns; `places` are the positions of its sites (m). Returns
  /// false if it is not positive definite, or if no sufficiently small coarse level can be made.
  bool compute(const BlockMatrix& k, const Unknowns& unknowns, const std::vector<Vec3>& places);
  /// Returns x with |b − K x| ≤ tolerance |b|, or nothing if it is not found within the number of iterations. `k` is
  /// held as above and may differ slightly from that of the levels.
  std::optional<Eigen::VectorXd> solve(const BlockMatrix& k, const Unknowns& unknowns, const Eigen::VectorXd& b,
                                       double tolerance, int most_iterations);
  int iterations() const { return iterations_; }  // of the last solution
  std::size_t levels() const { return levels_.size() + 1; }

 private:
  /// All levels except the coarsest. Vectors have eight numbers for each site, of which six are used.
  struct Level {
    SingleRows left;                // of the diagonal
    Array<float> inverse;           // of the diagonal blocks
    SingleRows p;                   // columns: sites of the next level
    Array<float> b, x, rest;        // rest: part right of the diagonal, times x
    Array<float> diagonal, before;  // for levels that are visited twice: diagonal blocks; x of the first visit
  };
  void cycle(std::size_t level);
  void two_cycles(std::size_t level);
  void solve_coarsest();
  bool factor_coarsest(const BlockRows& a);

  std::vector<Level> levels_;
  Eigen::LLT<Eigen::MatrixXd> coarsest_;
  Array<float> coarsest_b_, coarsest_x_;
  int iterations_ = 0;
};

}  // namespace voussoir
