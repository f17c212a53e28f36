// K x = b of large assemblies: conjugate gradients, preconditioned by a multigrid cycle over smoothed aggregates
// (Vaněk, Mandel & Brezina 1996). Sites near each other make one coarse site that moves as a rigid body, so that the
// coarse equations are again those of bodies and the next level is made as this one was. Time and memory grow with the
// number of sites, those of a factor faster (docs/theory/equilibrium.md). The cycle need not be exact: single
// precision.
#pragma once
#include <Eigen/Cholesky>
#include <optional>

#include "solver/linear/single_rows.h"

namespace voussoir {

class Multigrid {
 public:
  /// Levels of a `k` that is positive definite, made of patches between two sites each, and held (BlockMatrix::hold())
  /// where there is no unknown; `places` of its sites (m). False where it is not positive definite, or where there is
  /// no coarse level to be had that is small enough.
  bool compute(const BlockMatrix& k, const Unknowns& unknowns, const std::vector<Vec3>& places);
  /// x with |b − K x| ≤ tolerance |b|, or nothing if it is not found in so many iterations. `k` is held too, and may
  /// differ a little from that of the levels.
  std::optional<Eigen::VectorXd> solve(const BlockMatrix& k, const Unknowns& unknowns, const Eigen::VectorXd& b,
                                       double tolerance, int most_iterations);
  int iterations() const { return iterations_; }  // of the last solution
  std::size_t levels() const { return levels_.size() + 1; }

 private:
  /// All but the coarsest. Vectors have eight numbers a site, of which six count.
  struct Level {
    SingleRows left;                // of the diagonal
    Array<float> inverse;           // of the diagonal blocks
    SingleRows p;                   // columns: sites of the next level
    Array<float> b, x, rest;        // rest: what is right of the diagonal, times x
    Array<float> diagonal, before;  // where it is visited twice: blocks on it; x of the first visit
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
