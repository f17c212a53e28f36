// K x = b of large assemblies: conjugate gradients, preconditioned by a multigrid cycle over smoothed aggregates
// (Vaněk, Mandel & Brezina 1996). Sites near each other make one coarse site that moves as a rigid body, so that the
// coarse equations are again those of bodies and the next level is made as this one was. Time and memory grow with the
// number of sites, those of a factor faster (docs/theory/equilibrium.md).
#pragma once
#include <Eigen/Cholesky>
#include <optional>

#include "solver/modal/block_matrix.h"

namespace voussoir {

/// Six rows a site, as blocks of 6 × 6, row by row; columns ascend.
struct BlockRows {
  Array<std::int32_t> first, column;
  Array<Matrix6> block;
  std::size_t rows() const { return first.size() - 1; }
};

class Multigrid {
 public:
  /// `k` symmetric and positive definite over the unknowns, `places` of its sites (m). False where it is not, or where
  /// there is no coarse level to be had that is small enough.
  bool compute(const BlockMatrix& k, const Unknowns& unknowns, const std::vector<Vec3>& places);
  /// x with |b − K x| ≤ tolerance |b|, or nothing if it is not found in so many iterations.
  std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& b, double tolerance, int most_iterations);
  int iterations() const { return iterations_; }  // of the last solution
  std::size_t levels() const { return levels_.size(); }

 private:
  struct Level {
    BlockRows a;
    Array<std::int32_t> diagonal;  // where each row has it
    Array<Matrix6> inverse;        // of the diagonal blocks
    BlockRows p;                   // columns: sites of the next level
  };
  void cycle(std::size_t level, const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  bool factor_coarsest();

  std::vector<Level> levels_;
  Eigen::LLT<Eigen::MatrixXd> coarsest_;
  std::vector<std::array<std::int32_t, 6>> unknowns_;  // of each site that has any
  int iterations_ = 0;
};

}  // namespace voussoir
