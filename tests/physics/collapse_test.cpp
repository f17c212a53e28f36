// Collapse loads against limit analysis: the multiplier and the joints that move. Voussoirs are near rigid.
#include "solver/base/error.h"
#include "solver/run/simulation.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

StageSettings pattern_stage(const Loads& pattern, double to, double tolerance) {
  StageSettings stage;
  stage.kind = StageSettings::Kind::collapse;
  stage.loads = pattern;
  stage.collapse.to = to;
  stage.collapse.tolerance = tolerance;
  stage.collapse.confirm = 0.0;
  return stage;
}

Loads sideways() {
  Loads loads;
  loads.acceleration = Vec3(9.81, 0, 0);
  return loads;
}

/// Finds the collapse multiplier after a gravity stage and says what was expected.
Collapse collapse(const Assembly& assembly, const StageSettings& stage, const std::string& what, double expected) {
  SolverSettings settings;
  settings.stages = {StageSettings{}, stage};
  Simulation run(assembly, settings, 1, {});
  EXPECT_EQ(run.run(), RunEnd::finished) << run.failure();
  const Collapse c = run.collapse();
  EXPECT_TRUE(c.found) << c.account;
  EXPECT_LE(c.above - c.multiplier, stage.collapse.tolerance * 1.0001);
  measured(what, expected, 0.5 * (c.multiplier + c.above), "-");
  return c;
}

Assembly arch(double ratio, double embrace, int voussoirs) {
  Assembly assembly = generated("arch", {{"mean_radius", 10.0},
                                         {"thickness_ratio", ratio},
                                         {"embrace_angle", embrace},
                                         {"voussoirs", voussoirs},
                                         {"kn", 1e11},
                                         {"ks", 1e11}});
  set_law(assembly, dry_law(std::tan(radians(80.0))));
  return assembly;
}

/// Flat-faced wedges weigh a little more at their feet than parts of a ring do (Oppenheim 1992: 0.370). The exact value
/// is that of the best of all four-hinge mechanisms, hinges at joints 0, 3, 5 and 7 counted from the left.
TEST(Collapse, OfOppenheimsArch) {
  const Collapse c = collapse(arch(0.15, 157.5, 7), pattern_stage(sideways(), 1.0, 5e-4),
                              "Oppenheim's arch, flat-faced voussoirs: horizontal acceleration", 0.373612);
  EXPECT_NEAR(0.5 * (c.multiplier + c.above), 0.373612, 0.002 * 0.373612);
  ASSERT_EQ(c.mechanism.size(), 4u);
  const Assembly assembly = arch(0.15, 157.5, 7);
  std::vector<std::pair<std::int64_t, std::int64_t>> joints;
  std::vector<std::string> edges;
  for (const MechanismJoint& joint : c.mechanism) {
    EXPECT_FALSE(joint.slides);
    joints.emplace_back(joint.a, joint.b);
    edges.push_back(edge_name(assembly, joint));
  }
  EXPECT_EQ(joints, (std::vector<std::pair<std::int64_t, std::int64_t>>{{0, 7}, {2, 3}, {4, 5}, {6, 8}}));
  EXPECT_EQ(edges, (std::vector<std::string>{"intrados", "extrados", "intrados", "extrados"}));
}

/// A point load at the middle of the extrados of voussoir 9 of a semicircle of 27 (x ≈ quarter span).
TEST(Collapse, UnderAPointLoadAtTheQuarterSpan) {
  const Assembly assembly = arch(0.15, 180.0, 27);
  const Block& block = assembly.blocks[std::size_t(assembly.groups.at("voussoir 9")[0])];
  double weight = 0.0;
  for (const Block& b : assembly.blocks) weight += b.fixed ? 0.0 : 9.81 * b.mass;
  const Vec3 feet(10.75, 0.0, 0.0);  // the arch's centre: its left end is at x = 0
  Vec3 top = Vec3::Zero();
  const Vec3 out = Vec3(1, 0, 1).cwiseProduct(block.centroid - feet).normalized();
  top = feet + out * 10.75 * std::cos(0.5 * radians(180.0 / 27.0));
  Loads loads;
  loads.forces = {{"voussoir 9", {0, 0, -weight}, top}};
  const Collapse c = collapse(assembly, pattern_stage(loads, 1.0, 5e-4),
                              "semicircle, point load at the quarter span over its weight", 0.2172);
  EXPECT_NEAR(0.5 * (c.multiplier + c.above), 0.2172, 0.01 * 0.2172);
  EXPECT_EQ(c.mechanism.size(), 4u);
}

/// A column tips about its edge at B/H, or slides at μ, whichever is less.
TEST(Collapse, OfAStack) {
  for (const auto& [blocks, mu, expected] : {std::tuple{4, 0.75, 0.25}, std::tuple{1, 0.75, 0.75}}) {
    Assembly assembly = generated(
        "column",
        {{"blocks", blocks}, {"width", 1.0}, {"depth", 1.0}, {"block_height", 1.0}, {"kn", 1e11}, {"ks", 1e11}});
    set_law(assembly, dry_law(mu));
    const Collapse c = collapse(assembly, pattern_stage(sideways(), 1.0, 1e-3),
                                "stack of " + std::to_string(blocks) + " cubes", expected);
    EXPECT_NEAR(0.5 * (c.multiplier + c.above), expected, 0.005 * expected);
    ASSERT_EQ(c.mechanism.size(), 1u);
    EXPECT_EQ(c.mechanism[0].slides, blocks == 1);
  }
}

/// On a tilting table a block slides when the table's slope is the coefficient of friction.
TEST(Collapse, OfABlockOnATiltingTable) {
  Assembly assembly = generated("column", {{"blocks", 1}, {"block_height", 0.5}, {"kn", 1e11}, {"ks", 1e11}});
  set_law(assembly, dry_law(0.4));
  StageSettings stage = pattern_stage({}, 1.0, 1e-3);
  stage.loads.reset();
  stage.collapse.tilt = Vec3(0, 1, 0);
  const Collapse c = collapse(assembly, stage, "block on a tilting table: slope", 0.4);
  EXPECT_NEAR(0.5 * (c.multiplier + c.above), 0.4, 0.005 * 0.4);
}

/// What does not fall is said to stand, and the dynamic runs agree with the static solver.
TEST(Collapse, ThatDoesNotComeAndThatIsConfirmed) {
  Assembly assembly = generated("column", {{"blocks", 1}, {"block_height", 0.5}, {"kn", 1e9}, {"ks", 1e9}});
  set_law(assembly, dry_law(0.4));
  SolverSettings settings;
  settings.stages = {StageSettings{}, pattern_stage(sideways(), 0.3, 1e-2)};
  Simulation stands(assembly, settings, 1, {});
  ASSERT_EQ(stands.run(), RunEnd::finished);
  EXPECT_FALSE(stands.collapse().found);
  EXPECT_EQ(stands.collapse().multiplier, 0.3);

  settings.stages[1] = pattern_stage(sideways(), 1.0, 2e-3);
  settings.stages[1].collapse.confirm = 0.5;
  Simulation falls(assembly, settings, 1, {});
  ASSERT_EQ(falls.run(), RunEnd::finished);
  EXPECT_EQ(falls.collapse().stands_below, true);
  EXPECT_EQ(falls.collapse().falls_above, true);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
