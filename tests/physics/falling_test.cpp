// Blocks that fall on one another: nothing passes through, energy never grows.
#include "solver/step/simulation.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace {

constexpr double side = 0.5;  // m

struct Fall {
  double overlap = 0.0;    // m, deepest so far
  double gain = 0.0;       // of stored energy over the starting one, share of the largest kinetic energy
  double imbalance = 0.0;  // of the ledger, same share
  double lowest = 1e300;   // m, of the block's centroid
  bool finished = false;
};

/// A cube falls from `gap` m above a fixed slab, turned by `rotation`, without damping unless said.
Fall drop(const Eigen::Quaterniond& rotation, double gap, double duration,
          DampingSettings::Kind damping = DampingSettings::Kind::none, const Vec3& aside = Vec3::Zero()) {
  Polyhedron cube = make_box(Vec3::Constant(-side / 2), Vec3::Constant(side / 2));
  double low = 1e300;
  for (const Vec3& v : cube.vertices) low = std::min(low, (rotation * v).z());
  Assembly assembly = stone(2000.0, 1e10, 0.5);
  add_box(assembly, {-1, -1, -1}, {1, 1, 0}, true);
  for (Vec3& v : cube.vertices) v += aside + Vec3(0, 0, gap - low);
  add_block(assembly, cube);
  SolverSettings settings = undamped({0, 0, -9.81});
  settings.damping.kind = damping;
  Bench bench(joined(std::move(assembly), 1e8, 4e7, dry_law(0.5)), settings);
  bench.place(1, Vec3::Zero(), rotation);
  bench.begin(1e-5);
  update_contacts(bench.model, bench.state, bench.stepper.damping.branches);
  bench.stepper.prepare();
  Fall fall;
  double first = 1e300, kinetic = 0.0;
  fall.finished = bench.run(std::int64_t(duration / 1e-5), 10, [&](const BodyPass& pass) {
    fall.overlap = std::max(fall.overlap, bench.overlap(0, 1));
    fall.lowest = std::min(fall.lowest, bench.assembly.blocks[1].centroid.z() + bench.displacement(1).z());
    const Energies e = compute_energies(bench.stepper, pass);
    if (first == 1e300) first = e.total();
    kinetic = std::max(kinetic, e.kinetic);
    fall.gain = std::max(fall.gain, e.stored() - first);
    fall.imbalance = std::max(fall.imbalance, std::abs(e.total() - first));
  });
  fall.gain /= kinetic, fall.imbalance /= kinetic;
  return fall;
}

void check(const Fall& fall, const char* what, double overlap = 0.01) {
  EXPECT_TRUE(fall.finished) << what;
  EXPECT_LT(fall.overlap, overlap * side) << what;
  EXPECT_GT(fall.lowest, 0.45 * side) << what;
  EXPECT_LT(fall.gain, 0.01) << what;
  EXPECT_LT(fall.imbalance, 0.01) << what;
}

void say(const Fall& fall, const std::string& what) {
  measured("Falling block, " + what + ": deepest overlap", 0.0, fall.overlap, "m");
  measured("Falling block, " + what + ": growth of energy", 0.0, fall.gain, "of the largest kinetic energy");
}

void check_aloud(const Fall& fall, const char* what, double overlap = 0.01) {
  check(fall, what, overlap);
  say(fall, what);
}

const Eigen::Quaterniond flat = Eigen::Quaterniond::Identity();
const Eigen::Quaterniond on_edge(Eigen::AngleAxisd(0.6, Vec3::UnitY()));
const Eigen::Quaterniond on_corner = Eigen::Quaterniond::FromTwoVectors(Vec3(1, 1, 1), Vec3(0.1, 0.05, -1));

TEST(Falling, FlatOnAFace) {
  check_aloud(drop(flat, 0.1, 0.8), "on a face");
}
TEST(Falling, OnAnEdge) {
  check_aloud(drop(on_edge, 0.1, 0.8), "on an edge");
}
TEST(Falling, OnACorner) {
  check_aloud(drop(on_corner, 0.1, 0.8), "on a corner");
}
/// 4900 J on a corner: the spring of a sharp contact gives way by 14 mm, 2.8 %.
TEST(Falling, FarAndFast) {
  check_aloud(drop(on_corner, 2.0, 1.2), "on a corner from 2 m", 0.05);
}
TEST(Falling, OverTheEdgeOfTheOther) {
  check_aloud(drop(on_edge, 0.1, 0.3, DampingSettings::Kind::none, {1.0, 0.3, 0}), "over the other's edge");
}

TEST(Falling, AnyWayUp) {
  std::mt19937 random(41);
  Fall worst;
  for (int i = 0; i < 12; ++i) {
    const Eigen::Quaterniond q = random_rotation(random);
    const Fall fall = drop(q, 0.05, 0.5);
    check(fall, ("number " + std::to_string(i)).c_str());
    worst.overlap = std::max(worst.overlap, fall.overlap), worst.gain = std::max(worst.gain, fall.gain);
  }
  say(worst, "12 ways up");
}

/// With damping it comes to rest on the slab.
TEST(Falling, ComesToRestWithDamping) {
  const Fall fall = drop(flat, 0.02, 3.0, DampingSettings::Kind::maxwell);
  EXPECT_LT(fall.overlap, 0.01 * side);
  EXPECT_NEAR(fall.lowest, side / 2, 0.01 * side);
}

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

/// Two free blocks, hard or soft (Young's modulus, Pa), fly at each other and part again: momentum is kept through the
/// contacts that come and go, and the soft ones, whose patches change while they press hard, are not thrown apart.
class Colliding : public testing::TestWithParam<double> {};

TEST_P(Colliding, KeepsMomentumAndGainsNoEnergy) {
  Assembly assembly = stone(2000.0, GetParam(), 0.5);
  add_box(assembly, {0, 0, 0}, {0.5, 0.5, 0.5});
  add_box(assembly, {0.8, 0.2, 0.1}, {1.3, 0.7, 0.6});
  Bench bench(joined(std::move(assembly), 1e8, 4e7, dry_law(0.5)));
  bench.begin(1e-5);
  bench.push(0, {1.0, 0, 0}, {0.3, 0.2, 0.5});
  bench.push(1, {-1.0, -0.2, 0}, {-0.4, 0.1, 0.2});
  const auto momenta = [&] {
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::int64_t block : {0, 1}) {
      const Body& body = bench.model.bodies[std::size_t(bench.body(block))];
      const Vec3 p = body.mass * bench.velocity(block), x = body.centroid + bench.displacement(block);
      sum.head<3>() += p;
      sum.tail<3>() += x.cross(p) + bench.momentum(block);
    }
    return sum;
  };
  const auto before = momenta();
  double overlap = 0.0, first = 1e300, worst = 0.0, gain = 0.0;
  ASSERT_TRUE(bench.run(60000, 10, [&](const BodyPass& pass) {
    overlap = std::max(overlap, bench.overlap(0, 1));
    const Energies e = compute_energies(bench.stepper, pass);
    if (first == 1e300) first = e.total();
    worst = std::max(worst, std::abs(e.total() / first - 1.0));
    gain = std::max(gain, e.stored() / first - 1.0);
  }));
  EXPECT_GT(bench.velocity(1).x(), -0.9) << "they have met";
  EXPECT_LT((momenta() - before).norm(), 1e-10 * before.norm());
  EXPECT_LT(overlap, (GetParam() < 1e9 ? 0.1 : 0.01) * 0.5);
  EXPECT_LT(gain, 0.01);
  EXPECT_LT(worst, 0.01);
  const std::string what =
      GetParam() < 1e9 ? "Two soft free blocks that collide" : "Two stiff free blocks that collide";
  measured(what + ": deepest overlap", 0.0, overlap, "m");
  measured(what + ": growth of energy", 0.0, gain, "of the energy");
}
INSTANTIATE_TEST_SUITE_P(Falling, Colliding, testing::Values(1e10, 1e8));

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
                    simulation.state().baseline[3 * i + std::size_t(c)], 1e-9);
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

}  // namespace
}  // namespace voussoir::test
