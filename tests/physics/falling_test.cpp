// Blocks that find their neighbours, and towers that stand (falls and collisions: tools/ladder).
#include "solver/run/simulation.h"
#include "solver/step/make_snapshot.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// A gap below the neighbour list's skin must close like any other: the block rests on the slab, not in it.
TEST(Falling, ThroughAGapSmallerThanTheSkin) {
  Assembly assembly = stone(2000.0, 1e8, 0.5);
  add_box(assembly, {-1, -1, -1}, {1, 1, 0}, true);
  const double gap = 1e-3;  // above the gap tolerance of 1e-4 m, below the skin of 5e-3 m
  add_box(assembly, {-0.25, -0.25, gap}, {0.25, 0.25, 0.5 + gap});
  SolverSettings settings;
  settings.gravity = {0, 0, -9.81};
  StageSettings free;
  free.kind = StageSettings::Kind::free;
  free.duration = 1.0;
  settings.stages = {free};
  settings.step.time_step = 1e-4;
  const Assembly finished = joined(std::move(assembly), 1e8, 4e7, dry_law(0.5));
  ASSERT_TRUE(finished.joints.empty());
  Simulation simulation(finished, settings, 1, {});
  ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  const double z = simulation.state().pose[pose_width * std::size_t(simulation.model().body_of_block[1]) + 2];
  const double sag = 2000 * 0.5 * 9.81 / (1.0 / (0.25 / 1e8 + 0.5 / 1e8));  // σ/kn of the contact, 0.07 mm
  EXPECT_NEAR(z, -gap - sag, 5e-4);
  // The gap that it fell through is no opening: no joint was there.
  const Snapshot snapshot = make_snapshot(simulation.model(), simulation.state());
  ASSERT_EQ(snapshot.patches.size(), 1u);
  EXPECT_EQ(snapshot.patches[0].largest_opening, 0.0);
}

/// Dynamic relaxation looks for contacts too: a loose block is caught by the slab below it.
TEST(Falling, RelaxationFindsTheSlab) {
  Assembly assembly = stone(2000.0, 1e8, 0.5);
  add_box(assembly, {-1, -1, -1}, {1, 1, 0}, true);
  add_box(assembly, {-0.9, -0.9, 0}, {-0.4, -0.4, 0.5});
  add_box(assembly, {0.1, 0.1, 0.03}, {0.6, 0.6, 0.53});
  SolverSettings settings;
  settings.gravity = {0, 0, -9.81};
  StageSettings gravity;
  gravity.method = StageSettings::Method::relaxation;
  gravity.allow_motion = true;
  settings.stages = {gravity};
  const Assembly finished = joined(std::move(assembly), 1e8, 4e7, dry_law(0.5));
  ASSERT_EQ(finished.joints.size(), 1u);
  Simulation simulation(finished, settings, 1, {});
  EXPECT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  const double z = simulation.state().pose[pose_width * std::size_t(simulation.model().body_of_block[2]) + 2];
  EXPECT_NEAR(z, -0.03, 1e-3);
}

/// A plank that spins about its own centroid strikes its neighbour, though its centroid never moves towards it.
TEST(Falling, ASpinningPlankDoesNotPassThroughItsNeighbour) {
  Assembly assembly = stone(2000.0, 1e10, 0.5);
  add_box(assembly, {0.7, 0.3, 0}, {0.9, 0.5, 0.2}, true);
  add_box(assembly, {-1, -0.05, 0}, {1, 0.05, 0.2});
  Bench bench(joined(std::move(assembly), 1e8, 4e7, dry_law(0.5)));
  bench.begin(1e-5);
  bench.push(1, Vec3::Zero(), {0, 0, 2.0});
  double overlap = 0.0;
  ASSERT_TRUE(bench.run(100000, 10, [&](const BodyPass&) { overlap = std::max(overlap, bench.overlap(0, 1)); }));
  EXPECT_LT(overlap, 0.01 * 0.2);
  EXPECT_GT(bench.state.contacts.size() + std::size_t(bench.state.counters[2]), 0u);
}

TEST(Standing, ATowerOfSevenBoxesStands) {
  Assembly assembly = stone(2000.0, 1e9, 0.6);
  add_box(assembly, {-1, -1, -0.5}, {1, 1, 0}, true);
  for (int i = 0; i < 7; ++i) add_box(assembly, {-0.25, -0.25, 0.5 * i}, {0.25, 0.25, 0.5 * (i + 1)});
  const Assembly finished = joined(std::move(assembly), 2e9, 8e8, dry_law(0.6));
  SolverSettings settings;
  StageSettings gravity, free;
  free.kind = StageSettings::Kind::free;
  free.duration = 5.0;
  settings.stages = {gravity, free};
  for (auto kind : {DampingSettings::Kind::maxwell, DampingSettings::Kind::none}) {
    settings.damping.kind = kind;
    Simulation simulation(finished, settings, 1, {});
    ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
    EXPECT_EQ(simulation.state().contacts.size(), 0u);
    for (std::size_t i = 0; i < simulation.model().bodies.size(); ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(simulation.state().pose[pose_width * i + std::size_t(c)],
                    simulation.state().baseline[pose_width * i + std::size_t(c)], 1e-9);
  }
}

/// Put down without any equilibrium first: it settles, and stands.
TEST(Standing, ATowerThatIsPutDownAtOnceSettles) {
  Assembly assembly = stone(2000.0, 1e8, 0.6);
  add_box(assembly, {-1, -1, -0.5}, {1, 1, 0}, true);
  for (int i = 0; i < 7; ++i) add_box(assembly, {-0.25, -0.25, 0.5 * i}, {0.25, 0.25, 0.5 * (i + 1)});
  SolverSettings settings;
  StageSettings free;
  free.kind = StageSettings::Kind::free;
  free.duration = 10.0;
  settings.stages = {free};
  const Assembly finished = joined(std::move(assembly), 2e8, 8e7, dry_law(0.6));
  Simulation simulation(finished, settings, 1, {});
  ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  const double* top = &simulation.state().pose[pose_width * std::size_t(simulation.model().body_of_block[7])];
  const double sag = 2000 * 0.5 * 9.81 * (7 + 6 + 5 + 4 + 3 + 2 + 1) / 2e8;
  EXPECT_NEAR(top[2], -sag, 0.2 * sag);
  EXPECT_LT(std::hypot(top[0], top[1]), 1e-6);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
