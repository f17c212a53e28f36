// Streams of random numbers by seed, purpose and number.
#include "solver/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace voussoir {
namespace VOUSSOIR_FILE {

TEST(StreamOf, IsTheSameForTheSameAndAnotherForAnyOther) {
  EXPECT_EQ(stream_of(7, "width", 3).bits(), stream_of(7, "width", 3).bits());
  const std::uint64_t own = stream_of(7, "width", 3).bits();
  EXPECT_NE(own, stream_of(8, "width", 3).bits());
  EXPECT_NE(own, stream_of(7, "height", 3).bits());
  EXPECT_NE(own, stream_of(7, "width", 4).bits());
}

/// First numbers of neighbouring streams are as independent as numbers of one: mean 0, deviation 1, no correlation.
TEST(StreamOf, NeighboursAreIndependent) {
  constexpr int n = 20000;
  double sum = 0.0, squares = 0.0, products = 0.0, last = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = stream_of(1, "period", i).normal();
    sum += x, squares += x * x, products += x * last;
    last = x;
  }
  EXPECT_NEAR(sum / n, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1.0, 4.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(products / n, 0.0, 4.0 / std::sqrt(n));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
