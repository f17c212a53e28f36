// Stones that meet along edges: their contact's normal is one of the pair.
#include "solver/run/simulation.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double gravity = 9.81, length = 2.0, thick = 0.2, density = 2000.0;
const double weight = length * thick * density * gravity;
/// By moments of a slab about its foot: the force at the ridge is level.
const double thrust_share =
    (0.5 * length * std::sin(radians(30)) - 0.5 * thick * std::cos(radians(30))) / (length * std::cos(radians(30)));

/// A bar along y, its section going round either way.
Polyhedron bar(const Polygon& section) {
  Polyhedron shape = make_prism(section, {0, 1, 0});
  if (mass_properties(shape).volume < 0.0)
    for (auto& face : shape.faces) std::reverse(face.begin(), face.end());
  return shape;
}

/// Two slabs of this section, and its mirror image, on a floor.
Assembly pair_on_floor(const Polygon& left, double friction_degrees) {
  Assembly assembly = stone(density, 1e10, std::tan(radians(friction_degrees)));
  add_box(assembly, {-3, -0.5, -0.5}, {3, 1.5, 0}, true);
  Polygon right;
  for (auto p = left.rbegin(); p != left.rend(); ++p) right.emplace_back(-p->x(), p->y(), p->z());
  add_block(assembly, bar(left));
  add_block(assembly, bar(right));
  return joined(std::move(assembly), 1e10, 4e9, dry_law(std::tan(radians(friction_degrees))));
}

/// Two plain slabs lean against each other by 30 degrees from upright, with edges on a floor and at the ridge.
Assembly roof(double friction_degrees) {
  const double s = std::sin(radians(30)), c = std::cos(radians(30));
  return pair_on_floor({{-length * s, 0, 0},
                        {0, 0, length * c},
                        {-thick * c, 0, length * c + thick * s},
                        {-length * s - thick * c, 0, thick * s}},
                       friction_degrees);
}

/// The same with its ridge cut so that the faces there stand open by twice `open` (degrees) above the edges that meet.
Assembly mitred_roof(double friction_degrees, double open) {
  const double s = std::sin(radians(30)), c = std::cos(radians(30));
  const double up = thick / (s + c * std::tan(radians(open)));  // from the ridge to where the cut leaves the slab
  return pair_on_floor({{-length * s, 0, 0},
                        {0, 0, length * c},
                        {-up * std::tan(radians(open)), 0, length * c + up},
                        {-length * s - thick * c, 0, thick * s}},
                       friction_degrees);
}

SolverSettings under_gravity(bool at_rest) {
  SolverSettings settings;
  settings.gravity = {0, 0, -gravity};
  if (at_rest) settings.stages = {StageSettings{}};
  StageSettings free;
  free.kind = StageSettings::Kind::free;
  free.duration = 0.5;
  if (!at_rest) settings.stages = {free};
  return settings;
}

Vec3 moved(const Simulation& simulation, int block) {
  return Vec3(&simulation.state().pose[pose_width * std::size_t(simulation.model().body_of_block[std::size_t(block)])]);
}

/// Two slabs that nothing joins, and that stand by their edges.
void expect_alike_on_both_sides(const Assembly& assembly, bool at_rest) {
  ASSERT_TRUE(assembly.joints.empty());
  Simulation simulation(assembly, under_gravity(at_rest), 1, {});
  ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  const Vec3 left = moved(simulation, 1), right = moved(simulation, 2);
  EXPECT_LT(left.norm(), 2e-3);
  EXPECT_NEAR(left.x(), -right.x(), 1e-7);
  EXPECT_NEAR(left.z(), right.z(), 1e-7);
  EXPECT_NEAR(left.y(), 0.0, 1e-7);
}

TEST(Edges, AStableRoofStandsAndMovesAlikeOnBothSides) {
  ASSERT_NEAR(thrust_share, 0.239, 1e-3) << "feet need 13.4 degrees";
  for (const bool at_rest : {true, false})
    for (const double friction : {28.0, 20.0, 15.0}) {
      SCOPED_TRACE(friction);
      expect_alike_on_both_sides(roof(friction), at_rest);
    }
}

TEST(Edges, ARoofFallsWhereItsFeetCannotHoldIt) {
  const Assembly assembly = roof(12.0);
  Simulation simulation(assembly, under_gravity(true), 1, {});
  simulation.run();
  EXPECT_GT(moved(simulation, 1).norm(), 0.1);
}

/// The ridge is a contact from the first search on and carries the level force of equilibrium, without friction.
TEST(Edges, TheRidgeCarriesALevelForce) {
  const Assembly assembly = roof(28.0);
  Bench bench(assembly, undamped({0, 0, -gravity}));
  update_contacts(bench.model, bench.state, {});
  bench.stepper.prepare();
  ASSERT_TRUE(bench.balance(1e-8).converged);
  int ridges = 0;
  for (std::size_t slot = 0; slot < bench.state.contacts.size(); ++slot) {
    const Patch& p = bench.state.contacts[slot];
    if (!bench.state.has_contact(slot) || std::min(p.a, p.b) == bench.body(0)) continue;
    if (p.a == bench.body(0) || p.b == bench.body(0)) continue;
    ++ridges;
    const Vec3 force = bench.wrench_on(1, bench.model.joints.size() + slot, Vec3::Zero()).first;
    EXPECT_NEAR(force.x(), -thrust_share * weight, 2e-3 * weight) << "1873 N";
    EXPECT_LT(std::hypot(force.y(), force.z()), 2e-3 * weight);
  }
  EXPECT_EQ(ridges, 1);
}

TEST(Edges, AMitredRoofThatStandsOpenMovesAlikeOnBothSides) {
  for (const double open : {0.2, 1.0, 5.0, 20.0}) {
    SCOPED_TRACE(open);
    expect_alike_on_both_sides(mitred_roof(28.0, open), true);
  }
}

/// A bar of three sides stands on its edge on the edge of a square one that lies along it, upright and without
/// friction: pressed straight up, it leans to neither side.
TEST(Edges, ABarStandsOnAnEdgeAlongItsOwn) {
  Assembly assembly = stone(density, 1e10, 0.0);
  add_block(assembly, bar({{-0.1, -0.5, -0.1}, {0, -0.5, -0.2}, {0.1, -0.5, -0.1}, {0, -0.5, 0}}), true);
  add_block(assembly, bar({{0, -0.5, 0}, {0.1, -0.5, 0.17}, {-0.1, -0.5, 0.17}}));
  assembly = joined(std::move(assembly), 1e10, 4e9, dry_law(0.0));
  SolverSettings settings = under_gravity(false);
  settings.stages[0].duration = 0.05;
  settings.step.time_step = 1e-5;
  Simulation simulation(assembly, settings, 1, {});
  ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  const Vec3 on = moved(simulation, 1);
  EXPECT_NEAR(on.x(), 0.0, 1e-9);
  EXPECT_GT(on.z(), -1e-5) << "in free fall: 12 mm";
}

/// A block stands with two edges on the inner edges of two walls, its sides in line with theirs: nothing is below it.
TEST(Edges, ABlockFallsBetweenWallsInLineWithItsSides) {
  Assembly assembly = stone(density, 1e10, 0.0);
  add_box(assembly, {-1, -1, -1}, {0, 2, 1}, true);
  add_box(assembly, {0.5, -1, -1}, {1.5, 2, 1}, true);
  add_box(assembly, {0, 0, 1}, {0.5, 1, 1.5});
  const Assembly joined_up = joined(std::move(assembly), 1e10, 4e9, dry_law(0.0));
  ASSERT_TRUE(joined_up.joints.empty());
  SolverSettings settings = under_gravity(false);
  settings.stages[0].duration = 0.1;
  settings.step.time_step = 1e-4;
  Simulation simulation(joined_up, settings, 1, {});
  ASSERT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  EXPECT_NEAR(moved(simulation, 2).z(), -0.5 * gravity * 0.01, 1e-3 * 0.05);
}

/// Random convex stones fall on a floor and on each other.
struct Rain {
  double overlap = 0.0, growth = 0.0, kinetic = 0.0;
  Vec3 place = Vec3::Zero();
};
Rain rain(unsigned seed, bool mirrored) {
  std::mt19937 random(seed);
  Assembly assembly = stone(2000.0, 1e9, 0.5);
  std::vector<Polyhedron> stones = {make_box({-3, -3, -1}, {3, 3, 0})};
  for (int i = 0; i < 2; ++i) {
    Polyhedron box = make_box({-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25});
    box = cut(box, {random_vector(1.0, random).normalized(), 0.2});
    const Mat3 turn = random_rotation(random).toRotationMatrix();
    const Vec3 at = Vec3(0.1, 0.1, 0.0).cwiseProduct(random_vector(1.0, random)) + Vec3(0, 0, 0.47 + 0.95 * i);
    for (Vec3& v : box.vertices) v = turn * v + at;
    stones.push_back(box);
  }
  for (std::size_t i = 0; i < stones.size(); ++i) {
    if (mirrored) {
      for (Vec3& v : stones[i].vertices) v.x() = -v.x();
      for (auto& face : stones[i].faces) std::reverse(face.begin(), face.end());
    }
    add_block(assembly, stones[i], i == 0);
  }
  Bench bench(joined(std::move(assembly), 1e9, 4e8, dry_law(0.5)), undamped({0, 0, -gravity}));
  update_contacts(bench.model, bench.state, {});
  bench.stepper.prepare();
  const double dt = 5e-5;
  bench.begin(dt);
  Rain out;
  double first = 1e300;
  const bool stayed = bench.run(std::int64_t(0.5 / dt), 10, [&](const BodyPass& pass) {
    for (int i = 0; i < 3; ++i)
      for (int j = i + 1; j < 3; ++j) out.overlap = std::max(out.overlap, bench.overlap(i, j));
    const Energies e = compute_energies(bench.stepper, pass);
    if (first == 1e300) first = e.stored();
    out.kinetic = std::max(out.kinetic, e.kinetic);
    out.growth = std::max(out.growth, e.stored() - first);
  });
  EXPECT_TRUE(stayed);
  out.place = bench.displacement(1);
  return out;
}

TEST(Edges, FiveHundredStonesFallAndNonePassesAnother) {
  double overlap = 0.0, growth = 0.0;
  for (unsigned seed = 1; seed <= 250; ++seed) {  // two stones each
    const Rain r = rain(seed, false);
    overlap = std::max(overlap, r.overlap);
    growth = std::max(growth, r.growth / r.kinetic);
  }
  measured("500 stones dropped: largest overlap over size", 0.0, overlap / 0.5, "-");
  measured("500 stones dropped: largest growth of energy over kinetic energy", 0.0, growth, "-");
  EXPECT_LT(overlap, 0.1 * 0.5);
  EXPECT_LT(growth, 0.01);
}

TEST(Edges, MirroredStonesFallMirrored) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Vec3 one = rain(seed, false).place, other = rain(seed, true).place;
    EXPECT_LT((one - Vec3(-other.x(), other.y(), other.z())).norm(), 1e-9) << seed;
  }
}

/// A cube falls by 0.1 m without damping; the step is that of another cube's joint with the ground, of the same
/// stiffness.
double error_of_a_drop(const Mat3& turn, double safety) {
  Assembly assembly = stone(density, 1e9, 0.5);
  add_box(assembly, {-3, -3, -0.5}, {3, 3, 0}, true);
  add_box(assembly, {1.5, -0.25, 0}, {2.0, 0.25, 0.5});
  Polyhedron cube = make_box({-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25});
  double lowest = 0.0;
  for (Vec3& v : cube.vertices) v = turn * v, lowest = std::min(lowest, v.z());
  for (Vec3& v : cube.vertices) v.z() += 0.1 - lowest;
  add_block(assembly, cube);
  assembly = joined(std::move(assembly), 2e9, 8e8, dry_law(0.5));
  SolverSettings settings = under_gravity(false);
  settings.step.safety = safety;
  Simulation simulation(assembly, settings, 1, {});
  EXPECT_EQ(simulation.run(), RunEnd::finished) << simulation.failure();
  return simulation.worst_balance();
}

/// Stiff contacts last two or three steps: what an undamped impact gets wrong falls with the step.
TEST(Edges, UndampedImpactsErrByTheStep) {
  const Vec3 across = Vec3(1, -1, 0).normalized(), askew = Vec3(1.0, 0.3, 0.2).normalized();
  const std::map<std::string, Mat3> ways = {
      {"face", Mat3::Identity()},
      {"edge", Eigen::AngleAxisd(radians(45), Vec3::UnitY()).toRotationMatrix()},
      {"corner", Eigen::AngleAxisd(std::atan(std::sqrt(2.0)), across).toRotationMatrix()},
      {"askew", Eigen::AngleAxisd(0.7, askew).toRotationMatrix()}};
  std::map<double, double> sums;  // by safety
  for (const auto& [way, turn] : ways)
    for (const double safety : {0.8, 0.4, 0.2}) {
      const double error = error_of_a_drop(turn, safety);
      measured("Cube dropped on its " + way + ", undamped, safety " + std::to_string(safety).substr(0, 3) +
                   ": energy error over work done",
               0.0, error, "-");
      sums[safety] += error;
    }
  EXPECT_LT(sums.at(0.4), 0.5 * sums.at(0.8));
  EXPECT_LT(sums.at(0.2), 0.5 * sums.at(0.4));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
