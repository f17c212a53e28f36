// Free decay of a block on a joint with Rayleigh damping and with none (Maxwell: tools/ladder/maxwell_ring.cpp).
#include "tests/solver/models.h"
#include "tools/ladder/decay.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// ξ = mass/(2ω) + stiffness ω/2 (Clough & Penzien 1993, eq. 12-38), exact at both ends of the band.
TEST(RingDown, OfRayleighDamping) {
  DampingSettings rayleigh;
  rayleigh.kind = DampingSettings::Kind::rayleigh;
  const double w1 = 2 * pi * 0.5, w2 = 2 * pi * 12.0;
  for (double frequency : {0.5, 3.125, 12.0}) {
    const double w = 2 * pi * frequency, ratio = 0.02 / (w1 + w2) * (w1 * w2 / w + w);
    for (bool shortcut : {true, false}) {
      const Decay got = ring(rayleigh, frequency, 0.002 / frequency, shortcut);
      EXPECT_NEAR(got.ratio, ratio, 0.01 * ratio) << frequency;
      EXPECT_NEAR(got.frequency, frequency, 1e-3 * frequency) << frequency;
    }
  }
}

TEST(RingDown, WithoutDampingDoesNotDecay) {
  DampingSettings none;
  none.kind = DampingSettings::Kind::none;
  const Decay got = ring(none, 3.125, 1e-3, true);
  EXPECT_LT(std::abs(got.ratio), 1e-6);
  EXPECT_NEAR(got.frequency, 3.125, 1e-4 * 3.125);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
