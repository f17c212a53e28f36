// Blocks of 6 × 6 in single precision, row by row, and their products and transposed products with vectors over sites.
// For a symmetric matrix only the part left of the diagonal is stored; its transpose is the part right of it. Vectors
// have eight numbers for each site. The last two are zero when a block is multiplied by them.
#pragma once
#include <algorithm>
#include <cstring>

#include "solver/linear/block_rows.h"

namespace voussoir {

constexpr std::size_t block_width = 36, site_width = 8;

struct SingleRows {
  Array<std::int32_t> first, column;
  Array<float> block;  // 36 numbers each, row by row, and two more at the end
  std::size_t rows() const { return first.size() - 1; }
};

/// Appends a block.
inline void append(const Matrix6& block, Array<float>& singles) {
  const std::size_t at = singles.size();
  singles.resize(at + block_width);
  for (Eigen::Index r = 0; r < 6; ++r)
    for (Eigen::Index c = 0; c < 6; ++c) singles[at + std::size_t(6 * r + c)] = float(block(r, c));
}
/// The last row of the last block is read with two additional numbers.
inline void end_blocks(Array<float>& singles) {
  singles.resize(singles.size() + site_width - 6, 0.0f);
}
inline Array<float> in_singles(const Array<Matrix6>& blocks) {
  Array<float> singles;
  singles.reserve(block_width * blocks.size() + site_width - 6);
  for (const Matrix6& block : blocks) append(block, singles);
  end_blocks(singles);
  return singles;
}
inline SingleRows in_singles(const BlockRows& m) {
  return {m.first, m.column, in_singles(m.block)};
}

/// The numbers of a site, or a row of a block and two numbers of the next row.
using Eight = float __attribute__((vector_size(32)));
[[gnu::always_inline]] inline Eight load(const float* from) {
  Eight x;
  std::memcpy(&x, from, sizeof(x));
  return x;
}
[[gnu::always_inline]] inline void store(float* to, const Eight& x) {
  std::memcpy(to, &x, sizeof(x));
}
/// The same with the last two numbers set to zero.
[[gnu::always_inline]] inline Eight six_of(const Eight& x) {
  return __builtin_shufflevector(x, Eight{}, 0, 1, 2, 3, 4, 5, 8, 8);
}

/// Sum of products of blocks with the numbers of sites.
struct RowProducts {
  Eight of[6] = {};
  [[gnu::always_inline]] void add(const float* block, const Eight& x) {
    for (int r = 0; r < 6; ++r) of[r] += load(block + 6 * r) * x;
  }
  /// Sums of the eight numbers of each row.
  [[gnu::always_inline]] Eight sums() const {
    const Eight pairs[3] = {pair(of[0], of[1]), pair(of[2], of[3]), pair(of[4], of[5])};
    const Eight upper = __builtin_shufflevector(pairs[0], pairs[1], 0, 1, 8, 9, 4, 5, 12, 13) +
                        __builtin_shufflevector(pairs[0], pairs[1], 2, 3, 10, 11, 6, 7, 14, 15);
    const Eight lower = pairs[2] + __builtin_shufflevector(pairs[2], pairs[2], 2, 3, 0, 1, 6, 7, 4, 5);
    return six_of(__builtin_shufflevector(upper, lower, 0, 1, 2, 3, 8, 9, 10, 11) +
                  __builtin_shufflevector(upper, lower, 4, 5, 6, 7, 12, 13, 14, 15));
  }

 private:
  /// Sums of pairs of both arguments, alternating.
  [[gnu::always_inline]] static Eight pair(const Eight& a, const Eight& b) {
    return __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13) +
           __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  }
};

/// A row times x. Later blocks are prefetched because the processor would not do so early enough.
[[gnu::always_inline]] inline Eight times(const SingleRows& m, std::size_t row, const float* x) {
  constexpr std::size_t ahead = 1024, most = 7 * cache_line;  // numbers; bytes
  const auto begin = std::size_t(m.first[row]), end = std::size_t(m.first[row + 1]);
  fetch(&m.block[block_width * begin] + ahead, std::min(most, sizeof(float) * block_width * (end - begin)));
  RowProducts products;
  for (std::size_t at = begin; at < end; ++at)
    products.add(&m.block[block_width * at], load(x + site_width * std::size_t(m.column[at])));
  return products.sums();
}
/// The same for rows in descending order. The blocks of a row are also read in descending order, because processors
/// prefetch only a steady sequence.
[[gnu::always_inline]] inline Eight times_backwards(const SingleRows& m, std::size_t row, const float* x) {
  RowProducts products;
  for (auto at = std::size_t(m.first[row + 1]); at-- > std::size_t(m.first[row]);)
    products.add(&m.block[block_width * at], load(x + site_width * std::size_t(m.column[at])));
  return products.sums();
}

/// A transposed block times the six numbers at x. Two sums, so that each has half the chain of dependent additions.
[[gnu::always_inline]] inline Eight transposed_times(const float* block, const float* x) {
  Eight even = load(block) * x[0], odd = load(block + 6) * x[1];
  for (int r = 2; r < 6; r += 2) even += load(block + 6 * r) * x[r], odd += load(block + 6 * (r + 1)) * x[r + 1];
  return even + odd;
}
/// Adds the transposed blocks of a row times the six numbers at x to the numbers of their columns.
[[gnu::always_inline]] inline void add_transposed(const SingleRows& m, std::size_t row, const float* x, float* to) {
  for (auto at = std::size_t(m.first[row]); at < std::size_t(m.first[row + 1]); ++at) {
    float* of = to + site_width * std::size_t(m.column[at]);
    store(of, load(of) + transposed_times(&m.block[block_width * at], x));
  }
}

}  // namespace voussoir
