#include "solver/linear/block_rows.h"

#include <algorithm>
#include <utility>

#include "solver/linear/six.h"

namespace voussoir {

namespace {

/// S of a matrix S + Sᵀ, its blocks summed up in any order.
class HalfSum {
 public:
  HalfSum(std::size_t rows, std::size_t blocks) : row_(rows) { block_.reserve(blocks); }
  Matrix6& at(std::int32_t row, std::int32_t column) {
    for (const Entry& e : row_[std::size_t(row)])
      if (e.column == column) return block_[std::size_t(e.block)];
    const auto own = std::int32_t(block_.size()), other = row == column ? own : own + 1;
    row_[std::size_t(row)].push_back({column, own, other});
    if (other != own) row_[std::size_t(column)].push_back({row, other, own});
    block_.resize(std::size_t(other) + 1, Matrix6::Zero());
    return block_[std::size_t(own)];
  }
  /// S + Sᵀ.
  BlockRows whole() {
    BlockRows all;
    all.first.reserve(row_.size() + 1), all.column.reserve(block_.size()), all.block.reserve(block_.size());
    all.first.push_back(0);
    for (std::vector<Entry>& row : row_) {
      std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
      for (const Entry& e : row) {
        all.column.push_back(e.column);
        all.block.push_back(block_[std::size_t(e.block)] + block_[std::size_t(e.mirror)].transpose());
      }
      all.first.push_back(std::int32_t(all.column.size()));
    }
    return all;
  }

 private:
  struct Entry {
    std::int32_t column, block, mirror;  // mirror: the block at the transposed place
  };
  std::vector<std::vector<Entry>> row_;
  Array<Matrix6> block_;
};

}  // namespace

Matrix6& RowSum::at(std::int32_t column) {
  std::int32_t& place = place_[std::size_t(column)];
  if (place < 0) place = std::int32_t(column_.size()), column_.push_back(column), block_.push_back(Matrix6::Zero());
  return block_[std::size_t(place)];
}

void RowSum::clear() {
  for (const std::int32_t column : column_) place_[std::size_t(column)] = -1;
  column_.clear(), block_.clear();
}

BlockRows rows_of(const BlockMatrix& k) {
  // Held sites have no couplings. Otherwise the ground would couple all blocks on it.
  const auto each = [&](const auto& use) {
    k.for_each([&](std::int32_t i, std::int32_t j, const Matrix6& block) {
      if (i == j || !block.isZero(0.0)) use(i, j, block);
    });
  };
  BlockRows rows;
  rows.first.assign(k.sites() + 1, 0);
  each([&](std::int32_t i, std::int32_t j, const Matrix6&) {
    ++rows.first[std::size_t(i) + 1];
    if (i != j) ++rows.first[std::size_t(j) + 1];
  });
  for (std::size_t i = 0; i < k.sites(); ++i) rows.first[i + 1] += rows.first[i];
  rows.column.resize(std::size_t(rows.first.back())), rows.block.resize(rows.column.size());
  Array<std::int32_t> next(rows.first.begin(), rows.first.end() - 1);
  // A row has what comes of the columns before its own first: so its columns ascend.
  each([&](std::int32_t i, std::int32_t j, const Matrix6& block) {
    const auto at = std::size_t(next[std::size_t(i)]++);
    rows.column[at] = j, rows.block[at] = block;
    if (i == j) return;
    const auto mirror = std::size_t(next[std::size_t(j)]++);
    rows.column[mirror] = i, rows.block[mirror] = block.transpose();
  });
  return rows;
}

// S + Sᵀ with S = Σ Pᵢᵀ (½ Aᵢᵢ Pᵢ + Σ Aᵢⱼ Pⱼ), j < i: half of A, and no row of A P need be kept.
BlockRows coarse_rows(const BlockRows& a, const BlockRows& p, std::size_t columns) {
  HalfSum half(columns, 2 * a.rows());
  RowSum product(columns);
  for (std::size_t i = 0; i < a.rows(); ++i) {
    each_of(a, i, [&](std::size_t at) {
      const auto j = std::size_t(a.column[at]);
      if (j > i) return;
      const Columns block(j == i ? Matrix6(0.5 * a.block[at]) : a.block[at]);
      each_of(p, j, [&](std::size_t q) { block.add_times(p.block[q], product.at(p.column[q])); });
    });
    each_of(p, i, [&](std::size_t q) {
      const Columns back(p.block[q].transpose());
      for (const std::int32_t column : product.columns())
        back.add_times(std::as_const(product).at(column), half.at(p.column[q], column));
    });
    product.clear();
  }
  return half.whole();
}

}  // namespace voussoir
