// What the generator "bridge" lays for loading tests: a beam across the fill, and a strip in plane strain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/fill_mesh.h"
#include "geometry/generator.h"
#include "geometry/joints.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

GeneratorInput one_span(const std::string& backfill, const std::map<std::string, double>& values) {
  GeneratorInput in = default_input(find_generator("bridge"));
  in.choices["backfill"] = backfill;
  in.values["width"] = 5.0, in.values["block_scale"] = 2.0, in.values["fill_edge"] = 0.9;
  for (const auto& [key, value] : values) in.values[key] = value;
  return in;
}

Assembly built(const GeneratorInput& in) {
  return find_generator("bridge").build(in);
}

/// m2 of joints between one block and blocks of a component, or the fill.
double area_on(const Assembly& assembly, std::int64_t block, bool fill) {
  double sum = 0.0;
  for (const FillJoint& joint : assembly.fill_joints)
    if (fill && joint.block == block) sum += joint.area;
  for (const Joint& joint : assembly.joints) {
    if (joint.a != block && joint.b != block) continue;
    const Block& other = assembly.blocks[std::size_t(joint.a == block ? joint.b : joint.a)];
    if (fill && other.component == Component::backfill) sum += joint.area;
  }
  return sum;
}

TEST(LoadBeam, LiesOnTheFillFromWallToWall) {
  for (const char* backfill : {"rigid", "deformable"})
    for (const double skew : {0.0, 30.0}) {
      SCOPED_TRACE(std::string(backfill) + ", skew " + std::to_string(skew));
      const Assembly assembly = built(one_span(backfill, {{"beam.length", 0.7}, {"beam.at", 0.25}, {"skew", skew}}));
      const std::int64_t beam = assembly.groups.at("load").at(0);
      EXPECT_TRUE(assembly.blocks[std::size_t(beam)].fixed);
      const double across = 5.0 - 2.0 * 0.6;
      EXPECT_NEAR(area_on(assembly, beam, true), 0.7 * across / std::cos(radians(skew)), 1e-9);
      // Laid out square at 4 m + a quarter of 8 m; the turn moves what lies at y = 0 along the bridge alone.
      EXPECT_NEAR(assembly.blocks[std::size_t(beam)].centroid.x(), 6.0 / std::cos(radians(skew)), 1e-9);
      EXPECT_TRUE(find_overlaps(assembly, 1e-4).empty());
    }
}

TEST(LoadBeam, IsRefusedWhereItCannotLie) {
  const auto refused = [](const std::map<std::string, double>& values, const char* backfill, const char* word) {
    const std::string said = message_of<InputError>([&] { built(one_span(backfill, values)); });
    EXPECT_NE(said.find(word), std::string::npos) << said;
  };
  refused({{"beam.length", 9.0}, {"beam.at", 0.0}}, "rigid", "beyond the end");
  refused({{"beam.length", 0.5}, {"beam.span", 2.0}}, "rigid", "span = 2");
  refused({{"beam.length", 0.5}}, "none", "backfill");
}

/// The vault, the fill and the whole are their sections times the width; nothing rubs on the walls.
TEST(Strip, IsItsSectionTimesItsWidth) {
  for (const char* backfill : {"rigid", "deformable"}) {
    GeneratorInput in = one_span(backfill, {{"strip_width", 0.4}});
    in.choices["extent"] = "strip";
    const Assembly assembly = built(in);
    const double r0 = 4.0, r1 = 4.5, deck = 4.5 + 0.5, length = 16.0, backing = 1.0;
    double arch = 0.0, fill = fill_volume(assembly.fill), other = 0.0;
    for (const Block& block : assembly.blocks) {
      if (block.fixed) continue;
      const double volume = mass_properties(block.cells).volume;
      (block.component == Component::arch ? arch : block.component == Component::backfill ? fill : other) += volume;
    }
    const auto voussoirs = double(std::count_if(assembly.blocks.begin(), assembly.blocks.end(),
                                                [](auto& b) { return b.component == Component::arch; }));
    const double half = 0.5 * pi / voussoirs,
                 flat = voussoirs * std::sin(half) * std::cos(half);  // of a ring of unit radius
    EXPECT_NEAR(arch, 0.4 * flat * (r1 * r1 - r0 * r0), 1e-9);
    // Above the springing: all of the box less the polygon under the extrados, less the backing.
    EXPECT_NEAR(arch + fill + other - 0.4 * (2.0 * 4.0 * 4.0), 0.4 * (length * deck - flat * r0 * r0), 1e-9)
        << "with abutments of 4 m by 4 m";
    EXPECT_GT(other, 0.4 * backing * 2.0 * 3.0);
    const auto& walls = assembly.groups.at("walls");
    ASSERT_EQ(walls.size(), 2u);
    std::size_t on_walls = 0;
    const auto rubs = [&](std::int32_t law) {
      const JointLaw& l = assembly.laws[std::size_t(law)];
      return l.friction_angle != 0.0 || l.cohesion != 0.0 || l.tension != 0.0;
    };
    std::size_t rough = 0;
    for (const std::int64_t wall : walls) {
      for (const Joint& joint : assembly.joints)
        if (joint.a == wall || joint.b == wall) ++on_walls, rough += rubs(joint.law);
      for (const FillJoint& joint : assembly.fill_joints)
        if (joint.block == wall) ++on_walls, rough += rubs(joint.law);
    }
    EXPECT_EQ(rough, 0u);
    EXPECT_GT(on_walls, 20u);
  }
}

TEST(Strip, IsSquareAndSolid) {
  GeneratorInput skew = one_span("rigid", {{"strip_width", 0.4}, {"skew", 10.0}});
  skew.choices["extent"] = "strip";
  EXPECT_NE(message_of<InputError>([&] { built(skew); }).find("skew"), std::string::npos);
  GeneratorInput leaf = one_span("rigid", {{"strip_width", 0.4}});
  leaf.choices["extent"] = "strip", leaf.choices["abutment.left.makeup"] = "leaf";
  EXPECT_NE(message_of<InputError>([&] { built(leaf); }).find("makeup"), std::string::npos);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
