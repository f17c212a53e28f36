// Effects: each acts where it says, does nothing at its neutral value, and leaves a model that can be analysed.
#include "solver/base/error.h"
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"
#include "solver/motion/ground_path.h"
#include "solver/motion/pulse.h"
#include "solver/run/simulation.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

Assembly bridge(const std::string& abutments = "free") {
  const Generator& generator = find_generator("cs1");
  GeneratorInput input = default_input(generator);
  input.choices.at("abutments") = abutments;
  input.values.at("block_scale") = 4.0;
  Assembly assembly = generator.build(input);
  assembly.generator = "cs1";
  assembly.sensors = {{"A01", assembly.blocks[0].centroid, Vec3::UnitY(), 0}};
  return assembly;
}

/// The same, its fill one continuum of few elements.
Assembly filled_bridge() {
  const Generator& generator = find_generator("cs1");
  GeneratorInput input = default_input(generator);
  input.choices.at("abutments") = "free";
  input.choices.at("backfill") = "deformable";
  input.values.at("block_scale") = 4.0;
  input.values.at("fill_edge") = 2.0;
  Assembly assembly = generator.build(input);
  assembly.generator = "cs1";
  assembly.sensors = {{"A01", assembly.blocks[0].centroid, Vec3::UnitY(), 0}};
  return assembly;
}

std::vector<double> frequencies(const Assembly& assembly, int count = 3) {
  std::vector<double> f;
  for (const Mode& mode : modes_of(Bench(assembly), count)) f.push_back(mode.frequency);
  return f;
}

Assembly with(Assembly assembly, const std::string& name, const std::string& where,
              const std::map<std::string, double>& values = {}) {
  EffectSetting setting = {name, where, values};
  complete(setting);
  apply_effect(assembly, setting);
  return assembly;
}

/// A vault of two rings.
Assembly ringed_bridge(bool fill) {
  const Generator& generator = find_generator("bridge");
  GeneratorInput input = default_input(generator);
  input.values.at("block_scale") = 3.0, input.values.at("fill_edge") = 2.0;
  input.values.at("span.1.rings") = 2.0;
  if (fill) input.choices.at("backfill") = "deformable";
  Assembly assembly = generator.build(input);
  assembly.generator = "bridge";
  assembly.sensors = {{"A01", assembly.blocks[0].centroid, Vec3::UnitY(), 0}};
  return assembly;
}

/// A bridge on which the effect can act.
Assembly bridge_for(const Effect& effect, bool fill) {
  Assembly plain = fill ? filled_bridge() : bridge();
  return effect.places(plain).empty() ? ringed_bridge(fill) : plain;
}

class EachEffect : public testing::TestWithParam<std::string> {};

TEST_P(EachEffect, ActsAtEachOfItsPlacesAndLeavesABridge) {
  const Effect& effect = find_effect(GetParam());
  const Assembly plain = bridge_for(effect, false);
  const std::vector<std::string> places = effect.places(plain);
  ASSERT_FALSE(places.empty());
  if (!effect.apply) GTEST_SKIP() << "nothing of it is in the assembly";
  const std::vector<double> before = frequencies(plain, 2);
  for (const std::string& where : places) {
    SCOPED_TRACE(where);
    const Assembly changed = with(plain, effect.name, where);
    ASSERT_EQ(changed.effects.size(), 1u);
    for (std::size_t i = 1; i < changed.joints.size(); ++i) {
      const Joint &a = changed.joints[i - 1], &b = changed.joints[i];
      ASSERT_TRUE(std::tuple(a.a, a.b, a.cell_a, a.cell_b, a.face_a, a.face_b) <
                  std::tuple(b.a, b.b, b.cell_a, b.cell_b, b.face_a, b.face_b))
          << i;
    }
    const std::vector<double> after = frequencies(changed, 2);
    EXPECT_GT(after[0], 0.3 * before[0]);
    EXPECT_LT(after[0], 3.0 * before[0]);
    const bool usual_is_neutral = effect.parameters[0].usual == effect.parameters[0].neutral;
    if (!usual_is_neutral) {
      EXPECT_NE(after[0], before[0]);
    }
  }
}

TEST_P(EachEffect, ActsOnABridgeWithAFill) {
  const Effect& effect = find_effect(GetParam());
  const Assembly plain = bridge_for(effect, true);
  const double before = frequencies(plain, 1)[0];
  ASSERT_FALSE(effect.places(plain).empty());
  if (!effect.apply) GTEST_SKIP() << "nothing of it is in the assembly";
  const std::string where = effect.places(plain).back();
  const Assembly changed = with(plain, effect.name, where);
  const double after = frequencies(changed, 1)[0];
  EXPECT_GT(after, 0.3 * before);
  EXPECT_LT(after, 3.0 * before);
  for (const FillJoint& patch : changed.fill_joints) {
    const Vec3 centre = polygon_centroid(patch.polygon);
    const Box box = block_box(changed.blocks[std::size_t(patch.block)]);
    ASSERT_LT((centre - box.low.cwiseMax(centre.cwiseMin(box.high))).norm(), 1e-6) << "a patch lies on another stone";
  }
}

/// All that a model is built from.
void expect_same(const Assembly& a, const Assembly& b) {
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    const Block &p = a.blocks[i], &q = b.blocks[i];
    ASSERT_TRUE(p.component == q.component && p.part == q.part && p.material == q.material && p.fixed == q.fixed) << i;
    ASSERT_TRUE(p.mass == q.mass && p.centroid == q.centroid && p.inertia == q.inertia) << i;
    ASSERT_EQ(p.cells.size(), q.cells.size()) << i;
    for (std::size_t c = 0; c < p.cells.size(); ++c)
      ASSERT_TRUE(p.cells[c].vertices == q.cells[c].vertices && p.cells[c].faces == q.cells[c].faces) << i;
  }
  ASSERT_EQ(a.joints.size(), b.joints.size());
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    const Joint &p = a.joints[i], &q = b.joints[i];
    ASSERT_TRUE(p.a == q.a && p.b == q.b && p.polygon == q.polygon && p.kn == q.kn && p.ks == q.ks && p.law == q.law)
        << i;
  }
  ASSERT_EQ(a.fill_joints.size(), b.fill_joints.size());
  for (std::size_t i = 0; i < a.fill_joints.size(); ++i)
    ASSERT_TRUE(a.fill_joints[i].kn == b.fill_joints[i].kn && a.fill_joints[i].ks == b.fill_joints[i].ks) << i;
  EXPECT_TRUE(a.laws == b.laws && a.groups == b.groups && a.effects == b.effects);
  EXPECT_TRUE(a.fill.material == b.fill.material && a.fill.nodes == b.fill.nodes && a.fill.tets == b.fill.tets);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i)
    EXPECT_TRUE(a.materials[i].name == b.materials[i].name && a.materials[i].density == b.materials[i].density);
}

TEST_P(EachEffect, IsTakenBackWithoutATrace) {
  const Effect& effect = find_effect(GetParam());
  if (!effect.apply) GTEST_SKIP() << "nothing of it is in the assembly";
  const Assembly plain = bridge_for(effect, false), filled = bridge_for(effect, true);
  for (const Assembly* of : {&plain, &filled})
    for (const std::string& where : effect.places(*of)) {
      SCOPED_TRACE(where);
      Assembly copy = with(*of, effect.name, where);
      take_back_effects(copy, *of);
      expect_same(copy, *of);
    }
}

TEST(Effects, OnAFillActOnItsModuliDensityAndPatches) {
  const Assembly plain = filled_bridge();
  const auto of_fill = [](const Assembly& a) { return a.materials[std::size_t(a.fill.material[0])]; };
  const auto of_stone = [](const Assembly& a) { return a.materials[std::size_t(a.blocks[0].material)]; };
  const Assembly stiffer = with(plain, "fill_stiffness", "all", {{"factor", 4.0}});
  EXPECT_DOUBLE_EQ(of_fill(stiffer).youngs_modulus, 4.0 * of_fill(plain).youngs_modulus);
  EXPECT_DOUBLE_EQ(of_fill(stiffer).shear_modulus, 4.0 * of_fill(plain).shear_modulus);
  EXPECT_EQ(of_fill(stiffer).density, of_fill(plain).density);
  EXPECT_EQ(of_stone(stiffer).youngs_modulus, of_stone(plain).youngs_modulus);
  EXPECT_EQ(stiffer.fill_joints[0].kn, plain.fill_joints[0].kn);
  EXPECT_GT(frequencies(stiffer, 1)[0], 1.02 * frequencies(plain, 1)[0]);

  const Assembly loose = with(plain, "fill_interface", "spandrels", {{"factor", 0.5}});
  std::size_t halved = 0;
  for (std::size_t i = 0; i < plain.fill_joints.size(); ++i) {
    const FillJoint &was = plain.fill_joints[i], &is = loose.fill_joints[i];
    const bool spandrel = plain.blocks[std::size_t(was.block)].component == Component::spandrel;
    EXPECT_DOUBLE_EQ(is.kn, (spandrel ? 0.5 : 1.0) * was.kn);
    EXPECT_DOUBLE_EQ(is.ks, (spandrel ? 0.5 : 1.0) * was.ks);
    halved += spandrel;
  }
  EXPECT_GT(halved, 10u);

  const Assembly heavy = with(plain, "calibration", "backfill", {{"stiffness", 1.0}, {"density", 2.0}});
  EXPECT_DOUBLE_EQ(of_fill(heavy).density, 2.0 * of_fill(plain).density);
  EXPECT_LT(frequencies(heavy, 1)[0], 0.98 * frequencies(plain, 1)[0]);

  const auto mass = [](const Assembly& a) {
    double sum = 0.0;
    for (const double m : build_model(a, SolverSettings{}).fill.mass) sum += m;
    for (const Block& b : a.blocks) sum += b.fixed ? 0.0 : b.mass;
    return sum;
  };
  const auto on_fill = [&](const Assembly& a) {
    const std::vector<double> masses = build_model(a, SolverSettings{}).fill.mass;
    return std::accumulate(masses.begin(), masses.end(), 0.0);
  };
  const Assembly paved = with(plain, "added_mass", "deck", {{"mass_per_length", 1000.0}});
  double low = 1e300, high = -1e300;
  for (const Block& b : plain.blocks) {
    if (b.component != Component::spandrel) continue;
    low = std::min(low, block_box(b).low.x()), high = std::max(high, block_box(b).high.x());
  }
  EXPECT_NEAR(mass(paved) - mass(plain), 1000.0 * (high - low), 1e-6 * mass(plain));
  EXPECT_GT(on_fill(paved) - on_fill(plain), 0.5 * 1000.0 * (high - low));  // most of the deck is fill
}

TEST_P(EachEffect, LeavesABridgeThatRuns) {
  const Effect& effect = find_effect(GetParam());
  if (!effect.apply) GTEST_SKIP() << "nothing of it is in the assembly";
  const Assembly plain = bridge_for(effect, false);
  Bench bench(with(plain, effect.name, effect.places(plain).back()), undamped({0, 0, -9.81}));
  bench.begin();
  ASSERT_TRUE(bench.run(100));
  EXPECT_LT(bench.state.time(), 1.0);
}

TEST_P(EachEffect, DoesNothingAtItsNeutralValue) {
  const Effect& effect = find_effect(GetParam());
  if (!effect.apply) GTEST_SKIP() << "nothing of it is in the assembly";
  const Assembly plain = bridge_for(effect, false);
  std::map<std::string, double> neutral;
  for (const EffectParameter& p : effect.parameters) neutral[p.name] = p.neutral;
  const std::vector<double> before = frequencies(plain),
                            after = frequencies(with(plain, effect.name, effect.places(plain).back(), neutral));
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], before[i], 2e-3 * before[i]) << i;
}

std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (const Effect& effect : effects()) names.push_back(effect.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, EachEffect, testing::ValuesIn(effect_names()), [](const auto& i) { return i.param; });

/// What the generator builds as restrained is what the effect makes of the free bridge.
TEST(Effects, AbutmentRestraintIsThatOfTheRestrainedBridge) {
  const Assembly built = bridge("restrained");
  const std::vector<double> expected = frequencies(built),
                            found =
                                frequencies(with(bridge(), "abutment_restraint", "both", {{"stiffness_share", 0.5}}));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 0.02 * expected[i]) << i;
  EXPECT_THROW(with(built, "abutment_restraint", "left"), InputError) << "its ends are taken";
}

/// A stiff block on soil: the base's own stiffness is the footing's (Pais & Kausel 1988).
TEST(Effects, FoundationSpringsAreThoseOfARigidFooting) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {2, 4, 0}, true);
  add_box(assembly, {0, 0, 0}, {2, 4, 1});
  assembly = joined(std::move(assembly), 1e12, 1e12, elastic_law());
  assembly.groups["base pier 0"] = {0};
  const double g = 1e8, nu = 0.3, b = 1.0, r = 2.0;
  const Bench bench(with(std::move(assembly), "foundation_flexibility", "pier 0", {{"soil_shear_modulus", g}}));
  ASSERT_EQ(bench.assembly.blocks.size(), 3u);
  const BlockMatrix k = stiffness_blocks(bench.model, bench.state, PatchTangent::intact);
  const Matrix6 ground = k.diagonal(bench.body(2));  // of the ground alone: the springs, about its centroid 0.5 m below
  const double vertical = g * b / (1 - nu) * (3.1 * std::pow(r, 0.75) + 1.6);
  const double sliding = g * b / (2 - nu) * (6.8 * std::pow(r, 0.65) + 2.4 + 0.4 * (r - 1));
  const double about_y = g / (1 - nu) * (3.2 * r + 0.8), about_x = g / (1 - nu) * (3.73 * std::pow(r, 2.4) + 0.27);
  EXPECT_NEAR(ground(2, 2), vertical, 1e-9 * vertical);
  EXPECT_NEAR(ground(0, 0), sliding, 1e-9 * sliding);
  EXPECT_NEAR(ground(4, 4) - 0.25 * sliding, about_y, 1e-6 * about_y) << "the long side lies along y";
  EXPECT_NEAR(ground(3, 3) - 0.25 * sliding, about_x, 1e-6 * about_x);
}

TEST(Effects, ScourTakesItsShareOfTheBase) {
  const Assembly plain = bridge(), scoured = with(plain, "scour", "pier 1 x-", {{"lost_share", 0.25}});
  const auto bearing = [](const Assembly& assembly) {
    const std::int64_t base = assembly.groups.at("base pier 1")[0];
    double area = 0.0;
    for (const Joint& joint : assembly.joints)
      if (joint.a == base || joint.b == base) area += joint.area;
    return area;
  };
  EXPECT_NEAR(bearing(scoured), 0.75 * bearing(plain), 1e-6 * bearing(plain));
}

TEST(Effects, AddedMassIsAdded) {
  const Assembly plain = bridge(), loaded = with(plain, "added_mass", "deck", {{"mass_per_length", 2000.0}});
  double before = 0.0, after = 0.0;
  for (const Block& block : plain.blocks) before += block.mass;
  for (const Block& block : loaded.blocks) after += block.mass;
  EXPECT_NEAR(after - before, 2000.0 * 54.4, 1e-3);
}

/// The base of pier 0 makes half of the ground's motion, the next one all of it; asked for twice it is the same.
TEST(Effects, SupportMotionMovesOneBaseOtherwise) {
  const Assembly plain = bridge();
  EffectSetting setting = {"support_motion", "pier 0", {{"factor", 0.5}, {"delay", 0.01}}};
  complete(setting);
  StageSettings shaken, after;
  shaken.kind = StageSettings::Kind::motion;
  shaken.duration = 0.05;
  shaken.motion = make_pulse({.kind = PulseSettings::Kind::half_sine, .axis = 1, .amplitude = 1.0, .frequency = 5.0});
  after.kind = StageSettings::Kind::free;
  after.duration = 0.01;
  SolverSettings settings = undamped();
  settings.stages = {shaken, after};
  apply_effect(settings, setting);
  apply_effect(settings, setting);
  ASSERT_EQ(settings.stages[0].drives.size(), 1u);
  EXPECT_TRUE(settings.stages[1].drives.empty()) << "the ground does not move then";
  const Assembly assembly = with(plain, "support_motion", "pier 0");
  EXPECT_TRUE(assembly.effects.empty()) << "the bridge itself is the same";
  Simulation run(assembly, settings, 1, {});
  ASSERT_EQ(run.run(0.04), RunEnd::interrupted) << run.failure();
  const auto off = [&](const std::string& base) {
    const auto body = std::size_t(run.model().body_of_block[std::size_t(plain.groups.at(base)[0])]);
    return Vec3(Eigen::Map<const Vec3>(&run.state().pose[pose_width * body]) - run.state().base_displacement());
  };
  const GroundPath ground = ground_path(shaken.motion);
  const double t = run.state().time();
  const Vec3 expected = 0.5 * ground.displacement(t - 0.01) - ground.displacement(t);
  EXPECT_LT(expected.y(), -1e-5);
  EXPECT_LT((off("base pier 0") - expected).norm(), 1e-12);
  EXPECT_LT(off("base pier 1").norm(), 1e-15);
}

/// What the case says of the support otherwise stays; without a motion nothing happens.
TEST(Effects, SupportMotionKeepsTheCasesOwnDrives) {
  EffectSetting setting = {"support_motion", "pier 1", {{"factor", 1.2}}};
  complete(setting);
  SolverSettings settings;
  settings.stages.resize(2);
  apply_effect(settings, setting);
  for (const StageSettings& stage : settings.stages) EXPECT_TRUE(stage.drives.empty());
  settings.stages[1].kind = StageSettings::Kind::motion;
  settings.stages[1].drives = {{"base pier 1", Vec3::Zero(), {0, 0, -0.01}}, {"base pier 0", Vec3::Zero(), {0, 0, 1}}};
  apply_effect(settings, setting);
  const std::vector<Drive>& drives = settings.stages[1].drives;
  ASSERT_EQ(drives.size(), 2u);
  EXPECT_EQ(drives[0].displacement, Vec3(0, 0, -0.01));
  EXPECT_EQ(drives[0].factor, 1.2);
  EXPECT_EQ(drives[0].delay, 0.0);
  EXPECT_TRUE(drives[1].with_ground());
  EXPECT_THROW(apply_effect(settings, {"support_motion", "", setting.values}), InputError);
}

/// Bars of 7.1 m over the width of the bridge, so many at each support, between stones of the two walls.
TEST(Effects, RetrofitTiesStandWhereTheyShould) {
  const Assembly plain = bridge();
  const auto ties_of = [&](const std::string& where, const std::map<std::string, double>& values) {
    std::vector<Joint> ties;
    const Assembly tied = with(plain, "retrofit_ties", where, values);
    for (const Joint& joint : tied.joints) {
      const JointLaw& law = tied.laws[std::size_t(joint.law)];
      if (law.kind != JointLaw::Kind::tie) continue;
      ties.push_back(joint);
      EXPECT_EQ(tied.blocks[std::size_t(joint.a)].component, Component::spandrel);
      EXPECT_EQ(tied.blocks[std::size_t(joint.a)].part + tied.blocks[std::size_t(joint.b)].part, 1);
      EXPECT_NEAR(joint.kn * joint.area, 1e8 / 7.1, 1.0);
      EXPECT_NEAR(law.tension * joint.area, 3e5, 1e-6);
      EXPECT_NEAR(law.prestress * joint.area, 1e4, 1e-6);
      EXPECT_NEAR(joint.polygon[0].z(), block_box(tied.blocks[std::size_t(joint.a)]).high.z() - 0.7, 1e-9);
    }
    return ties;
  };
  const std::map<std::string, double> bar = {
      {"axial_stiffness", 1e8}, {"yield_force", 3e5}, {"pretension", 1e4}, {"depth", 0.7}};
  EXPECT_EQ(ties_of("abutment left", bar).size(), 3u) << "every 1.5 m of 4.8 m";
  EXPECT_EQ(ties_of("pier 1", bar).size(), 1u);
  EXPECT_EQ(ties_of("all", bar).size(), 36u) << "of 54.4 m";
  EXPECT_NEAR(ties_of("pier 1", bar)[0].polygon[0].x(), 27.2, 0.06) << "the middle of the bridge";
}

/// They are bars, not masonry: what softens or stiffens masonry passes them by.
TEST(Effects, OnMasonryLeaveTiesAlone) {
  const Assembly tied = with(bridge(), "retrofit_ties", "all"), soft = with(tied, "joint_softening", "spandrels"),
                 open = with(tied, "amplitude_stiffness", "all"),
                 heavy = with(tied, "calibration", "masonry", {{"stiffness", 2.0}}),
                 strong = with(tied, "bonded_joints", "spandrels");
  for (const Assembly* changed : {&soft, &open, &heavy, &strong}) {
    ASSERT_EQ(changed->joints.size(), tied.joints.size());
    for (std::size_t i = 0; i < tied.joints.size(); ++i)
      if (is_tie(tied, tied.joints[i])) {
        EXPECT_EQ(changed->joints[i].kn, tied.joints[i].kn);
        EXPECT_EQ(changed->joints[i].law, tied.joints[i].law);
      }
  }
}

TEST(Effects, GroutActsOnTheInfillAlone) {
  const Assembly plain = bridge();
  const Assembly all =
      with(plain, "grouted_infill", "all",
           {{"tensile_strength", 1e5}, {"cohesion", 2e5}, {"stiffness_factor", 3.0}, {"density_factor", 1.1}});
  const Assembly pier = with(plain, "grouted_infill", "pier 0", {{"stiffness_factor", 3.0}});
  std::size_t changed_all = 0, changed_pier = 0;
  for (std::size_t i = 0; i < plain.joints.size(); ++i) {
    const Joint &was = plain.joints[i], &is = all.joints[i];
    const bool infill = plain.blocks[std::size_t(was.a)].component == Component::infill ||
                        plain.blocks[std::size_t(was.b)].component == Component::infill;
    const JointLaw &before = plain.laws[std::size_t(was.law)], &after = all.laws[std::size_t(is.law)];
    EXPECT_DOUBLE_EQ(is.kn, (infill ? 3.0 : 1.0) * was.kn);
    EXPECT_DOUBLE_EQ(is.ks, (infill ? 3.0 : 1.0) * was.ks);
    EXPECT_EQ(after.tension, infill ? 1e5 : before.tension);
    EXPECT_EQ(after.cohesion, infill ? 2e5 : before.cohesion);
    EXPECT_EQ(after.friction_angle, before.friction_angle);
    changed_all += infill, changed_pier += pier.joints[i].kn != was.kn;
  }
  EXPECT_GT(changed_pier, 10u);
  EXPECT_GT(changed_all, 3 * changed_pier) << "three piers and two abutments have infill";
  for (std::size_t i = 0; i < plain.blocks.size(); ++i)
    EXPECT_DOUBLE_EQ(all.blocks[i].mass / plain.blocks[i].mass,
                     plain.blocks[i].component == Component::infill ? 1.1 : 1.0);
  const Effect& effect = find_effect("grouted_infill");
  EXPECT_EQ(effect.places(plain).size(), 8u) << "each pier, each abutment, piers, abutments, all";
  EXPECT_TRUE(effect.places(generated("cs2", {{"block_scale", 4.0}})).empty()) << "solid piers";
}

/// Two blocks pulled apart: the joint holds ft A, before and after.
TEST(Effects, BondedJointsHoldWhatTheyShould) {
  Assembly column = generated("column", {{"blocks", 1}, {"kn", 1e9}, {"ks", 4e8}});
  for (Block& block : column.blocks) block.component = Component::pier;
  column.blocks[0].part = column.blocks[1].part = 0;
  JointLaw weak = dry_law(0.6);
  weak.tension = 2e4, weak.cohesion = 3e4;
  set_law(column, weak);
  const auto strongest = [](const Assembly& assembly) {
    Bench bench(assembly);
    bench.begin();
    const std::int64_t top = bench.assembly.blocks[0].fixed ? 1 : 0;
    double most = 0.0;
    for (double u = 0.0; u < 1e-3; u += 1e-6) {
      bench.place(top, {0, 0, u}, Eigen::Quaterniond::Identity());
      bench.stepper.patches_only();
      most = std::max(most, -bench.wrench_on(top, 0, Vec3::Zero()).first.z());
    }
    return most;
  };
  const double area = column.joints[0].area;
  EXPECT_NEAR(strongest(column), 2e4 * area, 0.06 * 2e4 * area);
  const Assembly bonded = with(column, "bonded_joints", "pier 0",
                               {{"tensile_strength", 3e5}, {"cohesion", 5e5}, {"stiffness_factor", 1.5}});
  EXPECT_NEAR(strongest(bonded), 3e5 * area, 0.006 * 3e5 * area);
  EXPECT_DOUBLE_EQ(bonded.joints[0].kn, 1.5 * column.joints[0].kn);
  EXPECT_EQ(bonded.laws[std::size_t(bonded.joints[0].law)].cohesion, 5e5);
  const Assembly weaker = with(column, "bonded_joints", "pier 0", {{"tensile_strength", 1e3}, {"cohesion", 1e3}});
  EXPECT_EQ(weaker.laws[std::size_t(weaker.joints[0].law)].tension, 2e4) << "never weaker than it was";
}

/// Retrofit is nothing that a model lacks by mistake.
TEST(Effects, OfRetrofitAreNoCandidates) {
  for (const char* name : {"retrofit_ties", "grouted_infill", "bonded_joints"})
    EXPECT_EQ(find_effect(name).weight, 0.0) << name;
}

TEST(Effects, AskedWronglySayWhatIsRight) {
  const auto message = [](const std::string& name, const std::string& where,
                          const std::map<std::string, double>& values) {
    try {
      with(bridge(), name, where, values);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const auto holds = [](const std::string& text, const std::string& piece) {
    EXPECT_NE(text.find(piece), std::string::npos) << text;
  };
  holds(message("abutment_restrain", "both", {}), "did you mean 'abutment_restraint'");
  holds(message("scour", "pier 7 x-", {}), "its places in this assembly are: abutment left x-");
  holds(message("scour", "pier 1 x-", {{"lost_share", 1.5}}), "lost_share is 1.5. It must be from 0 to 0.9");
  holds(message("scour", "pier 1 x-", {{"lost", 0.5}}), "unknown parameter 'lost'");
  holds(message("joint_softening", "arch 9", {}), "arch 0");
  holds(message("grouted_infill", "arch 0", {}), "its places in this assembly are: pier 0");
  holds(message("bonded_joints", "infill", {}), "its places in this assembly are: arch 0");
  holds(message("bonded_joints", "all", {{"tensile_strength", -1.0}}), "must be from 0 to 1e+07 Pa");
  holds(message("retrofit_ties", "pier 7", {}), "its places in this assembly are: abutment left");
  holds(message("retrofit_ties", "all", {{"pretension", 3e5}}), "must not exceed yield_force, 200000 N");
  holds(message("retrofit_ties", "pier 0", {{"depth", 30.0}}), "at 30 m below their top. Choose another depth");
}

/// Infill has the number of its support. An abutment without infill does not take that of the last pier.
TEST(Parts, InfillBelongsToItsSupport) {
  const Generator& generator = find_generator("bridge");
  GeneratorInput in = default_input(generator);
  in.entries["span"] = 2, in.entries["pier"] = 1;
  const Keys keys = keys_of(generator, in);
  for (const Parameter& p : keys.parameters) in.values.try_emplace(p.name, p.value);
  for (const Choice& c : keys.choices) in.choices.try_emplace(c.name, c.words.front());
  in.values["block_scale"] = 2.0;
  in.choices["pier.1.makeup"] = in.choices["abutment.left.makeup"] = "leaf";
  in.choices["abutment.right.makeup"] = "solid";
  in.values["pier.1.thickness"] = 3.0;
  const Assembly assembly = generator.build(in);
  const auto infill = [&](const std::string& part) {
    const BlockSet blocks = masonry_part(assembly, part);
    std::size_t count = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i)
      count += blocks[i] && assembly.blocks[i].component == Component::infill;
    return count;
  };
  EXPECT_GT(infill("abutment left"), 0u);
  EXPECT_GT(infill("pier 0"), 0u);
  EXPECT_EQ(infill("abutment right"), 0u);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
