// Matrices between sites as rows of 6 × 6 blocks, and the product that coarse levels are made of.
#pragma once
#include "solver/base/arrays.h"
#include "solver/linear/block_matrix.h"

namespace voussoir {

/// Six rows a site, as blocks of 6 × 6, row by row; columns ascend.
struct BlockRows {
  Array<std::int32_t> first, column;
  Array<Matrix6> block;
  std::size_t rows() const { return first.size() - 1; }
};

/// Calls use(entry) for each block of a row.
template <class F>
void each_of(const BlockRows& m, std::size_t row, F use) {
  for (auto at = std::size_t(m.first[row]); at < std::size_t(m.first[row + 1]); ++at) use(at);
}

/// A row, summed up from blocks that come in any order of columns.
class RowSum {
 public:
  explicit RowSum(std::size_t columns) : place_(columns, -1) {}
  Matrix6& at(std::int32_t column);
  const Matrix6& at(std::int32_t column) const { return block_[std::size_t(place_[std::size_t(column)])]; }
  const std::vector<std::int32_t>& columns() const { return column_; }  // as they came
  void clear();

 private:
  std::vector<std::int32_t> place_, column_;
  std::vector<Matrix6> block_;
};

/// All of a matrix of which `k` has one block for each pair of sites, less blocks of nothing but zeros.
BlockRows rows_of(const BlockMatrix& k);
/// Pᵀ A P of a symmetric A; P has so many columns.
BlockRows coarse_rows(const BlockRows& a, const BlockRows& p, std::size_t columns);

}  // namespace voussoir
