// A symmetric matrix of 6 × 6 blocks between sites: what stiffness is assembled into, patch by patch (and element by
// element), before it becomes a sparse matrix over the unknowns.
#pragma once
#include <Eigen/Sparse>
#include <utility>

#include "solver/linear/unknowns.h"

namespace voussoir {

using SparseMatrix = Eigen::SparseMatrix<double>;  // symmetric ones hold their lower triangle

class BlockMatrix {
 public:
  /// Zero, with a block for every site and for every coupled pair of sites (in any order, repeats allowed).
  BlockMatrix(std::size_t sites, const std::vector<std::pair<std::int32_t, std::int32_t>>& coupled);

  /// Adds the block of rows `row` and columns `column`; of a pair of sites only one of the two, the other is its
  /// transpose. The pair must have been announced.
  void add(std::int32_t row, std::int32_t column, const Matrix6& block);
  Matrix6& diagonal(std::int32_t site) { return blocks_[std::size_t(first_[std::size_t(site)])]; }
  const Matrix6& diagonal(std::int32_t site) const { return blocks_[std::size_t(first_[std::size_t(site)])]; }

  /// Components that are no unknowns get a 1 on the diagonal and nothing beside it.
  void hold(const Unknowns& unknowns);

  std::size_t sites() const { return first_.size() - 1; }
  /// Calls f(row, column, block) for all blocks of the lower triangle, row ≥ column.
  template <class F>
  void for_each(F f) const {
    for (std::size_t column = 0; column + 1 < first_.size(); ++column)
      for (std::int32_t at = first_[column]; at < first_[column + 1]; ++at)
        f(row_[std::size_t(at)], std::int32_t(column), blocks_[std::size_t(at)]);
  }

  /// Calls f(row, column, block) for all of them, which it may change.
  template <class F>
  void change_each(F f) {
    for (std::size_t column = 0; column + 1 < first_.size(); ++column)
      for (std::int32_t at = first_[column]; at < first_[column + 1]; ++at)
        f(row_[std::size_t(at)], std::int32_t(column), blocks_[std::size_t(at)]);
  }

  /// y = K x of six components a site; returns xᵀ K x.
  double times(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

  /// The lower triangle over the unknowns. Those of a site must be in ascending order, and sites too.
  SparseMatrix over(const Unknowns& unknowns) const;

 private:
  std::vector<std::int32_t> first_, row_;  // blocks of the lower triangle, column by column, the diagonal first
  std::vector<Matrix6> blocks_;
};

}  // namespace voussoir
