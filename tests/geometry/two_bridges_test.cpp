// The two bridges cs1 and cs2 as sets of values of the generator "bridge": the assemblies of "cs1" and "cs2".
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>
#include <string>

#include "geometry/generator.h"
#include "solver/base/constants.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// The keys of cs1 or cs2 said with those of "bridge".
GeneratorInput as_any_bridge(const GeneratorInput& cs) {
  const Generator& generator = find_generator("bridge");
  GeneratorInput in = default_input(generator);
  const auto spans = std::size_t(cs("spans"));
  in.entries["span"] = spans, in.entries["pier"] = spans - 1;
  const Keys keys = keys_of(generator, in);
  for (const Parameter& p : keys.parameters) in.values.try_emplace(p.name, p.value);
  for (const Choice& c : keys.choices) in.choices.try_emplace(c.name, c.words.front());
  for (auto& [name, value] : in.values)
    if (cs.values.contains(name)) value = cs(name);  // of the same name: most of them
  for (auto& [name, word] : in.choices)
    if (cs.choices.contains(name)) word = cs.choices.at(name);
  const bool leaf = cs.choices.at("makeup") == "leaf";
  const int voussoirs = 2 * int(std::ceil(0.25 * pi * (cs("clear_span") + cs("ring_thickness")) /
                                              (cs("voussoir_length") * cs("block_scale")) -
                                          1e-9));
  for (std::size_t i = 0; i < spans; ++i) {
    const std::string key = fmt::format("span.{}.", i + 1);
    in.values[key + "clear_span"] = cs("clear_span"), in.values[key + "ring_thickness"] = cs("ring_thickness");
    in.values[key + "voussoirs"] = voussoirs;
  }
  for (std::size_t i = 0; i + 1 < spans; ++i) {
    const std::string key = fmt::format("pier.{}.", i + 1);
    const double own = cs(fmt::format("pier_{}_height", i));
    in.values[key + "height"] = own > 0.0 ? own : cs("pier_height");
    in.values[key + "thickness"] = cs("pier_thickness");
    in.values[key + "batter_x"] = cs("batter_x"), in.values[key + "batter_y"] = cs("batter_y");
    in.choices[key + "makeup"] = leaf ? "leaf" : "solid";
  }
  for (const std::string key : {"abutment.left.", "abutment.right."}) {
    in.values[key + "length"] = cs("abutment_length"), in.values[key + "height"] = cs("abutment_height");
    in.values[key + "batter_y"] = cs("batter_y");
    in.values[key + "built_length"] = leaf ? cs("abutment_leaf_length") : 0.0;
    in.choices[key + "makeup"] = leaf ? "leaf" : "solid";
  }
  in.values["deck_height"] = 0.5 * cs("clear_span") + cs("ring_thickness") + cs("fill_over_crown");
  in.materials = cs.materials;
  if (!in.materials.contains("vault"))
    in.materials["vault"] = in.materials.at("masonry"), in.materials["vault"].name = "vault";
  if (!in.materials.contains("infill"))
    in.materials["infill"] = in.materials.at("masonry"), in.materials["infill"].name = "infill";
  for (const Material& m : generator.materials) in.materials.try_emplace(m.name, m);  // of what they do not have
  return in;
}

/// Stiffness (N/m) and area of all joints of two blocks; how a cut stone falls into cells may depend on rounding.
struct Pair {
  double area = 0.0, kn = 0.0, ks = 0.0;
  std::set<std::array<double, 3>> strengths;
};
std::map<std::pair<std::int64_t, std::int64_t>, Pair> pairs_of(const Assembly& assembly) {
  std::map<std::pair<std::int64_t, std::int64_t>, Pair> pairs;
  for (const Joint& joint : assembly.joints) {
    Pair& pair = pairs[{joint.a, joint.b}];
    pair.area += joint.area, pair.kn += joint.area * joint.kn, pair.ks += joint.area * joint.ks;
    const JointLaw& law = assembly.laws[std::size_t(joint.law)];
    pair.strengths.insert({law.tension, law.cohesion, law.friction_angle});
  }
  return pairs;
}

void expect_same(const Assembly& a, const Assembly& b) {
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    const Block &p = a.blocks[i], &q = b.blocks[i];
    ASSERT_TRUE(p.component == q.component && p.part == q.part && p.fixed == q.fixed) << i;
    ASSERT_NEAR(p.mass, q.mass, 1e-12 * p.mass) << i;
    ASSERT_LT((p.centroid - q.centroid).norm(), 1e-12 * (1.0 + p.centroid.norm())) << i;
    ASSERT_LT((p.inertia - q.inertia).norm(), 1e-9 * p.inertia.norm()) << i;
  }
  const auto one = pairs_of(a), other = pairs_of(b);
  ASSERT_EQ(one.size(), other.size());
  for (const auto& [blocks, p] : one) {
    ASSERT_TRUE(other.contains(blocks)) << blocks.first << " " << blocks.second;
    const Pair& q = other.at(blocks);
    ASSERT_NEAR(p.area, q.area, 1e-12 * (1.0 + p.area));
    ASSERT_NEAR(p.kn, q.kn, 1e-11 * p.kn);
    ASSERT_NEAR(p.ks, q.ks, 1e-11 * p.ks);
    ASSERT_EQ(p.strengths, q.strengths);
  }
  EXPECT_EQ(a.groups, b.groups);
}

/// Kilograms of each component that can move.
std::map<Component, double> masses_of(const Assembly& assembly) {
  std::map<Component, double> masses;
  for (const Block& block : assembly.blocks) masses[block.component] += block.fixed ? 0.0 : block.mass;
  return masses;
}

class TwoBridges : public testing::TestWithParam<const char*> {
 protected:
  /// The bridge as it is, or with lengths along it that are sums of powers of two: exact in whatever order they are
  /// added, so that no stone is a sliver by rounding.
  GeneratorInput input(bool exact) const {
    GeneratorInput in = default_input(find_generator(GetParam()));
    if (!exact) return in;
    const bool first = GetParam() == std::string("cs1");
    in.values["clear_span"] = first ? 10.0 : 15.0, in.values["pier_thickness"] = first ? 1.625 : 3.5;
    in.values["abutment_length"] = in.values["backing_over_abutment"] = first ? 4.75 : 7.5;
    if (first) in.values["abutment_leaf_length"] = 4.75;
    in.values["ring_thickness"] = 0.75, in.values["fill_over_crown"] = 1.125;
    return in;
  }
};

TEST_P(TwoBridges, AreSetsOfValuesOfAnyBridge) {
  for (const char* abutments : {"free", "restrained"}) {
    for (const double scale : {1.0, 2.5}) {
      GeneratorInput in = input(true);
      in.choices["abutments"] = abutments;
      in.values["block_scale"] = scale;
      SCOPED_TRACE(fmt::format("{} {}", abutments, scale));
      expect_same(find_generator(GetParam()).build(in), find_generator("bridge").build(as_any_bridge(in)));
    }
  }
}

TEST_P(TwoBridges, HaveTheMassesTheyHaveAsTheyAre) {
  const GeneratorInput in = input(false);
  const auto one = masses_of(find_generator(GetParam()).build(in)),
             other = masses_of(find_generator("bridge").build(as_any_bridge(in)));
  ASSERT_EQ(one.size(), other.size());
  for (const auto& [component, mass] : one) EXPECT_NEAR(other.at(component), mass, 1e-10 * mass) << int(component);
}

TEST_P(TwoBridges, WithADeformableFillAsWell) {
  GeneratorInput in = input(true);
  in.values["block_scale"] = 2.5;
  if (GetParam() == std::string("cs1")) in.values["abutment_length"] = 8.625;  // with wing walls
  in.choices["backfill"] = "deformable", in.values["fill_edge"] = 1.0;
  const Assembly a = find_generator(GetParam()).build(in), b = find_generator("bridge").build(as_any_bridge(in));
  expect_same(a, b);
  EXPECT_EQ(a.fill.tets.size(), b.fill.tets.size());
  ASSERT_EQ(a.fill_joints.size(), b.fill_joints.size());
  for (std::size_t i = 0; i < a.fill_joints.size(); ++i)
    ASSERT_NEAR(a.fill_joints[i].kn, b.fill_joints[i].kn, 1e-9 * a.fill_joints[i].kn) << i;
}

INSTANTIATE_TEST_SUITE_P(All, TwoBridges, testing::Values("cs1", "cs2"), [](const auto& i) { return i.param; });

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
