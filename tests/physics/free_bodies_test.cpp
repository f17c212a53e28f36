// What free bodies keep, and how exactly they turn (motions without strain: tools/ladder).
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Two blocks joined by an elastic joint, no gravity, nothing fixed.
Assembly two_free_blocks() {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, 0}, {1.0, 0.8, 0.5});
  add_box(assembly, {0.2, 0.1, 0.5}, {1.1, 0.9, 1.3});
  return joined(std::move(assembly), 2e9, 8e8, elastic_law());
}

struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

/// P = Σ m v, and L about the origin = Σ x × m v + L; v and L of the last half step, x of the step after it: the
/// pairing that leapfrog keeps.
Momenta momenta(Bench& bench) {
  Momenta sum;
  for (std::int64_t block = 0; block < 2; ++block) {
    const Body& body = bench.model.bodies[std::size_t(bench.body(block))];
    const Vec3 p = body.mass * bench.velocity(block), x = body.centroid + bench.displacement(block);
    sum.linear += p;
    sum.angular += x.cross(p) + bench.momentum(block);
  }
  return sum;
}

void push_at_random(Bench& bench, double speed) {
  std::mt19937 random(17);
  for (std::int64_t block = 0; block < 2; ++block) {
    const Vec3 spin = Vec3(0.3, -0.2, 0.4) + random_vector(speed, random);
    const Vec3 velocity = Vec3(0.1, 0.2, -0.3) +
                          Vec3(0.3, -0.2, 0.4).cross(bench.assembly.blocks[std::size_t(block)].centroid) +
                          random_vector(speed, random);
    bench.push(block, velocity, spin);
  }
}

TEST(FreeBodies, KeepMomentumToRounding) {
  for (bool shortcut : {true, false}) {
    SolverSettings settings = undamped();
    settings.damping.kind = DampingSettings::Kind::maxwell;
    settings.step.intact_shortcut = shortcut;
    Bench bench(two_free_blocks(), settings);
    bench.begin();
    bench.stepper.search_distance = 1e300;
    push_at_random(bench, 0.2);
    const Momenta before = momenta(bench);
    ASSERT_TRUE(bench.run(10000));
    const Momenta after = momenta(bench);
    EXPECT_LT((after.linear - before.linear).norm(), 1e-11 * before.linear.norm());
    EXPECT_LT((after.angular - before.angular).norm(), 1e-11 * before.angular.norm());
    EXPECT_TRUE(bench.state.contacts.empty());
  }
}

TEST(FreeBodies, KeepEnergy) {
  Bench bench(two_free_blocks());
  bench.begin(0.1 * critical_step(bench.model, bench.state).step);
  bench.stepper.search_distance = 1e300;
  push_at_random(bench, 0.2);
  ASSERT_TRUE(bench.run(1));
  double first = 0.0, worst = 0.0;
  ASSERT_TRUE(bench.run(10000, 1, [&](const BodyPass& pass) {
    const double total = compute_energies(bench.stepper, pass).total();
    if (first == 0.0) first = total;
    worst = std::max(worst, std::abs(total / first - 1.0));
  }));
  EXPECT_LT(worst, 1e-3);
}

/// The ledger must hold at the step that runs really use, 0.8 of the critical one, whatever the frequencies in the
/// motion: leapfrog keeps ½ v⁻·M v⁺ + ½ u·K u of a linear system exactly.
TEST(FreeBodies, KeepEnergyAtTheDefaultStep) {
  Bench bench(two_free_blocks());
  bench.begin();
  bench.stepper.search_distance = 1e300;
  push_at_random(bench, 0.2);
  double first = 0.0, worst = 0.0;
  ASSERT_TRUE(bench.run(1));
  ASSERT_TRUE(bench.run(10000, 1, [&](const BodyPass& pass) {
    const double total = compute_energies(bench.stepper, pass).total();
    if (first == 0.0) first = total;
    worst = std::max(worst, std::abs(total / first - 1.0));
  }));
  EXPECT_LT(worst, 1e-3);
}

TEST(FreeSpin, ConvergesWithTheSquareOfTheStep) {
  const auto orientation = [](int steps) {
    Bench bench(asymmetric_block());
    bench.begin(2.0 / steps);
    bench.stepper.search_distance = 1e300;
    bench.push(0, Vec3::Zero(), Vec3(1.0, 2.0, 3.0));
    bench.run(steps);
    return bench.rotation(0).toRotationMatrix();
  };
  const Mat3 exact = orientation(51200);
  double before = 0.0;
  for (int steps : {200, 400, 800, 1600}) {
    const double error = (orientation(steps) - exact).norm();
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.1) << steps;
    }
    before = error;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
