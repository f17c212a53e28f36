// Blocks of numbers for tests of block matrices.
#pragma once
#include <cmath>

#include "solver/linear/unknowns.h"

namespace voussoir::test {

/// Numbers between −1 and 1 that are the same each time.
inline Matrix6 numbers(std::int32_t row, std::int32_t column) {
  Matrix6 m;
  for (int i = 0; i < 36; ++i) m.data()[i] = std::sin(1.0 + 7.3 * row + 31.7 * column + 0.9 * i);
  return m;
}

}  // namespace voussoir::test
