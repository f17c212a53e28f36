#include "solver/modal/block_matrix.h"

#include <algorithm>

namespace voussoir {

BlockMatrix::BlockMatrix(std::size_t sites, const std::vector<std::pair<std::int32_t, std::int32_t>>& coupled) {
  std::vector<std::pair<std::int32_t, std::int32_t>> all;  // column, row
  all.reserve(coupled.size() + sites);
  for (std::size_t site = 0; site < sites; ++site) all.emplace_back(site, site);
  for (const auto& [a, b] : coupled) all.emplace_back(std::min(a, b), std::max(a, b));
  std::sort(all.begin(), all.end());
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
