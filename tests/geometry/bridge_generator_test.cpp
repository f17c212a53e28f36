// cs1 and cs2: nothing open, nothing twice, nothing lost; stiffness and strength of every kind of joint.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/fill_mesh.h"
#include "geometry/generator.h"
#include "geometry/joints.h"
#include "solver/base/error.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

GeneratorInput input_of(const std::string& name, double scale = 1.0, bool restrained = false) {
  GeneratorInput input = default_input(find_generator(name));
  input.values["block_scale"] = scale;
  input.choices["abutments"] = restrained ? "restrained" : "free";
  return input;
}

Assembly build(const std::string& name, const GeneratorInput& input) {
  return find_generator(name).build(input);
}

/// Surfaces and volumes of a bridge with flat-faced vaults, from its keys alone.
struct Analytic {
  const GeneratorInput& in;
  int voussoirs;
  double width = in("width"), spans = in("spans"), radius = 0.5 * in("clear_span");
  double above = radius + in("ring_thickness") + in("fill_over_crown");  // springing to deck
  double length = 2.0 * in("abutment_length") + spans * in("clear_span") + (spans - 1.0) * in("pier_thickness");
  double opening = 0.5 * voussoirs * radius * radius * std::sin(M_PI / voussoirs);      // m2, under one vault
  double soffit = voussoirs * 2.0 * radius * std::sin(0.5 * M_PI / voussoirs) * width;  // m2, of one vault

  double pier_height(int i) const {
    const double own = in(fmt::format("pier_{}_height", i));
    return own > 0.0 ? own : in("pier_height");
  }
  /// Side faces, base and volume of a support with plan (t, width) at its top.
  struct Support {
    double faces, base, volume;
  };
  Support support(double t, double h, double bx, double by) const {
    const double tb = t + 2.0 * bx * h, wb = width + 2.0 * by * h;
    const double across = 2.0 * 0.5 * (width + wb) * h * std::sqrt(1.0 + bx * bx);
    const double along = 2.0 * 0.5 * (t + tb) * h * std::sqrt(1.0 + by * by);
    const double depth = in("base_depth");
    const double middle = (t + bx * h) * (width + by * h);  // Simpson's rule is exact here
    return {across + along, 2.0 * (tb + wb) * depth + tb * wb, h / 6.0 * (t * width + 4.0 * middle + tb * wb)};
  }
  template <class F>
  double over_supports(F&& take) const {
    double sum = 2.0 * take(support(in("abutment_length"), in("abutment_height"), 0.0, in("batter_y")));
    for (int i = 0; i + 1 < int(spans); ++i) {
      sum += take(support(in("pier_thickness"), pier_height(i), in("batter_x"), in("batter_y")));
    }
    return sum;
  }
  double surface() const {
    const double hp = in("parapet_height"), tp = in("parapet_thickness");
    double sum = over_supports([](const Support& s) { return s.faces + s.base; });
    sum += length * width + 2.0 * width * above;                       // deck and ends
    sum += 2.0 * (length * above - spans * opening) + spans * soffit;  // sides and soffits
    if (hp > 0.0) sum += 4.0 * length * hp + 4.0 * tp * hp;
    if (in.choices.at("abutments") == "restrained") {
      // The end face goes, the restraint's far face of the same size comes; so does its rim.
      const double h = in("abutment_height"), by = in("batter_y"), foot = width + 2.0 * by * h;
      const double rim = foot + width + 2.0 * h * std::sqrt(1.0 + by * by) + 2.0 * above;
      sum += 2.0 * rim * in("restraint_depth");
    }
    return sum;
  }
  double volume() const {
    const double parapets = 2.0 * length * in("parapet_height") * in("parapet_thickness");
    return width * (length * above - spans * opening) + parapets +
           over_supports([](const Support& s) { return s.volume; });
  }
};

double moving_volume(const Assembly& assembly) {
  double sum = 0.0;
  for (const Block& block : assembly.blocks) sum += block.fixed ? 0.0 : mass_properties(block.cells).volume;
  return sum;
}

double moving_mass(const Assembly& assembly) {
  double sum = 0.0;
  for (const Block& block : assembly.blocks) sum += block.fixed ? 0.0 : block.mass;
  return sum;
}

struct Kind {
  const char* name;
  double scale;
  bool restrained;
  int voussoirs;
  bool wings = false;  // of cs1: the leaf of its abutments is as short as 1.5 m
};
void PrintTo(const Kind& k, std::ostream* out) {
  *out << k.name << " " << k.scale << (k.restrained ? " restrained" : " free") << (k.wings ? " with wing walls" : "");
}

GeneratorInput input_of(const Kind& kind) {
  GeneratorInput input = input_of(kind.name, kind.scale, kind.restrained);
  if (kind.wings) input.values["abutment_leaf_length"] = 1.5;
  return input;
}

class Bridges : public testing::TestWithParam<Kind> {};

TEST_P(Bridges, NothingIsLeftOpenOrCountedTwiceOrLost) {
  const Kind kind = GetParam();
  const GeneratorInput input = input_of(kind);
  const Assembly bridge = build(kind.name, input);
  const Analytic analytic{input, kind.voussoirs};
  EXPECT_NEAR(uncovered_surface(bridge), analytic.surface(), 1e-3);
  EXPECT_NEAR(moving_volume(bridge), analytic.volume(), 1e-6);
  EXPECT_TRUE(find_overlaps(bridge, 1e-7).empty());
}

TEST_P(Bridges, JointsAreWhatASearchOfTheFinishedBlocksFinds) {
  const Kind kind = GetParam();
  const Assembly bridge = build(kind.name, input_of(kind));
  Assembly again = bridge;
  again.joints.clear();
  const JointReport report = find_joints(again);
  EXPECT_EQ(report.closed_gaps, 0);
  ASSERT_EQ(again.joints.size(), bridge.joints.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < bridge.joints.size(); ++i) {
    const Joint &p = bridge.joints[i], &q = again.joints[i];
    const bool same = p.a == q.a && p.b == q.b && p.cell_a == q.cell_a && p.cell_b == q.cell_b &&
                      p.face_a == q.face_a && p.face_b == q.face_b && (p.normal - q.normal).norm() < 1e-9 &&
                      std::abs(p.area - q.area) < 1e-9 && (polygon_normal(p.polygon) - p.normal).norm() < 1e-5;
    different += !same;
  }
  EXPECT_EQ(different, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, Bridges,
                         testing::Values(Kind{"cs1", 1.0, false, 38}, Kind{"cs1", 1.0, true, 38},
                                         Kind{"cs2", 1.0, false, 42}, Kind{"cs2", 1.0, true, 42},
                                         Kind{"cs1", 2.0, false, 20}, Kind{"cs1", 2.5, true, 16},
                                         Kind{"cs1", 1.0, false, 38, true}, Kind{"cs1", 2.5, true, 16, true},
                                         Kind{"cs2", 2.0, false, 22}, Kind{"cs2", 2.5, true, 18}),
                         [](const auto& test) {
                           const Kind& k = test.param;
                           return fmt::format("{}_{}_{}{}", k.name, int(10 * k.scale), k.restrained ? "R" : "F",
                                              k.wings ? "_wings" : "");
                         });

/// A span of its own shifts what is to the right of it and takes its vault out of the same height.
TEST(Bridge, ASpanMayHaveALengthOfItsOwn) {
  GeneratorInput input = input_of("cs2", 2.0);
  const Analytic even{input, 22};
  input.values["span_1_clear"] = input("clear_span") + 0.6;
  const Assembly bridge = build("cs2", input);
  const double radius = 0.5 * input("span_1_clear"), longer = 0.6;
  const double opening = 0.5 * 22 * radius * radius * std::sin(M_PI / 22);
  EXPECT_NEAR(moving_volume(bridge), even.volume() + input("width") * (longer * even.above + even.opening - opening),
              1e-6);
  const auto x_of = [](const Assembly& a, const char* group) {
    const Box box = block_box(a.blocks[std::size_t(a.groups.at(group)[0])]);
    return 0.5 * (box.low.x() + box.high.x());
  };
  const Assembly drawn = build("cs2", input_of("cs2", 2.0));
  EXPECT_NEAR(x_of(bridge, "base pier 0"), x_of(drawn, "base pier 0"), 1e-9);
  EXPECT_NEAR(x_of(bridge, "base pier 1"), x_of(drawn, "base pier 1") + longer, 1e-9);
  EXPECT_TRUE(find_overlaps(bridge, 1e-7).empty());
  input.values["span_1_clear"] = input("clear_span") + 2.0 * input("fill_over_crown") + 0.01;
  EXPECT_THROW(build("cs2", input), InputError);
}

TEST(Bridge, MassesAndSizesOfTheTwoBridges) {
  const Assembly cs1 = build("cs1", input_of("cs1")), cs2 = build("cs2", input_of("cs2"));
  EXPECT_NEAR(moving_mass(cs1), 4090e3, 0.02 * 4090e3);
  EXPECT_NEAR(moving_mass(cs2), 6470e3, 0.02 * 6470e3);
  Box box;
  for (const Block& block : cs1.blocks) {
    box.low = box.low.cwiseMin(block_box(block).low);
    box.high = box.high.cwiseMax(block_box(block).high);
  }
  EXPECT_NEAR((box.low - Vec3(0.0, -3.55, -1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((box.high - Vec3(54.4, 3.55, 17.5)).norm(), 0.0, 1e-12);
  std::vector<double> tops;  // of CS2's fixed blocks
  for (const Block& block : cs2.blocks) {
    if (block.fixed) tops.push_back(block_box(block).high.z());
  }
  ASSERT_EQ(tops.size(), 4u);
  const double expected[] = {5.8, 0.0, 1.7, 5.8};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(tops[std::size_t(i)], expected[i], 1e-12);
}

TEST(Bridge, NoSliversAreLeft) {
  const std::map<Component, double> nominal = {{Component::backing, 0.75 * 0.70 * 0.45},
                                               {Component::backfill, 0.70 * 0.45 * 0.40},
                                               {Component::spandrel, 0.75 * 0.45 * 0.45}};
  const Assembly bridge = build("cs1", input_of("cs1"));
  for (const Block& block : bridge.blocks) {
    const auto found = nominal.find(block.component);
    if (found == nominal.end()) continue;
    // Stones are laid in whole numbers a length, so their own nominal size is up to a tenth less.
    EXPECT_GT(mass_properties(block.cells).volume, 0.22 * found->second);
  }
}

TEST(Bridge, SpandrelsStepFromBottomToTopThickness) {
  const Assembly cs2 = build("cs2", input_of("cs2"));
  double bottom = 0.0, top = 1e9;
  for (const Block& block : cs2.blocks) {
    if (block.component != Component::spandrel) continue;
    const Box box = block_box(block);
    const double thickness = box.high.y() - box.low.y();
    if (box.low.z() < 13.0 + 1e-9) bottom = std::max(bottom, thickness);
    if (box.high.z() > 13.0 + 9.48 - 1e-9) top = std::min(top, thickness);
  }
  EXPECT_NEAR(bottom, 1.5, 1e-12);
  EXPECT_NEAR(top, 1.0, 1e-12);
}

TEST(Bridge, GroupsNameTheKeystonesAndTheWallTops) {
  const Assembly cs1 = build("cs1", input_of("cs1", 2.0));
  for (int i = 0; i < 4; ++i) {
    for (const std::int64_t k : cs1.groups.at(fmt::format("keystone {}", i))) {
      const Block& block = cs1.blocks[std::size_t(k)];
      EXPECT_EQ(block.component, Component::arch);
      EXPECT_EQ(block.part, i);
      EXPECT_LT(std::abs(block.centroid.x() - (9.5 + 11.8 * i)), 1.0);
      EXPECT_GT(block.centroid.z(), 9.5 + 5.0);
    }
  }
  const std::map<std::string, double> middles = {
      {"abutment left", 2.25}, {"pier 0", 15.4}, {"pier 1", 27.2}, {"pier 2", 39.0}, {"abutment right", 52.15}};
  for (const auto& [name, x] : middles) {
    for (const char* side : {"y-", "y+"}) {
      for (const std::int64_t s : cs1.groups.at(fmt::format("spandrel {} {}", side, name))) {
        const Block& block = cs1.blocks[std::size_t(s)];
        EXPECT_EQ(block.component, Component::spandrel);
        EXPECT_NEAR(block_box(block).high.z(), 16.3, 1e-9);
        EXPECT_LT(std::abs(block.centroid.x() - x), 1.0);
        EXPECT_EQ(block.centroid.y() < 0.0, std::string(side) == "y-");
      }
    }
  }
}

/// All joints between two components.
std::vector<Joint> joints_between(const Assembly& bridge, Component p, Component q) {
  std::vector<Joint> found;
  for (const Joint& joint : bridge.joints) {
    const Component a = bridge.blocks[std::size_t(joint.a)].component,
                    b = bridge.blocks[std::size_t(joint.b)].component;
    if ((a == p && b == q) || (a == q && b == p)) found.push_back(joint);
  }
  return found;
}

void expect_all(const Assembly& bridge, Component p, Component q, double kn, double ks) {
  const std::vector<Joint> joints = joints_between(bridge, p, q);
  ASSERT_FALSE(joints.empty());
  for (const Joint& joint : joints) {
    ASSERT_NEAR(joint.kn / kn, 1.0, 1e-12);
    ASSERT_NEAR(joint.ks / ks, 1.0, 1e-12);
  }
}

TEST(Bridge, Cs1TakesItsJointsFromTheTable) {
  const Assembly bridge = build("cs1", input_of("cs1", 2.0, true));
  const double half = 0.5e6;  // MPa/m, at twice the block size
  expect_all(bridge, Component::arch, Component::arch, 8890 * half, 3560 * half);
  expect_all(bridge, Component::backing, Component::spandrel, 5520 * half, 2210 * half);
  expect_all(bridge, Component::pier, Component::pier, 5310 * half, 2120 * half);
  expect_all(bridge, Component::pier, Component::base, 5310 * half, 2120 * half);
  expect_all(bridge, Component::infill, Component::infill, 1330 * half, 531 * half);
  const auto series = [](double a, double b) { return 2.0 * a * b / (a + b); };
  expect_all(bridge, Component::arch, Component::pier, series(8890, 5310) * half, series(3560, 2120) * half);
  expect_all(bridge, Component::pier, Component::infill, 1330 * half, 531 * half);           // the row of the filling
  expect_all(bridge, Component::spandrel, Component::backfill, 0.2 * 5520e6, 0.2 * 2210e6);  // one layer at any scale
  expect_all(bridge, Component::arch, Component::backfill, 0.2 * 8890e6, 0.2 * 3560e6);
  expect_all(bridge, Component::restraint, Component::spandrel, 0.5 * 5520 * half, 0.5 * 2210 * half);
  for (const Joint& joint : joints_between(bridge, Component::backfill, Component::backfill)) {
    const Vec3 p = polygon_centroid(joint.polygon);
    const double da = std::abs(joint.normal.dot(bridge.blocks[std::size_t(joint.a)].centroid - p));
    const double db = std::abs(joint.normal.dot(bridge.blocks[std::size_t(joint.b)].centroid - p));
    if (std::min(da, db) < 0.08) continue;  // a least half-length applies
    ASSERT_NEAR(joint.kn, 400e6 / (da + db), 1.0);
  }
}

TEST(Bridge, Cs2TakesItsJointsFromTheModuli) {
  const Assembly bridge = build("cs2", input_of("cs2"));
  for (const Joint& joint : joints_between(bridge, Component::arch, Component::pier)) {
    const Vec3 p = polygon_centroid(joint.polygon);
    double flexibility = 0.0;
    for (const std::int64_t i : {joint.a, joint.b}) {
      const Block& block = bridge.blocks[std::size_t(i)];
      const double e = block.component == Component::arch ? 1.692e9 : 1.41e9;
      flexibility += std::abs(joint.normal.dot(block.centroid - p)) / e;
    }
    EXPECT_NEAR(joint.kn, 1.0 / flexibility, 10.0);
  }
  for (const Joint& joint : joints_between(bridge, Component::pier, Component::base)) {
    const Block& pier = bridge.blocks[std::size_t(std::min(joint.a, joint.b))];
    EXPECT_NEAR(joint.kn, 1.41e9 / (std::abs(pier.centroid.z() - polygon_centroid(joint.polygon).z()) + 0.5), 10.0);
  }
  expect_all(bridge, Component::spandrel, Component::backfill, 0.2 * 1150e6, 0.2 * 368e6);
}

TEST(Bridge, StrengthIsTheWeakerOfTwoAndFrictionOnlyAgainstFill) {
  const Assembly bridge = build("cs1", input_of("cs1", 2.5));
  const auto law = [&](Component p, Component q) {
    return bridge.laws[std::size_t(joints_between(bridge, p, q).front().law)];
  };
  const double degree = M_PI / 180.0;
  EXPECT_EQ(law(Component::arch, Component::arch).tension, 0.10e6);
  EXPECT_EQ(law(Component::arch, Component::arch).cohesion, 0.18e6);
  const JointLaw mixed = law(Component::pier, Component::infill);
  EXPECT_EQ(mixed.tension, 0.0);
  EXPECT_EQ(mixed.cohesion, 0.02e6);
  EXPECT_NEAR(mixed.friction_angle, 30.0 * degree, 1e-15);
  EXPECT_EQ(mixed.residual_cohesion, 0.0);
  EXPECT_EQ(mixed.residual_friction_angle, mixed.friction_angle);
  const JointLaw loose = law(Component::spandrel, Component::backfill);
  EXPECT_EQ(loose.tension + loose.cohesion, 0.0);
  EXPECT_NEAR(loose.friction_angle, 35.0 * degree, 1e-15);
  EXPECT_NEAR(law(Component::backfill, Component::backfill).friction_angle, 40.0 * degree, 1e-15);
  EXPECT_EQ(law(Component::pier, Component::base).cohesion, 0.18e6);
}

TEST(Bridge, OverridesOfTheCaseWin) {
  GeneratorInput input = input_of("cs1", 2.5);
  GeneratorInput::JointOverride& given = input.joints["infill-masonry"];
  given.kn = 7e8;
  given.has_law = true;
  given.law.kind = JointLaw::Kind::elastic;
  const Assembly bridge = build("cs1", input), plain = build("cs1", input_of("cs1", 2.5));
  const Joint joint = joints_between(bridge, Component::pier, Component::infill).front();
  EXPECT_EQ(joint.kn, 7e8);
  EXPECT_EQ(joint.ks, joints_between(plain, Component::pier, Component::infill).front().ks);
  EXPECT_EQ(bridge.laws[std::size_t(joint.law)].kind, JointLaw::Kind::elastic);
  input.joints = {{"masonry-concrete", {}}};
  EXPECT_THROW(build("cs1", input), InputError);
}

TEST(Bridge, AChangedModulusChangesTheTableInProportion) {
  GeneratorInput input = input_of("cs1", 2.5);
  input.materials["masonry"].youngs_modulus *= 0.5;
  const Assembly bridge = build("cs1", input);
  expect_all(bridge, Component::pier, Component::pier, 0.5 * 5310e6 / 2.5, 2120e6 / 2.5);
  expect_all(bridge, Component::infill, Component::infill, 1330e6 / 2.5, 531e6 / 2.5);
}

TEST(Bridge, ContradictionsNameTheirKeys) {
  const auto error = [](const std::string& name, const std::map<std::string, double>& values,
                        const std::map<std::string, std::string>& choices = {}) {
    GeneratorInput input = input_of(name, 2.0);
    for (const auto& [key, value] : values) input.values.at(key) = value;
    for (const auto& [key, word] : choices) input.choices.at(key) = word;
    try {
      build(name, input);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const auto names = [](const std::string& text, const std::string& key) {
    return text.find(key) != std::string::npos;
  };
  EXPECT_TRUE(names(error("cs1", {{"backing_height", 7.5}}), "backing_height = 7.5"));
  EXPECT_TRUE(names(error("cs1", {{"ring_thickness", 1.0}}), "pier_thickness = 1.6"));
  EXPECT_TRUE(names(error("cs2", {{"spandrel_thickness_bottom", 3.4}}), "spandrel_thickness_bottom = 6.8"));
  EXPECT_TRUE(names(error("cs1", {{"leaf_thickness_odd", 0.9}}), "leaf_thickness_odd = 1.8"));
  EXPECT_TRUE(names(error("cs1", {{"batter_x", 0.02}}), "batter_x = 0.02"));
  EXPECT_TRUE(names(error("cs1", {{"parapet_thickness", 0.5}}), "parapet_thickness = 0.5"));
  EXPECT_TRUE(names(error("cs1", {{"fill_edge", 0.01}}), "fill_edge = 0.01"));
  EXPECT_TRUE(names(error("cs1", {}, {{"abutments", "fixed"}}), "free, restrained"));
}

/// What its fill's surface leaves free is surface of the bridge.
double free_fill_surface(const Assembly& bridge) {
  double free = 0.0;
  for (std::size_t i = 0; i < bridge.fill.triangles.size(); ++i) {
    free += polygon_area(triangle_polygon(bridge.fill, std::int32_t(i)));
  }
  for (const FillJoint& joint : bridge.fill_joints) free -= joint.area;
  return free;
}

TEST(Bridge, ADeformableFillLeavesTheSameSurfaceAndLosesNothing) {
  const auto expect_closed = [](const std::string& name, bool restrained, double abutment, int voussoirs) {
    GeneratorInput input = input_of(name, 2.0, restrained);
    input.values["spans"] = 1.0;
    input.values["fill_edge"] = 1.5;
    input.values["backing_over_abutment"] = abutment;
    input.choices["backfill"] = "deformable";
    const Assembly bridge = build(name, input);
    const Analytic analytic{input, voussoirs};
    EXPECT_NEAR(uncovered_surface(bridge) + free_fill_surface(bridge), analytic.surface(), 1e-3) << name;
    EXPECT_NEAR(moving_volume(bridge) + fill_volume(bridge.fill), analytic.volume(), 1e-6) << name;
  };
  expect_closed("cs1", false, 4.8, 20);
  expect_closed("cs1", true, 2.4, 20);  // fill behind the abutments from the base to the deck
  expect_closed("cs2", true, 7.5, 22);
}

TEST(Bridge, OtherSizesAndMakeUpsCloseToo) {
  GeneratorInput one = input_of("cs2", 1.5);
  one.values["spans"] = 1.0;
  EXPECT_NEAR(uncovered_surface(build("cs2", one)), (Analytic{one, 28}.surface()), 1e-3);
  GeneratorInput solid = input_of("cs1", 1.5);
  solid.choices["makeup"] = "solid";
  solid.values["spans"] = 2.0;
  solid.values["voussoirs"] = 19.0;
  EXPECT_NEAR(uncovered_surface(build("cs1", solid)), (Analytic{solid, 19}.surface()), 1e-3);
  GeneratorInput longer = input_of("cs1", 2.5);  // the reading with the paper's total length of 62 m
  longer.values["abutment_length"] = 8.6;
  EXPECT_NEAR(uncovered_surface(build("cs1", longer)), (Analytic{longer, 16}.surface()), 1e-3);
  GeneratorInput running = input_of("cs1", 2.5);
  running.choices["fill_bond"] = "running";
  const Assembly bonded = build("cs1", running), stack = build("cs1", input_of("cs1", 2.5));
  EXPECT_NEAR(uncovered_surface(bonded), (Analytic{running, 16}.surface()), 1e-3);
  EXPECT_LT(stack.joints.size(), bonded.joints.size());
  GeneratorInput empty = input_of("cs1", 2.5);
  empty.choices["backfill"] = "none";
  for (const Block& block : build("cs1", empty).blocks) EXPECT_NE(block.component, Component::backfill);
}

TEST(Bridge, TheSameInputGivesTheSameBits) {
  const Assembly a = build("cs2", input_of("cs2", 2.0)), b = build("cs2", input_of("cs2", 2.0));
  ASSERT_EQ(a.joints.size(), b.joints.size());
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    ASSERT_EQ(a.joints[i].kn, b.joints[i].kn);
    ASSERT_EQ(a.joints[i].polygon.front(), b.joints[i].polygon.front());
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
