// Resultants of bed joints against statics: a cantilever that is determinate, arches under their own weight, rings, and
// an arch that is about to become a mechanism.
#include "solver/statics/bed_joints.h"

#include "geometry/rings.h"
#include "tests/solver/models.h"
#include "tools/ladder/ring_strip.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double g = 9.81;

std::vector<BedJoint> beds_of(const Bench& bench) {
  return bed_joints(bench.assembly, forces_at_rest(bench.model, bench.state));
}

double weight_of(const Assembly& assembly) {
  double weight = 0.0;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) weight += block.mass * g;
  return weight;
}

/// Three blocks of 1 × 0.6 × 0.4 m without weight on a wall at x = 0, pressed at their end by 1 MN, 40 kN downwards and
/// 30 kN sideways: the thrust goes straight on from there along that force, and Navier's formula gives the pressures.
TEST(BedJoints, OfACantileverAreThoseOfStatics) {
  Assembly assembly = stone();
  add_box(assembly, {-1, -0.3, -0.2}, {0, 0.3, 0.2}, true);
  for (int i = 0; i < 3; ++i) add_box(assembly, {1.0 * i, -0.3, -0.2}, {i + 1.0, 0.3, 0.2});
  for (std::size_t i = 1; i < 4; ++i) assembly.blocks[i].component = Component::arch;
  assembly.groups["end"] = {3};
  assembly = joined(std::move(assembly), 1e15, 1e15, elastic_law());
  SolverSettings settings = undamped();
  settings.step.equilibrium_tolerance = 1e-9;
  StageSettings stage;
  stage.loads = Loads{};
  stage.loads->forces = {{"end", Vec3(-1e6, 3e4, -4e4), Vec3(3.0, -0.05, 0.1)}};
  settings.stages = {stage};
  Simulation run(assembly, settings, 1, {});
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  const std::vector<BedJoint> beds = bed_joints(assembly, forces_at_rest(run.model(), run.state()));
  ASSERT_EQ(beds.size(), 3u) << "nothing stands at the free end";
  for (std::size_t i = 0; i < 3; ++i) {
    const BedJoint& bed = beds[i];
    EXPECT_EQ(bed.number, int(i));
    EXPECT_NEAR((bed.centre - Vec3(double(i), 0, 0)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((bed.force() - Vec3(1e6, -3e4, 4e4)).norm(), 0.0, 1e-6 * 1e6) << "the left side bears what is put on";
    EXPECT_NEAR(bed.normal, 1e6, 1.0);
    EXPECT_NEAR(bed.shear, 4e4, 1.0);
    const double lever = 3.0 - double(i);
    const double off = 0.1 - 0.04 * lever, aside = -0.05 + 0.03 * lever;
    EXPECT_NEAR(bed.eccentricity, off, 1e-6);
    EXPECT_NEAR(bed.thrust().y(), aside, 1e-6);
    EXPECT_NEAR(bed.depth, 0.4, 1e-6);
    EXPECT_NEAR(bed.width, 0.6, 1e-6);
    EXPECT_NEAR(bed.area, 0.24, 1e-9);
    const double pressure = 1e6 / 0.24 * (1.0 + 6.0 * std::abs(off) / 0.4 + 6.0 * std::abs(aside) / 0.6);
    EXPECT_NEAR(bed.largest_compression, pressure, 1e-6 * pressure);
    EXPECT_NEAR(bed.torsion, 0.1 * 3e4 - 0.05 * 4e4, 1.0) << "of the end's shears about the axis";
  }
}

/// Between two bed joints an arch bears its own weight and nothing else: the thrust stays, the vertical force falls by
/// the weight, and the resultants and the weight meet in equilibrium of moments.
void expect_an_arch(const std::vector<BedJoint>& beds, double weight) {
  ASSERT_GT(beds.size(), 2u);
  const double thrust = beds.front().force().x();
  ASSERT_GT(thrust, 0.0);
  for (const BedJoint& bed : beds) {
    EXPECT_NEAR(bed.force().x(), thrust, 1e-6 * weight) << "joint " << bed.number;
    EXPECT_NEAR(bed.force().y(), 0.0, 1e-6 * weight);
    EXPECT_LE(std::abs(bed.eccentricity), 0.5 * bed.depth * (1.0 + 1e-6));
  }
  EXPECT_NEAR(beds.front().force().z() - beds.back().force().z(), weight, 1e-6 * weight);
}

TEST(BedJoints, OfAnArchBearItsWeight) {
  for (const double rows : {1.0, 3.0}) {  // three stones across, in stretcher bond: the same over the whole width
    Bench bench(generated("arch", {{"rows", rows}, {"width", 1.5}, {"voussoirs", 15}}), undamped({0, 0, -g}));
    ASSERT_TRUE(bench.balance(1e-8).converged);
    const std::vector<BedJoint> beds = beds_of(bench);
    ASSERT_EQ(beds.size(), 16u);
    expect_an_arch(beds, weight_of(bench.assembly));
    for (std::size_t i = 0; i < 16; ++i) {
      EXPECT_NEAR(beds[i].width, 1.5, 1e-5);
      EXPECT_NEAR(beds[i].depth, 1.5, 1e-5);
      EXPECT_NEAR(beds[i].eccentricity, beds[15 - i].eccentricity, 1e-6) << "it is symmetric";
      EXPECT_NEAR(beds[i].shear, -beds[15 - i].shear, 1e-6 * weight_of(bench.assembly));
    }
    EXPECT_LT(beds[0].centre.x(), beds[15].centre.x());
  }
}

/// Moments of a voussoir about its centroid: both resultants turn it against each other.
TEST(BedJoints, HoldEveryVoussoirInEquilibrium) {
  Bench bench(generated("arch", {{"voussoirs", 9}, {"embrace_angle", 120.0}}), undamped({0, 0, -g}));
  ASSERT_TRUE(bench.balance(1e-8).converged);
  const std::vector<BedJoint> beds = beds_of(bench);
  ASSERT_EQ(beds.size(), 10u);
  const double weight = weight_of(bench.assembly);
  for (std::size_t i = 0; i < 9; ++i) {
    const Vec3 middle = bench.assembly.blocks[i].centroid + bench.displacement(std::int64_t(i));
    const Vec3 turning =
        (beds[i].thrust() - middle).cross(beds[i].force()) - (beds[i + 1].thrust() - middle).cross(beds[i + 1].force());
    EXPECT_NEAR(turning.y(), 0.0, 1e-6 * weight) << "voussoir " << i;
  }
}

/// Rings share the thrust; what all bear at one station together is that of the whole vault.
TEST(BedJoints, OfTwoRingsAddUp) {
  ladder::RingStrip strip{.rings = {0.15, 0.15}, .voussoirs = 12, .headers_every = 4, .stiffness = 1e10};
  Assembly assembly = ladder::ring_strip(strip);
  std::vector<std::int64_t>& lower = assembly.groups[ring_group(0, 0)];
  std::vector<std::int64_t>& upper = assembly.groups[ring_group(0, 1)];
  for (std::int64_t i = 0; i < std::int64_t(assembly.blocks.size()); ++i) {
    const Block& block = assembly.blocks[std::size_t(i)];
    if (block.fixed) continue;
    if (i < 12) lower.push_back(i);
    if (i >= 12 || block.cells.size() == 2) upper.push_back(i);
  }
  Bench bench(std::move(assembly), undamped({0, 0, -g}));
  ASSERT_TRUE(bench.balance(1e-8).converged);
  const double weight = weight_of(bench.assembly);
  std::map<double, Vec3> stations;  // by z of the unit normal, which both rings share
  std::map<std::int32_t, int> counts;
  for (const BedJoint& bed : beds_of(bench)) {
    ++counts[bed.ring];
    const double key = std::round(1e4 * bed.n.z());
    stations.try_emplace(key, Vec3::Zero()).first->second += bed.force();
  }
  EXPECT_EQ(counts[0], 13);
  EXPECT_EQ(counts[1], 13);
  ASSERT_EQ(stations.size(), 13u);
  const double thrust = stations.begin()->second.x();
  EXPECT_GT(thrust, 0.0);
  for (const auto& [key, force] : stations) EXPECT_NEAR(force.x(), thrust, 1e-6 * weight) << key;
  EXPECT_NEAR(stations.rbegin()->second.z() - stations.begin()->second.z(), weight, 1e-6 * weight);
}

/// At the largest load that a strip bears, its thrust lies at the edge of four joints in turn.
TEST(BedJoints, LieAtFourEdgesBeforeAnArchFails) {
  const ladder::RingStrip strip{.rings = {0.3}, .voussoirs = 20, .friction = 1.5};
  const Assembly assembly = ladder::ring_strip(strip);
  const ladder::StripLoad load = ladder::load_on(assembly, strip);
  StageSettings stage;
  stage.kind = StageSettings::Kind::collapse;
  stage.loads = Loads{};
  stage.loads->forces = {{load.group, load.force, load.at}};
  stage.collapse.to = 8.0, stage.collapse.tolerance = 0.01, stage.collapse.confirm = 0.0;
  SolverSettings settings;
  settings.step.equilibrium_tolerance = 1e-5;
  settings.stages = {StageSettings{}, stage};
  Simulation run(assembly, settings, 1, {});
  ASSERT_EQ(run.run(), RunEnd::finished) << run.failure();
  ASSERT_TRUE(run.collapse().found);
  const std::vector<BedJoint> beds = bed_joints(assembly, run.collapse().last);
  ASSERT_EQ(beds.size(), 21u);
  std::vector<bool> edges;  // of hinges from left to right: on the extrados
  for (const BedJoint& bed : beds) {
    EXPECT_LE(std::abs(bed.eccentricity), 0.5 * bed.depth * 1.001);
    EXPECT_LE(bed.utilisation, 1.001);
    const bool outside = bed.eccentricity > 0.0;
    if (std::abs(bed.eccentricity) > 0.47 * bed.depth && (edges.empty() || edges.back() != outside))
      edges.push_back(outside);
  }
  EXPECT_GE(edges.size(), 4u) << "four hinges on alternate edges";
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
