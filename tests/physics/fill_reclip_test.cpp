// Patches between stones and fill that slide on, run off an edge, or come to be.
#include "solver/contact/interface_jump.h"
#include "solver/contact/interface_search.h"
#include "tests/solver/models.h"
#include "tools/ladder/fill_models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

double covered(const State& state) {
  double area = 0.0;
  for (std::size_t slot = 0; slot < state.interface.patches.size(); ++slot) area += state.interface.patches[slot].area;
  return area;
}

/// Of the fill as a whole.
Vec3 mean_velocity(const ladder::Bench& bench) {
  Vec3 sum = Vec3::Zero();
  double mass = 0.0;
  for (std::size_t i = 0; i < bench.model.fill.nodes.size(); ++i) {
    sum += bench.model.fill.mass[i] * ladder::node_motion(bench.state, i);
    mass += bench.model.fill.mass[i];
  }
  return sum / mass;
}

Vec3 mean_place(const ladder::Bench& bench) {
  Vec3 sum = Vec3::Zero();
  double mass = 0.0;
  for (std::size_t i = 0; i < bench.model.fill.nodes.size(); ++i) {
    sum += bench.model.fill.mass[i] * (bench.model.fill.nodes[i] + Vec3(&bench.state.fill.pose[node_width * i]));
    mass += bench.model.fill.mass[i];
  }
  return sum / mass;
}

/// A slab of stiff fill, 1.5 × 1 × 0.4 m, on fixed stones half a metre long, from x = 0 to `end`; pressed down by its
/// weight already.
struct Slab : ladder::Bench {
  Slab(double end, double friction, const Vec3& gravity, double dilation = 0.0)
      : Bench(stones(end, friction, dilation), damped(gravity)) {
    for (std::size_t i = 0; i < model.fill.nodes.size(); ++i)
      ladder::move_node(state, i, {0, 0, 1500.0 * 0.4 * gravity.z() / 1e9});
    begin(1e-5);
  }
  static SolverSettings damped(const Vec3& gravity) {
    SolverSettings settings = ladder::undamped(gravity);
    settings.damping.kind = DampingSettings::Kind::maxwell;  // of its own vibrations, which would ease the friction
    settings.damping.ratio = 0.05, settings.damping.band = {50.0, 1000.0};
    return settings;
  }
  static Assembly stones(double end, double friction, double dilation) {
    Assembly assembly = stone();
    const double length = dilation > 0.0 ? end : 0.5;  // a stone that is reached anew knows nothing of dilation
    for (double x = 0.0; x < end - 1e-9; x += length) ladder::add_box(assembly, {x, 0, -1}, {x + length, 2, 0}, true);
    const Material stiff = ladder::elastic_fill(1500.0, 80e9 / 3.0, 16e9);
    JointLaw law = ladder::dry_law(friction);
    law.dilation_angle = dilation;
    return ladder::filled(std::move(assembly), ladder::box_mesh({0.5, 0.5, 0}, {2, 1.5, 0.4}, 3, 2, 1), stiff, 1e9,
                          0.4e9, law);
  }
};

TEST(FillReclip, ASlabSlidesFromStoneToStone) {
  const double angle = radians(40.0), friction = std::tan(radians(35.0));
  Slab slab(6.0, friction, 9.81 * Vec3(std::sin(angle), 0, -std::cos(angle)));
  EXPECT_NEAR(covered(slab.state), 1.5, 1e-9);
  ASSERT_TRUE(slab.run(10000));
  const double from = mean_velocity(slab).x(), time = slab.state.time();
  ASSERT_TRUE(slab.run(200000));
  const double expected = 9.81 * (std::sin(angle) - friction * std::cos(angle));
  EXPECT_NEAR((mean_velocity(slab).x() - from) / (slab.state.time() - time), expected, 0.01 * expected);
  // It has left the stones it lay on, and lies on others with all of its face.
  const double at = mean_place(slab).x();
  EXPECT_GT(at, 3.0);
  EXPECT_NEAR(covered(slab.state), 1.5, 0.05);
  for (std::size_t slot = 0; slot < slab.state.interface.patches.size(); ++slot) {
    if (!slab.state.interface.used(slot)) continue;
    const double x = slab.model.bodies[std::size_t(slab.state.interface.patches[slot].body)].centroid.x();
    EXPECT_LT(std::abs(x - at), 1.1);
    EXPECT_GT(slab.state.interface_memory.largest[largest_index(place_of_slot(slot), 1)], 0.0);
  }
}

/// A slab that has slid by d without friction and has risen by d tan ψ is pressed as before when its patches get other
/// outlines.
TEST(FillReclip, APatchThatHasDilatedKeepsItsPressure) {
  const double dilation = radians(5.0), slid = 0.2, risen = slid * std::tan(dilation);
  Slab slab(6.0, 0.0, {0, 0, -9.81}, dilation);
  for (std::size_t i = 0; i < slab.model.fill.nodes.size(); ++i)
    ladder::move_node(slab.state, i, {slid, 0, risen - 1500.0 * 0.4 * 9.81 / 1e9});
  const Interface& interface = slab.state.interface;
  for (std::size_t slot = 0; slot < interface.patches.size(); ++slot)
    for (std::size_t i = 0; i < interface.patches[slot].points.size(); ++i)
      slab.state.interface_memory.point_rest[interface.point_index(slot, i, 2, 0)] = risen;
  const auto energy = [&] {
    double sum = 0.0;
    for (std::size_t slot = 0; slot < interface.patches.size(); ++slot)
      if (interface.used(slot)) sum += interface_energy(slab.model, slab.state, slot);
    return sum;
  };
  const double before = energy(), pressure = 1500.0 * 0.4 * 9.81;
  EXPECT_NEAR(before, 0.5 * pressure * pressure / 1e9 * 1.5, 1e-6 * before);
  EXPECT_GT(update_contacts(slab.model, slab.state, slab.stepper.damping.branches).clipped, 0);
  EXPECT_NEAR(energy(), before, 1e-3 * before);
}

TEST(FillReclip, ASlabRunsOffTheEdgeAndFalls) {
  Slab slab(2.5, 0.0, {0, 0, -9.81});
  for (std::size_t i = 0; i < slab.model.fill.nodes.size(); ++i) slab.state.fill.motion[node_width * i] = 3.0;
  double first = 0.0, worst = 0.0;
  bool begun = false;
  ASSERT_TRUE(slab.run(80000, 100, [&](const BodyPass& pass) {
    const Energies e = compute_energies(slab.stepper, pass);
    if (!begun) first = e.total(), begun = true;
    worst = std::max(worst, std::abs(e.total() - first) / e.kinetic);
  }));
  EXPECT_LT(worst, 1e-3);
  EXPECT_GT(mean_place(slab).x() - 0.75, 2.6);
  EXPECT_EQ(covered(slab.state), 0.0);
  EXPECT_NEAR(mean_velocity(slab).x(), 3.0, 0.05);
  const double before = mean_velocity(slab).z(), time = slab.state.time();
  ASSERT_TRUE(slab.run(2000));
  EXPECT_NEAR((mean_velocity(slab).z() - before) / (slab.state.time() - time), -9.81, 1e-3);
}

/// A stone that touched no fill falls on it from 0.1 m and comes to rest.
TEST(FillReclip, AStoneFallsOnTheFill) {
  Assembly assembly = stone(2000.0);
  ladder::add_box(assembly, {0, 0, -1}, {2, 2, 0}, true);
  ladder::add_box(assembly, {0.7, 0.7, 0.6}, {1.3, 1.3, 1.2});
  const Material soil = ladder::elastic_fill(1500.0, 266.7e6, 160e6);
  SolverSettings settings = ladder::undamped({0, 0, -9.81});
  settings.damping.kind = DampingSettings::Kind::local;
  settings.damping.coefficient = 0.3;
  ladder::Bench bench(ladder::filled(std::move(assembly), ladder::box_mesh({0, 0, 0}, {2, 2, 0.5}, 4, 4, 1), soil, 1e9,
                                     0.4e9, ladder::dry_law(0.6)),
                      settings);
  bench.begin(1e-4);
  const double below = covered(bench.state);
  ASSERT_TRUE(bench.run(20000));
  EXPECT_GT(covered(bench.state), below + 0.3);
  const Vec3 u = bench.displacement(1);
  EXPECT_NEAR(u.z(), -0.1, 1e-3);
  EXPECT_LT(u.head<2>().norm(), 1e-3);
  EXPECT_LT(bench.velocity(1).norm(), 1e-3);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
