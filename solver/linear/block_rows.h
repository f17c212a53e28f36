// Matrices between sites as rows of 6 × 6 blocks, and the product that gives coarse levels.
#pragma once
#include "solver/base/arrays.h"
#include "solver/linear/block_matrix.h"

namespace voussoir {

/// Six rows for each site, as blocks of 6 × 6, row by row; columns are ascending.
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

/// A row that is summed from blocks in any order of columns.
class RowSum {
 public:
  explicit RowSum(std::size_t columns) : place_(columns, -1) {}
  Matrix6& at(std::int32_t column);
  const Matrix6& at(std::int32_t column) const { return block_[std::size_t(place_[std::size_t(column)])]; }
  const std::vector<std::int32_t>& columns() const { return column_; }  // in the order of addition
  void clear();

 private:
  std::vector<std::int32_t> place_, column_;
  std::vector<Matrix6> block_;
};

/// The full matrix, of which `k` has one block for each pair of sites, without zero blocks.
BlockRows rows_of(const BlockMatrix& k);
/// Pᵀ A P for a symmetric A; `columns` is the number of columns of P.
BlockRows coarse_rows(const BlockRows& a, const BlockRows& p, std::size_t columns);

}  // namespace voussoir
