// States of a run brought to rest.
#include "solver/statics/settle.h"

#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// A wall whose top stone flies: the wall comes to rest, the stone stays where it was met.
TEST(Settle, HoldsWhatIsInTheAir) {
  Assembly assembly = generated("wall", {{"length_blocks", 3}, {"courses", 3}, {"kn", 4e9}, {"ks", 1.6e9}});
  set_law(assembly, dry_law(0.6));
  Bench bench(std::move(assembly), undamped({0, 0, -9.81}));
  const std::int64_t top = bench.assembly.groups.at("top")[0];
  bench.place(top, {0, 0, 2.0}, Eigen::Quaterniond::Identity());
  bench.push(top, {0, 3.0, 1.0});
  bench.push(2, {0.001, 0, 0});
  const Settled settled = settle(bench.stepper, 1e-6, nullptr, nullptr);
  EXPECT_TRUE(settled.equilibrium.converged) << settled.equilibrium.account;
  EXPECT_EQ(settled.falling, std::vector<std::int32_t>{bench.body(top)});
  EXPECT_GT(bench.displacement(top).z(), 1.5) << "held once it has fallen a little";
  EXPECT_LT(bench.displacement(2).norm(), 1e-4);
  EXPECT_EQ(bench.stepper.model, &bench.model) << "the model is as it was";
  EXPECT_FALSE(bench.model.bodies[std::size_t(bench.body(top))].fixed);
}

/// A stone that has only bounced, off the wall for an instant, lands and is part of it.
TEST(Settle, LetsLandWhatHasBounced) {
  Assembly assembly = generated("wall", {{"length_blocks", 3}, {"courses", 3}, {"kn", 4e9}, {"ks", 1.6e9}});
  set_law(assembly, dry_law(0.6));
  Bench bench(std::move(assembly), undamped({0, 0, -9.81}));
  const std::int64_t top = bench.assembly.groups.at("top")[0];
  bench.place(top, {0, 0, 1e-4}, Eigen::Quaterniond::Identity());
  const Settled settled = settle(bench.stepper, 1e-6, nullptr, nullptr);
  EXPECT_TRUE(settled.equilibrium.converged) << settled.equilibrium.account;
  EXPECT_TRUE(settled.falling.empty());
  EXPECT_LT(bench.displacement(top).z(), 0.0);
}

/// A stone whose support is gone comes off in the first round and is held in the next.
TEST(Settle, LetsGoOfWhatFalls) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  add_box(assembly, {1, 0, 0}, {2, 1, 1});  // beside it, on nothing, pressed by nothing
  Bench bench(joined(std::move(assembly), 1e9, 4e8, dry_law(0.6)), undamped({0, 0, -9.81}));
  const Settled settled = settle(bench.stepper, 1e-6, nullptr, nullptr);
  EXPECT_TRUE(settled.equilibrium.converged) << settled.equilibrium.account;
  EXPECT_EQ(settled.falling, std::vector<std::int32_t>{bench.body(2)});
  EXPECT_NEAR(bench.displacement(1).z(), -2000.0 * 9.81 / 1e9, 1e-7);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
