// A load on an elastic fill over a smooth rigid base against its closed form; the rung fill-dispersal has wheels, rough
// bases and soil that yields.
#include "tools/ladder/dispersal.h"

#include <gtest/gtest.h>

namespace voussoir::test {
namespace VOUSSOIR_FILE {

using ladder::Dispersal;

/// What is pressed on at the top arrives at the base.
TEST(FillDispersal, ClosedFormsBearTheLoad) {
  const Dispersal d{.depth = 0.6};
  double sum = 0.0;
  constexpr double step = 0.01;
  for (int i = -500; i <= 500; ++i) sum += step * ladder::smooth_base_pressure(d, i * step);
  EXPECT_NEAR(sum, d.pressure * 2.0 * ladder::patch_half, 1e-3 * sum);
  sum = 0.0;
  for (int i = -20000; i <= 20000; ++i) sum += step * ladder::half_space_pressure(d, i * step);
  EXPECT_NEAR(sum, d.pressure * 2.0 * ladder::patch_half, 1e-3 * sum);
  // Close under a patch there is all of its pressure, far down a share of a point load: 3 P/(2 π z²).
  const Dispersal near{.depth = 0.001, .wheel = true}, far{.depth = 20.0, .wheel = true};
  EXPECT_NEAR(ladder::half_space_pressure(near, 0.0), near.pressure, 1e-4 * near.pressure);
  const double point = 3.0 * 0.09 * far.pressure / (2.0 * std::numbers::pi * 400.0);
  EXPECT_NEAR(ladder::half_space_pressure(far, 0.0), point, 1e-3 * point);
}

TEST(FillDispersal, OfAStripOnASmoothBase) {
  const Dispersal d{.depth = 0.6};
  const ladder::BasePressure found = ladder::base_pressure(d);
  ASSERT_TRUE(found.at_rest);
  for (std::size_t i = 0; i < found.x.size() && found.x[i] < d.depth; ++i) {
    const double expected = ladder::smooth_base_pressure(d, found.x[i]);
    EXPECT_NEAR(found.p[i], expected, 0.05 * ladder::smooth_base_pressure(d, 0.0)) << "at " << found.x[i] << " m";
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
