// The state's arrays hold all of it: contacts survive being written as numbers, hashes see every array.
#include "solver/model/state.h"

#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// A block that has fallen on its corner upon another, so that there are contacts, with damping branches.
std::unique_ptr<Bench> fallen_block() {
  Assembly assembly = stone(2000.0, 1e8);
  add_box(assembly, {-1, -1, -1}, {1, 1, 0}, true);
  add_box(assembly, {-0.25, -0.25, 0.6}, {0.25, 0.25, 1.1});
  add_box(assembly, {0.5, 0.5, 0}, {0.9, 0.9, 0.4});
  SolverSettings settings = undamped({0, 0, -9.81});
  settings.damping.kind = DampingSettings::Kind::maxwell;
  auto bench = std::make_unique<Bench>(joined(std::move(assembly), 2e8, 8e7, dry_law(0.6)), settings);
  bench->begin(2e-4);
  bench->place(1, {0, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vec3(1, 1, 0).normalized())));
  for (int i = 0; i < 5000 && !(bench->velocity(1).z() > 0.0); ++i) bench->run(1);  // until it has hit
  return bench;
}

void copy_arrays(const Model& model, State& from, State& to) {
  const auto source = from.arrays();
  const auto target = to.arrays();
  ASSERT_EQ(source.size(), target.size());
  for (std::size_t i = 0; i < source.size(); ++i) {
    EXPECT_EQ(source[i].name, target[i].name);
    std::visit([&](auto* values) { *values = *std::get<std::remove_const_t<decltype(values)>>(source[i].data); },
               target[i].data);
  }
  to.unpack(model);
}

TEST(StateArrays, CarryTheContactsOver) {
  auto bench = fallen_block();
  ASSERT_FALSE(bench->state.contacts.empty());
  State copy = initial_state(bench->model);
  copy_arrays(bench->model, bench->state, copy);
  EXPECT_EQ(hash_arrays(copy.arrays()), hash_arrays(bench->state.arrays()));
  ASSERT_EQ(copy.contacts.size(), bench->state.contacts.size());
  for (std::size_t i = 0; i < copy.contacts.size(); ++i) {
    const Patch &p = copy.contacts[i], &q = bench->state.contacts[i];
    EXPECT_EQ(p.a, q.a);
    EXPECT_EQ(p.b, q.b);
    EXPECT_EQ(p.law, q.law);
    EXPECT_EQ(p.point_count, q.point_count);
    EXPECT_EQ(p.kn, q.kn);
    EXPECT_EQ(p.tt, q.tt);
    const auto same = [](const double* x, const double* y, int n) { return std::equal(x, x + n, y); };
    EXPECT_TRUE(same(p.gap, q.gap, 3) && same(p.shift, q.shift, 3) && same(p.place, q.place, 3));
    EXPECT_TRUE(same(p.e_a, q.e_a, 4) && same(p.e_b, q.e_b, 4));
    EXPECT_TRUE(same(p.arm_a, q.arm_a, 3) && same(p.arm_b, q.arm_b, 3));
  }
  // And goes on in the same way.
  bench->state = copy;
  bench->stepper.prepare();
  auto other = fallen_block();
  ASSERT_TRUE(bench->run(1000));
  ASSERT_TRUE(other->run(1000));
  EXPECT_EQ(hash_arrays(bench->state.arrays()), hash_arrays(other->state.arrays()));
}

TEST(StateArrays, EveryNumberCounts) {
  auto bench = fallen_block();
  ASSERT_FALSE(bench->state.contacts.empty());
  const std::uint64_t before = hash_arrays(bench->state.arrays());
  std::size_t tried = 0;
  const std::vector<NamedArray> list = bench->state.arrays();
  for (const NamedArray& array : list) {
    std::visit(
        [&](auto* values) {
          if (values->empty()) return;
          const auto kept = values->back();
          values->back() = kept + 1;
          EXPECT_NE(hash_arrays(list), before) << array.name;
          values->back() = kept;
          ++tried;
        },
        array.data);
  }
  EXPECT_GE(tried, 15u);
  EXPECT_EQ(hash_arrays(bench->state.arrays()), before);
  bench->state.contacts.back().gap[0] = std::nextafter(bench->state.contacts.back().gap[0], 1.0);
  EXPECT_NE(hash_arrays(bench->state.arrays()), before);
}

/// Rectangles alone, and polygons beside them.
TEST(BuildModel, TakesNoMoreMemoryThanItFills) {
  for (const Assembly& assembly : {generated("wall", {{"length_blocks", 20}, {"courses", 20}}),
                                   generated("cs1", {{"block_scale", 2.0}}), generated("arch", {})}) {
    const Model model = build_model(assembly, undamped({0, 0, -9.81}));
    const auto expect_full = [](const auto& list, const char* name) {
      EXPECT_GT(list.size(), 0u) << name;
      EXPECT_EQ(list.capacity(), list.size()) << name;
    };
    expect_full(model.bodies, "bodies");
    expect_full(model.joints, "joints");
    expect_full(model.corners, "corners");
    expect_full(model.batches, "batches");
    expect_full(model.batch_corners, "batch_corners");
    expect_full(model.points, "points");
    expect_full(model.sums, "sums");
  }
}

TEST(InitialState, BondsAreAsTheLawsSay) {
  Bench dry(generated("column", {{"blocks", 3}, {"kn", 1e9}, {"ks", 4e8}}));
  for (std::uint8_t mode : dry.state.joint.mode) EXPECT_EQ(mode, mode_broken);
  Assembly assembly = generated("column", {{"blocks", 3}, {"kn", 1e9}, {"ks", 4e8}});
  JointLaw law = dry_law(0.6);
  law.tension = 1e5, law.cohesion = 1e5;
  set_law(assembly, law);
  Bench bonded(std::move(assembly));
  for (std::uint8_t mode : bonded.state.joint.mode) EXPECT_EQ(mode, 0);
  for (std::uint8_t broken : bonded.state.joint.broken) EXPECT_EQ(broken, 0);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
