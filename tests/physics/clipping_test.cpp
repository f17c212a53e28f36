// A patch clipped anew carries what the old one carried, and never holds more energy than it.
#include <memory>

#include "solver/step/energy.h"
#include "solver/step/make_snapshot.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// A cube pressed into a fixed one by `depth` m, then moved aside by `slide` m.
std::unique_ptr<Bench> pressed(double depth, double slide, double friction) {
  Assembly assembly = stone(2000.0, 1e9, 0.5);
  add_box(assembly, {0, 0, -0.5}, {0.5, 0.5, 0}, true);
  add_box(assembly, {0, 0, 0}, {0.5, 0.5, 0.5});
  auto made = std::make_unique<Bench>(joined(std::move(assembly), 4e9, 1.6e9, dry_law(friction)));
  Bench& bench = *made;
  bench.begin(1e-5);
  bench.place(1, {0, 0, -depth}, Eigen::Quaterniond::Identity());
  bench.stepper.patches_only();
  bench.place(1, {slide, 0, -depth}, Eigen::Quaterniond::Identity());
  bench.stepper.patches_only();
  return made;
}

double elastic(const Bench& bench) {
  double sum = 0.0;
  for (std::size_t i = 0; i < bench.model.joints.size() + bench.state.contacts.size(); ++i)
    sum += patch_energy(bench.model, bench.state, Branches{}, i).elastic;
  return sum;
}

/// Slid by 0.2 of 0.5 m it stands on 60 % of the area: the same force there would hold 5/3 of the energy.
TEST(Clipping, NeverPutsEnergyIn) {
  const double depth = 1e-4, area = 0.25, left = 0.15;
  const auto made = pressed(depth, 0.2, 0.0);
  Bench& bench = *made;
  const double before = elastic(bench);
  ASSERT_NEAR(before, 0.5 * 4e9 * area * depth * depth, 1e-9 * before);
  const ContactUpdate update = update_contacts(bench.model, bench.state, Branches{});
  ASSERT_EQ(update.clipped, 1);
  bench.stepper.prepare();
  bench.stepper.patches_only();
  EXPECT_LE(elastic(bench), before * (1.0 + 1e-9));
  EXPECT_GE(bench.state.clipped_energy(), -1e-9 * before);
  // As much force as that energy allows: N = √(2 kn A E).
  EXPECT_NEAR(std::abs(bench.stepper.wrenches[wrench_width * bench.model.joints.size() + 2]),
              std::sqrt(2.0 * 4e9 * left * before), 1e-6 * 4e9 * area * depth);
}

/// Slid by 6 % of its side, with friction, it keeps nearly all its area and nearly all its force.
TEST(Clipping, KeepsTheForceWhereItMay) {
  const auto made = pressed(1e-4, 0.03, 0.5);
  Bench& bench = *made;
  const double force = bench.stepper.wrenches[2], before = elastic(bench);
  ASSERT_EQ(update_contacts(bench.model, bench.state, Branches{}).clipped, 1);
  bench.stepper.prepare();
  bench.stepper.patches_only();
  const double* wrench = &bench.stepper.wrenches[wrench_width * bench.model.joints.size()];
  EXPECT_NEAR(wrench[2], force, 0.04 * std::abs(force)) << "6 % less area";
  EXPECT_LE(elastic(bench), before * (1.0 + 1e-9));
}

/// What has slid is the same joint: softer than its stones' moduli would make it, and with its own friction.
TEST(Clipping, KeepsStiffnessAndLaw) {
  const auto made = pressed(1e-4, 0.03, 0.5);
  Bench& bench = *made;
  const Patch joint = bench.model.joints[0];
  ASSERT_EQ(update_contacts(bench.model, bench.state, Branches{}).clipped, 1);
  const Patch& contact = bench.state.contacts.at(0);
  EXPECT_EQ(contact.kn, joint.kn);
  EXPECT_EQ(contact.ks, joint.ks);
  EXPECT_EQ(contact.law, joint.law);
}

/// A block that slides 0.3 m down a slope is clipped anew on the way, and has slipped 0.3 m all the same.
TEST(Clipping, ForgetsNoSlip) {
  Assembly assembly = stone(2000.0, 1e10, 0.2);
  add_box(assembly, {-1, 0, -0.5}, {3, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 0.4});
  SolverSettings settings;
  settings.gravity = {4.905, 0.0, -8.4957};
  Bench bench(joined(std::move(assembly), 1e10, 4e9, dry_law(0.2)), settings);
  bench.begin();
  ASSERT_TRUE(bench.run(std::int64_t(0.4 / bench.stepper.dt)));
  const double way = bench.displacement(1).x();
  ASSERT_GT(way, 0.25);
  const Snapshot snapshot = make_snapshot(bench.model, bench.state);
  ASSERT_EQ(snapshot.patches.size(), 2u);
  EXPECT_TRUE(snapshot.patches[0].replaced);
  EXPECT_FALSE(snapshot.patches[1].replaced);
  // Gravity at once makes it bounce, and what it goes in the air before it is clipped anew is no slip.
  EXPECT_NEAR(snapshot.patches[1].slip, way, 0.02 * way);
  EXPECT_NEAR(snapshot.patches[1].largest_slip, way, 0.02 * way);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
