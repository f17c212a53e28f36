// The six springs of an intact patch are exactly its points: with and without the shortcut the same wrench, over a
// history of random motions below and across the limit.
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace {

Assembly two_blocks(int corners, const JointLaw& law, std::mt19937& random) {
  const Polygon polygon = random_polygon(corners, random);
  const Polygon reversed(polygon.rbegin(), polygon.rend());
  Assembly assembly = stone();
  const auto prism = [&](double height) {
    const Polyhedron shape = make_prism(polygon, {0, 0, height});
    return mass_properties(shape).volume > 0.0 ? shape : make_prism(reversed, {0, 0, height});
  };
  add_block(assembly, prism(-0.7));
  add_block(assembly, prism(0.6));
  return joined(std::move(assembly), 2e9, 8e8, law);
}

JointLaw weak_bond() {
  JointLaw law;
  law.tension = 1e5, law.cohesion = 1.5e5;
  law.friction_angle = law.residual_friction_angle = radians(35.0);
  return law;
}

/// A path of the second block's placement: sums of sines, so that it comes back, about a mean compression.
struct Path {
  explicit Path(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int c = 0; c < 6; ++c) {
      rate[c] = 0.5 + unit(random);
      phase[c] = 2 * pi * unit(random);
    }
  }
  double value(int c, double t) const { return std::sin(rate[c] * t + phase[c]); }
  double rate[6], phase[6];
};

struct Outcome {
  double worst = 0.0, largest = 0.0;
  std::int64_t intact = 0, points = 0;  // patch passes of the bench with the shortcut
  std::int64_t loaded = 0;  // those intact ones that carried anything: where nothing is carried, nothing is compared
  bool intact_after_points = false;
};

/// Moves both blocks of both benches alike for many steps; `reach` in m is how far, `aside` the share of it that all
/// motions but the normal one get.
Outcome compare(int corners, const JointLaw& law, DampingSettings::Kind damping, double press, double reach,
                unsigned seed, double aside = 1.0) {
  std::mt19937 random(seed), again(seed);
  SolverSettings on = undamped(), off = undamped();
  on.damping.kind = off.damping.kind = damping;
  off.step.intact_shortcut = false;
  Bench fast(two_blocks(corners, law, random), on), slow(two_blocks(corners, law, again), off);
  fast.begin(1e-3), slow.begin(1e-3);
  const Path path(random);
  const Eigen::Quaterniond whole = random_rotation(random);
  Outcome outcome;
  for (int i = 0; i < 3000; ++i) {
    const double t = 0.02 * i;
    const Vec3 move =
        reach * Vec3(aside * path.value(0, t), aside * path.value(1, t), path.value(2, t)) - Vec3(0, 0, press);
    const Vec3 turn = aside * reach * Vec3(path.value(3, t), path.value(4, t), path.value(5, t));
    const Eigen::Quaterniond q(std::sqrt(1 - 0.25 * turn.squaredNorm()), 0.5 * turn.x(), 0.5 * turn.y(),
                               0.5 * turn.z());
    for (Bench* bench : {&fast, &slow}) {
      bench->turn_about(0, Vec3::Zero(), whole);
      const Vec3 arm = bench->assembly.blocks[1].centroid;
      bench->place(1, whole * (q * arm + move) - arm, whole * q);
    }
    const PassReport report = fast.stepper.patches_only();
    slow.stepper.patches_only();
    outcome.intact += report.intact;
    outcome.points += report.points;
    outcome.intact_after_points |= report.intact > 0 && outcome.points > 0;
    double carried = 0.0;
    for (int c = 0; c < 6; ++c) {
      carried = std::max(carried, std::abs(fast.stepper.wrenches[std::size_t(c)]));
      outcome.worst = std::max(outcome.worst,
                               std::abs(fast.stepper.wrenches[std::size_t(c)] - slow.stepper.wrenches[std::size_t(c)]));
      outcome.largest = std::max(outcome.largest, std::abs(slow.stepper.wrenches[std::size_t(c)]));
    }
    outcome.loaded += report.intact > 0 && carried > 0.0;
  }
  return outcome;
}

/// Of the wrench. Maxwell branches are kept in single precision: six numbers rounded on one path, three a point on the
/// other, each to 6e-8 of a viscous stress that is up to a sixth of the elastic one and remembers some hundred
/// roundings.
double agreement(DampingSettings::Kind damping) {
  return damping == DampingSettings::Kind::maxwell ? 1e-7 : 1e-10;
}

void say(const char* motion, int corners, DampingSettings::Kind damping, const Outcome& o) {
  const std::map<DampingSettings::Kind, std::string> names = {{DampingSettings::Kind::none, "undamped"},
                                                              {DampingSettings::Kind::maxwell, "Maxwell"},
                                                              {DampingSettings::Kind::rayleigh, "Rayleigh"}};
  measured("Intact shortcut, " + std::string(motion) + ", " + std::to_string(corners) + " corners, " +
               names.at(damping) + ": largest difference",
           0.0, o.worst / o.largest,
           "of the largest wrench, " + std::to_string(o.loaded) + " loaded steps by the shortcut");
}

class Shortcut : public testing::TestWithParam<std::tuple<int, DampingSettings::Kind>> {};

TEST_P(Shortcut, SameWrenchBelowTheLimit) {
  const auto [corners, damping] = GetParam();
  const Outcome o = compare(corners, weak_bond(), damping, 2e-4, 1e-5, 21);
  say("below the limit", corners, damping, o);
  EXPECT_EQ(o.points, 0);
  EXPECT_LT(o.worst, agreement(damping) * o.largest);
}

TEST_P(Shortcut, SameWrenchAcrossTheLimit) {
  const auto [corners, damping] = GetParam();
  const Outcome o = compare(corners, weak_bond(), damping, 5e-5, 1e-4, 22);
  say("across the limit", corners, damping, o);
  EXPECT_GT(o.intact, 0);
  EXPECT_GT(o.points, 0);
  EXPECT_LT(o.worst, agreement(damping) * o.largest);
}

/// A joint without bond opens wholly, goes back to the intact path, closes and slides, over and over.
TEST_P(Shortcut, SameWrenchOfADryJointThatOpensAndCloses) {
  const auto [corners, damping] = GetParam();
  const Outcome o = compare(corners, dry_law(0.5), damping, 0.0, 1e-4, 23);
  say("dry joint", corners, damping, o);
  EXPECT_TRUE(o.intact_after_points);
  EXPECT_GT(o.points, 0);
  EXPECT_LT(o.worst, agreement(damping) * o.largest);
}

/// The same almost squarely: from wholly open to wholly closed in one step, loaded all the while it is closed.
TEST_P(Shortcut, SameWrenchOfADryJointThatBounces) {
  const auto [corners, damping] = GetParam();
  const Outcome o = compare(corners, dry_law(0.5), damping, 0.0, 1e-4, 24, 1e-3);
  say("bouncing dry joint", corners, damping, o);
  EXPECT_GT(o.loaded, 1000);
  EXPECT_LT(o.worst, agreement(damping) * o.largest);
}

INSTANTIATE_TEST_SUITE_P(Polygons, Shortcut,
                         testing::Combine(testing::Values(3, 4, 5, 8),
                                          testing::Values(DampingSettings::Kind::none, DampingSettings::Kind::maxwell,
                                                          DampingSettings::Kind::rayleigh)));

/// The same of a whole wall in motion: histories agree until rounding is amplified by sliding joints.
TEST(Shortcut, SameMotionOfAnElasticWall) {
  JointLaw law = weak_bond();
  law.tension = law.cohesion = 1e7;
  Vec3 top[2];
  double damping_loss[2];
  for (bool shortcut : {true, false}) {
    Assembly assembly = generated("wall", {{"length_blocks", 3}, {"courses", 4}});
    set_law(assembly, law);
    SolverSettings settings = undamped({0, 0, -9.81});
    settings.damping.kind = DampingSettings::Kind::maxwell;
    settings.step.intact_shortcut = shortcut;
    Bench bench(std::move(assembly), settings);
    bench.begin();
    GroundMotion motion;
    motion.dt = 0.05;
    motion.acceleration = {{0, 0, 0}, {2, 3, 0}, {-4, 1, 1}, {1, -2, 0}, {0, 0, 0}};
    bench.stepper.motion = &motion;
    ASSERT_TRUE(bench.run(3000));
    top[shortcut] = bench.displacement(bench.assembly.groups.at("top")[0]) - bench.state.base_displacement();
    damping_loss[shortcut] = 0.0;
    for (std::size_t i = 2; i < bench.state.joint.energy.size(); i += 3)
      damping_loss[shortcut] += bench.state.joint.energy[i];
  }
  EXPECT_LT((top[0] - top[1]).norm(), agreement(DampingSettings::Kind::maxwell) * top[0].norm());
  EXPECT_NEAR(damping_loss[0], damping_loss[1], agreement(DampingSettings::Kind::maxwell) * damping_loss[0]);
}

}  // namespace
}  // namespace voussoir::test
