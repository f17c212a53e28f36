// Free decay of a block on a joint with Rayleigh damping and with none (Maxwell: tools/ladder/maxwell_ring.cpp).
#include "solver/step/make_snapshot.h"
#include "tests/solver/models.h"
#include "tools/ladder/decay.h"
#include "tools/ladder/fill_models.h"

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

/// Mass-proportional damping acts on velocities relative to the ground (Clough & Penzien 1993, section 12-4 with eq.
/// 3-22). A column of soil on ground that has been brought to a constant velocity v comes to rest on it. If absolute
/// velocities were damped, its top would stay behind by α v ρ (H²/(2 G) + 3 H⁴/(2 E b²)) = 0.16 m of shear and bending.
TEST(RingDown, MassDampingOfAFillIsRelativeToTheGround) {
  constexpr double height = 1.0, density = 1500.0, shear = 1e6;
  Assembly assembly = stone();
  add_box(assembly, {-1, -1, -1}, {2, 2, 0}, true);
  Bench bench(filled(std::move(assembly), box_mesh({0, 0, 0}, {1, 1, height}, 2, 2, 4),
                     elastic_fill(density, 2.0 * shear, shear), 1e10, 1e10, elastic_law()));
  bench.begin();
  bench.stepper.damping.mass_rate = 100.0;  // 1/s
  GroundMotion motion;
  motion.dt = 0.01;
  for (int i = 0; i < 200; ++i) motion.acceleration.emplace_back(i >= 1 && i <= 10 ? 10.0 : 0.0, 0.0, 0.0);
  bench.stepper.motion = &motion;
  ASSERT_TRUE(bench.run(std::int64_t(1.9 / bench.stepper.dt)));
  const Vec3 ground = bench.state.base_displacement();
  EXPECT_NEAR(bench.state.base_velocity().x(), 1.0, 0.01);
  for (const Vec3& moved : make_snapshot(bench.model, bench.state).fill.displacement)
    EXPECT_LT((moved - ground).norm(), 1e-5);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
