// Fill between stones: the same bits for any number of threads, as the plain serial loop, and when its arrays are
// carried over to another run.
#include <optional>

#include "solver/contact/search.h"
#include "tests/solver/models.h"
#include "tools/ladder/fill_models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// A trough of fixed stones filled with weak soil, four loose stones on top.
Assembly trough() {
  Assembly assembly = stone();
  ladder::add_box(assembly, {-1, -1, -1}, {5, 3, 0}, true);
  ladder::add_box(assembly, {-1, -1, 0}, {0, 3, 2}, true);
  ladder::add_box(assembly, {4, -1, 0}, {5, 3, 2}, true);
  for (int i = 0; i < 4; ++i) ladder::add_box(assembly, {1.0 * i, 0, 1.5}, {1.0 * i + 1, 2, 2}, false);
  Material soil = ladder::elastic_fill(1500.0, 80e6, 50e6);
  soil.cohesion = 3e3, soil.friction_angle = radians(35.0), soil.dilation_angle = radians(5.0);
  return ladder::filled(std::move(assembly), ladder::box_mesh({0, 0, 0}, {4, 2, 1.5}, 9, 6, 5), soil, 5e8, 2e8,
                        ladder::dry_law(0.7));
}

GroundMotion strong_motion() {
  GroundMotion motion;
  motion.dt = 0.01;
  for (double t = 0.0; t < 1.0; t += motion.dt)
    motion.acceleration.emplace_back(9 * std::sin(2 * pi * 6 * t), 8 * std::sin(2 * pi * 7 * t),
                                     6 * std::sin(2 * pi * 5 * t));
  return motion;
}

struct Shaken : ladder::Bench {
  GroundMotion motion = strong_motion();
  explicit Shaken(int threads, DampingSettings::Kind kind = DampingSettings::Kind::maxwell, double dt = 5e-5,
                  bool single = true)
      : Bench(trough(), ladder::undamped({0, 0, -9.81})) {
    settings.damping.kind = kind;
    begin(dt);
    stepper.search_distance = 1e300;
    stepper.motion = &motion;
    stepper.threads = threads;
    stepper.single = single;
  }
  std::uint64_t hash() { return hash_arrays(state.arrays()); }
  int flowed() const {
    int count = 0;
    for (const std::uint8_t bits : state.fill.yield) count += bits != 0;
    return count;
  }
};

TEST(FillThreads, GiveTheSameBits) {
  Shaken one(1);
  ASSERT_GT(one.model.fill.tiles.size(), 3u);
  ASSERT_TRUE(one.run(1500));
  EXPECT_GT(one.flowed(), 100);
  for (const int threads : {2, 3}) {
    Shaken many(threads);
    ASSERT_TRUE(many.run(1500));
    EXPECT_EQ(many.hash(), one.hash()) << threads;
  }
}

TEST(FillThreads, EqualTheSerialLoop) {
  if (kernels_are_compiled_apart())
    GTEST_SKIP() << "the kernels for " << kernels().instructions << " are compiled apart";
  for (const auto kind : {DampingSettings::Kind::none, DampingSettings::Kind::maxwell, DampingSettings::Kind::local}) {
    Shaken team(3, kind), oracle(1, kind);
    ASSERT_TRUE(team.run(400));
    for (int step = 0; step < 400; ++step) serial_step(oracle.stepper);
    EXPECT_EQ(team.hash(), oracle.hash());
  }
}

/// With stones and soil that come to lie elsewhere: patches made, clipped anew and dropped on the way.
TEST(FillThreads, GiveTheSameBitsWithNewPatches) {
  const auto shaken = [](int threads) {
    auto bench = std::make_unique<Shaken>(threads);
    bench->stepper.search_distance = search_distance(bench->model);
    return bench;
  };
  const auto one = shaken(1), two = shaken(2), first = shaken(3), second = shaken(2);
  const auto used = [](const Shaken& bench) {
    std::size_t count = 0;
    for (std::size_t slot = 0; slot < bench.state.interface.patches.size(); ++slot)
      count += bench.state.interface.used(slot);
    return count;
  };
  const std::size_t before = used(*one);
  ASSERT_TRUE(one->run(6000));
  EXPECT_GT(one->state.counters[1], 0) << "nothing was looked for";
  EXPECT_NE(used(*one), before) << "too tame to be a test";
  ASSERT_TRUE(two->run(6000));
  EXPECT_EQ(two->hash(), one->hash());
  ASSERT_TRUE(first->run(3500));
  std::size_t empty = 0;  // lanes of patches that have been dropped, which must be carried over as well
  for (std::size_t slot = 0; slot < first->state.interface.patches.size(); ++slot)
    empty += !first->state.interface.used(slot) && !first->state.interface.spare(slot);
  EXPECT_GT(empty, 0u);
  std::vector<NamedArray> from = first->state.arrays(), to = second->state.arrays();
  for (std::size_t i = 0; i < from.size(); ++i)
    std::visit([&](auto* array) { *array = *std::get<decltype(array)>(from[i].data); }, to[i].data);
  second->state.unpack(second->model);
  second->stepper.prepare();
  ASSERT_TRUE(second->run(2500));
  EXPECT_EQ(second->hash(), one->hash());
}

TEST(FillThreads, SamplesChangeNothing) {
  Shaken plain(2), sampled(2);
  ASSERT_TRUE(plain.run(500));
  double kinetic = 0.0;
  ASSERT_TRUE(
      sampled.run(500, 3, [&](const BodyPass& pass) { kinetic += compute_energies(sampled.stepper, pass).kinetic; }));
  EXPECT_GT(kinetic, 0.0);
  EXPECT_EQ(plain.hash(), sampled.hash());
}

TEST(FillThreads, GoOnFromTheirArrays) {
  Shaken whole(2), first(2), second(1);
  ASSERT_TRUE(whole.run(1500));
  ASSERT_TRUE(first.run(700));
  std::vector<NamedArray> from = first.state.arrays(), to = second.state.arrays();
  ASSERT_EQ(from.size(), to.size());
  for (std::size_t i = 0; i < from.size(); ++i)
    std::visit([&](auto* array) { *array = *std::get<decltype(array)>(from[i].data); }, to[i].data);
  second.state.unpack(second.model);
  second.stepper.prepare();
  ASSERT_TRUE(second.run(800));
  EXPECT_EQ(second.hash(), whole.hash());
}

struct Ledger {
  double worst = 0.0, largest = 0.0;  // J: what does not add up; of all that does
  Energies end;
};

/// Shaken for 0.2 s.
Ledger ledger(DampingSettings::Kind kind, int steps, bool single) {
  Shaken bench(2, kind, 0.2 / steps, single);
  Ledger l;
  std::optional<double> first;
  EXPECT_TRUE(bench.run(steps, 10, [&](const BodyPass& pass) {
    const Energies e = l.end = compute_energies(bench.stepper, pass);
    if (!first) first = e.total();
    l.largest =
        std::max({l.largest, e.kinetic, e.elastic, std::abs(e.gravitational), std::abs(e.external_work), e.plastic});
    l.worst = std::max(l.worst, std::abs(e.total() - *first));
  }));
  EXPECT_GT(l.end.plastic + l.end.friction, 0.05 * l.largest);
  return l;
}

/// What was put in is stored or lost: with friction, plastic flow and patches clipped anew, to the order of the step.
TEST(FillThreads, KeepTheLedger) {
  for (const bool single : {false, true}) {
    const Ledger whole = ledger(DampingSettings::Kind::none, 4000, single),
                 half = ledger(DampingSettings::Kind::none, 8000, single);
    EXPECT_LT(whole.worst, 1e-4 * whole.largest) << single;
    EXPECT_LT(half.worst, 0.6 * whole.worst) << single;
  }
}

/// Branches know the work done on them to the first order of the elastic strain (docs/theory/fill.md): a part of what
/// they lose is left over however short the step.
TEST(FillThreads, KeepTheLedgerOfBranches) {
  for (const bool single : {false, true}) {
    const Ledger whole = ledger(DampingSettings::Kind::maxwell, 4000, single),
                 half = ledger(DampingSettings::Kind::maxwell, 8000, single);
    EXPECT_LT(whole.worst, 3e-4 * whole.largest) << single;
    EXPECT_GT(half.end.joint_damping, 0.01 * half.largest) << single;
    EXPECT_LT(2.0 * half.worst - whole.worst, 0.01 * half.end.joint_damping) << single;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
