// Motions without strain, and what free bodies keep.
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace {

Assembly bonded_stack() {
  Assembly assembly = generated("column", {{"blocks", 5}, {"kn", 4e9}, {"ks", 1.6e9}});
  JointLaw law = dry_law(0.6);
  law.tension = law.cohesion = 1e5;
  set_law(assembly, law);
  return assembly;
}

/// A stack turned as a whole through 90° has no stress: below 1e-9 of kn × size, and nothing is left behind afterwards.
TEST(RigidRotation, OfABondedStackThrough90DegreesIsWithoutStress) {
  for (bool shortcut : {true, false}) {
    SolverSettings settings = undamped();
    settings.damping.kind = DampingSettings::Kind::maxwell;
    settings.step.intact_shortcut = shortcut;
    Bench bench(bonded_stack(), settings);
    bench.begin();
    const Vec3 centre(3.0, -2.0, 0.5), axis = Vec3(1, 2, -0.5).normalized();
    double worst = 0.0;
    for (int degrees = 0; degrees <= 90; ++degrees) {
      const Eigen::Quaterniond q(Eigen::AngleAxisd(radians(degrees), axis));
      for (std::int64_t block = 0; block < std::int64_t(bench.assembly.blocks.size()); ++block)
        bench.turn_about(block, centre, q);
      bench.stepper.patches_only();
      for (std::size_t i = 0; i < bench.model.joints.size(); ++i) {
        const double* w = &bench.stepper.wrenches[wrench_width * i];
        worst = std::max(worst, Vec3(w[0], w[1], w[2]).norm() / bench.model.joints[i].area);
      }
    }
    EXPECT_LT(worst, 1e-9 * 4e9 * 1.0);
    measured(std::string("Stack turned through 90 degrees, ") + (shortcut ? "shortcut" : "point by point") +
                 ": largest stress",
             0.0, worst / (4e9 * 1.0), "of kn x size");
    for (std::uint8_t mode : bench.state.joint.mode) EXPECT_EQ(mode & mode_broken, 0);
    for (double energy : bench.state.joint.energy) EXPECT_LT(energy, 1e-9);
  }
}

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

/// A block of three different sides; second axis intermediate.
Assembly asymmetric_block() {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, 0}, {0.5, 1.0, 2.0});
  return joined(std::move(assembly), 1e9, 1e9, elastic_law());
}

double spin_energy(Bench& bench) {
  const Body& body = bench.model.bodies[0];
  const Vec3 local = bench.rotation(0).conjugate() * bench.momentum(0);
  return 0.5 * local.dot(body.inverse_inertia * local);
}

/// Spin about the intermediate axis with a slight push aside: it flips over and over (Euler 1765).
TEST(FreeSpin, AboutTheIntermediateAxisKeepsEnergyAndMomentum) {
  Bench bench(asymmetric_block());
  bench.begin(2 * pi / 4000);  // spin 1 rad/s: 4000 steps a turn
  bench.stepper.search_distance = 1e300;
  bench.push(0, Vec3::Zero(), Vec3(1e-3, 1.0, 2e-3));
  const double energy = spin_energy(bench);
  const Vec3 momentum = bench.momentum(0);
  double worst = 0.0, least = 1.0;
  for (int i = 0; i < 100 * 400; ++i) {
    ASSERT_TRUE(bench.run(10));
    worst = std::max(worst, std::abs(spin_energy(bench) / energy - 1.0));
    const Vec3 local = bench.rotation(0).conjugate() * bench.momentum(0);
    least = std::min(least, local.y() / momentum.norm());
  }
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT((bench.momentum(0) - momentum).norm(), 1e-6 * momentum.norm());
  EXPECT_LT(least, -0.9) << "it flips";
  measured("Free spin, 100 turns: largest change of energy", 0.0, worst, "relative");
  measured("Free spin, 100 turns: change of momentum", 0.0, (bench.momentum(0) - momentum).norm() / momentum.norm(),
           "relative");
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

}  // namespace
}  // namespace voussoir::test
