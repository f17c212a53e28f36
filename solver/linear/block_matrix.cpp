#include "solver/linear/block_matrix.h"

#include <algorithm>

#include "solver/base/arrays.h"
#include "solver/base/buckets.h"
#include "solver/linear/six.h"

namespace voussoir {

BlockMatrix::BlockMatrix(std::size_t sites, const std::vector<std::pair<std::int32_t, std::int32_t>>& coupled) {
  std::vector<std::pair<std::int32_t, std::int32_t>> all;  // column, row
  all.reserve(coupled.size() + sites);
  for (std::size_t site = 0; site < sites; ++site) all.emplace_back(site, site);
  for (const auto& [a, b] : coupled) all.emplace_back(std::min(a, b), std::max(a, b));
  sort_by_place(all, sites, [](const auto& pair) { return pair.first; });
  all.erase(std::unique(all.begin(), all.end()), all.end());
  first_.assign(sites + 1, 0);
  for (const auto& [column, row] : all) {
    ++first_[std::size_t(column) + 1];
    row_.push_back(row);
  }
  for (std::size_t site = 0; site < sites; ++site) first_[site + 1] += first_[site];
  blocks_.assign(all.size(), Matrix6::Zero());
}

void BlockMatrix::add(std::int32_t row, std::int32_t column, const Matrix6& block) {
  const auto begin = row_.begin() + first_[std::size_t(std::min(row, column))],
             end = row_.begin() + first_[std::size_t(std::min(row, column)) + 1];
  const auto at = std::lower_bound(begin, end, std::max(row, column)) - row_.begin();
  if (row >= column)
    blocks_[std::size_t(at)] += block;
  else
    blocks_[std::size_t(at)] += block.transpose();
}

void BlockMatrix::hold(const Unknowns& unknowns) {
  for (std::size_t column = 0; column < sites(); ++column)
    for (std::int32_t at = first_[column]; at < first_[column + 1]; ++at) {
      Matrix6& block = blocks_[std::size_t(at)];
      const auto &rows = unknowns.of[std::size_t(row_[std::size_t(at)])], &columns = unknowns.of[column];
      for (std::size_t c = 0; c < 6; ++c) {
        if (rows[c] < 0) block.row(Eigen::Index(c)).setZero();
        if (columns[c] < 0) block.col(Eigen::Index(c)).setZero();
        if (at == first_[column] && columns[c] < 0) block(Eigen::Index(c), Eigen::Index(c)) = 1.0;
      }
    }
}

double BlockMatrix::times(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  constexpr std::size_t ahead = 1024;  // numbers: the processor reads on too, but not far enough
  y.setZero(x.size());
  double product = 0.0;
  for (std::size_t column = 0; column < sites(); ++column) {
    const double* of = x.data() + 6 * column;
    const auto begin = std::size_t(first_[column]), end = std::size_t(first_[column + 1]);
    Six across[6];  // of each column of the blocks below the diagonal: its products with the sites of their rows
    for (std::size_t at = begin + 1; at < end; ++at) {
      const double* block = blocks_[at].data();
      fetch(block + ahead, sizeof(Matrix6));
      const std::size_t row = 6 * std::size_t(row_[at]);
      const Six there(x.data() + row);
      Six sum(y.data() + row);
      for (int c = 0; c < 6; ++c) {
        const Six down(block + 6 * c);
        sum.add(down, of[c]), across[c].add(down, there);
      }
      sum.store(y.data() + row);
    }
    Six own(y.data() + 6 * column);
    fetch(blocks_[begin].data() + ahead, sizeof(Matrix6));
    Columns(blocks_[begin]).add_times(of, own);
    double sums[6];
    own.store(sums);
    for (int c = 0; c < 6; ++c) {
      sums[c] += across[c].sum();
      product += sums[c] * of[c];  // what is before this column has added its part
      y[Eigen::Index(6 * column) + c] = sums[c];
    }
  }
  return product;
}

SparseMatrix BlockMatrix::over(const Unknowns& unknowns) const {
  std::vector<int> sizes(std::size_t(unknowns.count), 0);
  const auto each = [&](const auto& use) {
    for_each([&](std::int32_t row, std::int32_t column, const Matrix6& block) {
      for (int c = 0; c < 6; ++c) {
        const std::int32_t j = unknowns.of[std::size_t(column)][c];
        if (j < 0) continue;
        for (int r = row == column ? c : 0; r < 6; ++r)
          if (const std::int32_t i = unknowns.of[std::size_t(row)][r]; i >= 0) use(i, j, block(r, c));
      }
    });
  };
  each([&](std::int32_t, std::int32_t j, double) { ++sizes[std::size_t(j)]; });
  SparseMatrix matrix(unknowns.count, unknowns.count);
  matrix.reserve(sizes);
  each([&](std::int32_t i, std::int32_t j, double value) { matrix.insert(i, j) = value; });
  matrix.makeCompressed();
  return matrix;
}

}  // namespace voussoir
