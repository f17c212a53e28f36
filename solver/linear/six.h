// Products of 6 × 6 blocks, column by column in registers. For sums of many products they are faster than those of
// Eigen (docs/developer/performance-notes.md).
#pragma once
#include <cstring>

#include "solver/linear/unknowns.h"

namespace voussoir {

/// Six numbers: a column of a block, or the numbers of a site.
struct Six {
  using Four = double __attribute__((vector_size(32)));
  using Two = double __attribute__((vector_size(16)));
  Four upper = {};
  Two lower = {};
  Six() = default;
  [[gnu::always_inline]] explicit Six(const double* from) {
    std::memcpy(&upper, from, sizeof(upper)), std::memcpy(&lower, from + 4, sizeof(lower));
  }
  [[gnu::always_inline]] void store(double* to) const {
    std::memcpy(to, &upper, sizeof(upper)), std::memcpy(to + 4, &lower, sizeof(lower));
  }
  [[gnu::always_inline]] void add(const Six& a, double b) { upper += a.upper * b, lower += a.lower * b; }
  [[gnu::always_inline]] void add(const Six& a, const Six& b) {
    upper += a.upper * b.upper, lower += a.lower * b.lower;
  }
  [[gnu::always_inline]] double sum() const {
    return ((upper[0] + upper[2]) + (upper[1] + upper[3])) + (lower[0] + lower[1]);
  }
};

/// The columns of a block, for several products with it.
struct Columns {
  Six of[6];
  [[gnu::always_inline]] explicit Columns(const Matrix6& block) {
    for (int c = 0; c < 6; ++c) of[c] = Six(block.data() + 6 * c);
  }
  /// Adds the block times `x` to `sum`.
  [[gnu::always_inline]] void add_times(const double* x, Six& sum) const {
    for (int c = 0; c < 6; ++c) sum.add(of[c], x[c]);
  }
  /// Adds the block times `b` to `sum`, which must be a different block.
  [[gnu::always_inline]] void add_times(const Matrix6& b, Matrix6& sum) const {
    for (int c = 0; c < 6; ++c) {
      Six column(sum.data() + 6 * c);
      add_times(b.data() + 6 * c, column);
      column.store(sum.data() + 6 * c);
    }
  }
};

inline Matrix6 block_product(const Matrix6& a, const Matrix6& b) {
  Matrix6 c = Matrix6::Zero();
  Columns(a).add_times(b, c);
  return c;
}

}  // namespace voussoir
