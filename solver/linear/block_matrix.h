// A symmetric matrix of 6 × 6 blocks between sites. The stiffness is assembled in this form, patch by patch and element
// by element, before it becomes a sparse matrix over the unknowns.
#pragma once
#include <Eigen/Sparse>
#include <utility>

#include "solver/linear/unknowns.h"

namespace voussoir {

using SparseMatrix = Eigen::SparseMatrix<double>;  // symmetric matrices store their lower triangle

class BlockMatrix {
 public:
  /// A zero matrix with a block for every site and for every coupled pair of sites (in any order, with possible
  /// repetitions).
  BlockMatrix(std::size_t sites, const std::vector<std::pair<std::int32_t, std::int32_t>>& coupled);

  /// Adds the block of rows `row` and columns `column`. For a pair of sites add only one of the two blocks, because the
  /// other is its transpose. The pair must be in the list of the constructor.
  void add(std::int32_t row, std::int32_t column, const Matrix6& block);
  Matrix6& diagonal(std::int32_t site) { return blocks_[std::size_t(first_[std::size_t(site)])]; }
  const Matrix6& diagonal(std::int32_t site) const { return blocks_[std::size_t(first_[std::size_t(site)])]; }

  /// Sets a 1 on the diagonal and zeros elsewhere for components that are not unknowns.
  void hold(const Unknowns& unknowns);

  std::size_t sites() const { return first_.size() - 1; }
  /// Calls f(row, column, block) for all blocks of the lower triangle, row ≥ column.
  template <class F>
  void for_each(F f) const {
    for (std::size_t column = 0; column + 1 < first_.size(); ++column)
      for (std::int32_t at = first_[column]; at < first_[column + 1]; ++at)
        f(row_[std::size_t(at)], std::int32_t(column), blocks_[std::size_t(at)]);
  }

  /// Calls f(row, column, block) for the same blocks, which it may change.
  template <class F>
  void change_each(F f) {
    for (std::size_t column = 0; column + 1 < first_.size(); ++column)
      for (std::int32_t at = first_[column]; at < first_[column + 1]; ++at)
        f(row_[std::size_t(at)], std::int32_t(column), blocks_[std::size_t(at)]);
  }

  /// y = K x with six components for each site; returns xᵀ K x.
  double times(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

  /// The lower triangle over the unknowns. The unknowns of a site, and the sites, must be in ascending order.
  SparseMatrix over(const Unknowns& unknowns) const;

 private:
  std::vector<std::int32_t> first_, row_;  // blocks of the lower triangle, column by column, the diagonal first
  std::vector<Matrix6> blocks_;
};

}  // namespace voussoir
