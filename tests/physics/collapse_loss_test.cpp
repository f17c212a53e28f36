// What counts as loss of equilibrium on the way to a collapse load: motion that goes on, not a distance; and whether
// all goes or a part.
#include "solver/run/simulation.h"
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// A strip of an arch bridge under soft soil, and a pad that a wheel presses into it.
Assembly soft_strip() {
  const Generator& generator = find_generator("filled-arch");
  GeneratorInput input = default_input(generator);
  for (const auto& [key, value] : std::map<std::string, double>{{"clear_span", 3.0},
                                                                {"rise", 0.75},
                                                                {"ring_thickness", 0.25},
                                                                {"fill_over_crown", 0.3},
                                                                {"approach", 1.0},
                                                                {"voussoirs", 11},
                                                                {"width", 0.2},
                                                                {"load_at", 0.25},
                                                                {"load_length", 0.3},
                                                                {"fill_edge", 0.35},
                                                                {"interface_depth", 0.1}})
    input.values.at(key) = value;
  input.materials.at("masonry").friction_angle = radians(31.0);
  Material& soil = input.materials.at("backfill");
  soil.cohesion = 2e3;
  soil.friction_angle = radians(30.0);
  return generator.build(input);
}

Collapse under_a_wheel(const Assembly& assembly, double displacement, double to) {
  SolverSettings settings;
  settings.contact.reclip_slip = 1.0;
  Guide pad;
  pad.group = "load";
  pad.free = {true, false, true};
  pad.turn = true;
  settings.guides = {pad};
  StageSettings collapse;
  collapse.kind = StageSettings::Kind::collapse;
  collapse.loads = Loads{Vec3::Zero(), {{"load", Vec3(0.0, 0.0, -1000.0), {}}}, {}};
  collapse.collapse.to = to;
  collapse.collapse.tolerance = 1.0;
  collapse.collapse.displacement = displacement;
  collapse.collapse.confirm = 0.0;
  settings.stages = {StageSettings{}, collapse};
  Simulation run(assembly, settings, 1, {});
  EXPECT_EQ(run.run(), RunEnd::finished) << run.failure();
  return run.collapse();
}

/// The pad sinks by more than the least of these distances on the way, and comes to rest; the steps in which the load
/// comes, shares of `to`, do not matter either.
TEST(CollapseLoss, HangsNeitherOnADistanceNorOnTheSteps) {
  const Assembly assembly = soft_strip();
  const Collapse usual = under_a_wheel(assembly, 0.02, 40.0);
  ASSERT_TRUE(usual.found) << usual.account;
  EXPECT_TRUE(std::ranges::any_of(usual.curve, [](const CollapsePoint& p) { return p.settled; }));
  for (std::size_t i = 1; i < usual.curve.size(); ++i) {
    EXPECT_GT(usual.curve[i].multiplier, usual.curve[i - 1].multiplier);
    EXPECT_GE(usual.curve[i].along, usual.curve[i - 1].along) << "the pad sinks";
    EXPECT_LE(usual.curve[i].along, usual.curve[i].largest);
  }
  const Collapse other = under_a_wheel(assembly, 1.0, 60.0);
  ASSERT_TRUE(other.found) << other.account;
  EXPECT_NEAR(other.multiplier, usual.multiplier, 0.03 * usual.multiplier);
  measured("Wheel pad on a soft strip: multiplier, displacement 0.02 m, to 40; 1 m, to 60", usual.multiplier,
           other.multiplier, "-");
}

Collapse of_a_stack(const Loads& pattern) {
  const Assembly assembly = generated("column", {{"blocks", 3}, {"kn", 1e10}, {"ks", 1e10}});
  StageSettings collapse;
  collapse.kind = StageSettings::Kind::collapse;
  collapse.loads = pattern;
  collapse.collapse.to = 1.0;
  collapse.collapse.tolerance = 0.01;
  collapse.collapse.confirm = 0.0;
  SolverSettings settings;
  settings.stages = {StageSettings{}, collapse};
  Simulation run(assembly, settings, 1, {});
  EXPECT_EQ(run.run(), RunEnd::finished) << run.failure();
  return run.collapse();
}

/// The top stone slides off at the friction of its joint, and the others stay.
TEST(CollapseLoss, OfTheLoadedStoneAloneIsLocal) {
  const Assembly assembly = generated("column", {{"blocks", 3}});
  const double weight = 9.81 * assembly.blocks[2].mass;
  const Collapse c = of_a_stack({Vec3::Zero(), {{"top", Vec3(weight, 0.0, 0.0), {}}}, {}});
  ASSERT_TRUE(c.found) << c.account;
  const double tan_friction = std::tan(assembly.materials[0].friction_angle);
  EXPECT_NEAR(c.multiplier, tan_friction, 0.02 + 0.02 * tan_friction);
  EXPECT_TRUE(c.loss.local);
  EXPECT_TRUE(c.loss.loaded_only);
  EXPECT_EQ(c.loss.blocks, std::vector<std::int64_t>{2});
  EXPECT_EQ(c.loss.rest_stands, true);
  EXPECT_EQ(collapse_headline(assembly, c).rfind("Local loss", 0), 0u) << collapse_headline(assembly, c);
}

/// All three go together: no part is left that could stand.
TEST(CollapseLoss, OfTheWholeStackIsGlobal) {
  const Assembly assembly = generated("column", {{"blocks", 3}});
  const Collapse c = of_a_stack({Vec3(9.81, 0.0, 0.0), {}, {}});
  ASSERT_TRUE(c.found) << c.account;
  EXPECT_FALSE(c.loss.local);
  EXPECT_FALSE(c.loss.rest_stands.has_value());
  EXPECT_EQ(collapse_headline(assembly, c).rfind("Global loss", 0), 0u) << collapse_headline(assembly, c);
}

/// What the dynamic run denies is no collapse load, and that comes first.
TEST(CollapseLoss, DisagreementIsTheHeadline) {
  Collapse c;
  c.found = true;
  c.multiplier = 1.25;
  c.falls_above = false;
  EXPECT_EQ(collapse_headline(Assembly{}, c).rfind("The static and the dynamic solver disagree", 0), 0u);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
