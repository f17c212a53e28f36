// The catalogue of generators, their keys, and the small ones: arch, wall, column.
#include "geometry/generator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "geometry/joints.h"
#include "solver/base/error.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

Assembly build(const std::string& name, const std::map<std::string, double>& values = {}) {
  GeneratorInput input = default_input(find_generator(name));
  for (const auto& [key, value] : values) input.values.at(key) = value;
  return find_generator(name).build(input);
}

std::string error_of(const std::string& name, const GeneratorInput& input) {
  try {
    find_generator(name).build(input);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::int64_t moving(const Assembly& assembly) {
  return std::count_if(assembly.blocks.begin(), assembly.blocks.end(), [](const Block& b) { return !b.fixed; });
}

double moving_mass(const Assembly& assembly) {
  double sum = 0.0;
  for (const Block& block : assembly.blocks) sum += block.fixed ? 0.0 : block.mass;
  return sum;
}

TEST(Generators, DefaultsAreWithinTheirRangesAndNamesAreUnique) {
  std::set<std::string> names;
  for (const Generator& generator : generators()) {
    EXPECT_TRUE(names.insert(generator.name).second);
    EXPECT_NO_THROW(check_input(generator, default_input(generator))) << generator.name;
    std::set<std::string> keys;
    const std::string table = describe(generator);
    for (const Parameter& p : generator.parameters) {
      EXPECT_TRUE(keys.insert(p.name).second) << p.name;
      EXPECT_FALSE(p.unit.empty() || p.help.empty()) << p.name;
      EXPECT_NE(table.find("| `" + p.name + "` |"), std::string::npos) << p.name;
    }
  }
  for (const char* name : {"cs1", "cs2", "arch", "wall", "column", "filled-arch"})
    EXPECT_EQ(names.count(name), 1u) << name;
}

TEST(Generators, AMisspeltNameIsSaidWhereItStands) {
  try {
    find_generator("archh", "--keys");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()).find("--keys \"archh\": there is no generator of this name, did you mean \"arch\"?"),
        0u)
        << error.what();
  }
}

TEST(Generators, UnknownNameListsTheKnownOnes) {
  try {
    find_generator("cs3");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("cs1, cs2, bridge, arch, wall, column, filled-arch"), std::string::npos)
        << error.what();
  }
}

TEST(Generators, BadValuesAreNamed) {
  const GeneratorInput good = default_input(find_generator("wall"));
  GeneratorInput bad = good;
  bad.values["courses"] = 2.5;
  EXPECT_NE(error_of("wall", bad).find("courses = 2.5"), std::string::npos);
  bad = good;
  bad.values["block_height"] = -1.0;
  EXPECT_NE(error_of("wall", bad).find("block_height = -1"), std::string::npos);
  bad = good;
  bad.values["hight"] = 1.0;
  EXPECT_NE(error_of("wall", bad).find("\"hight\""), std::string::npos);
  bad = good;
  bad.values.erase("courses");
  EXPECT_NE(error_of("wall", bad).find("courses"), std::string::npos);
  bad = good;
  bad.values["kn"] = 1e9;  // without ks
  EXPECT_NE(error_of("wall", bad).find("ks = 0"), std::string::npos);
  bad = good;
  bad.materials["masonry"].density = 0.0;
  EXPECT_NE(error_of("wall", bad).find("density"), std::string::npos);
}

TEST(Generators, BlocksWithoutEndAreRefusedWithTheirNumber) {
  GeneratorInput wall = default_input(find_generator("wall"));
  wall.values["length_blocks"] = wall.values["courses"] = 10000.0;
  EXPECT_NE(error_of("wall", wall).find("gives 1e+08 blocks; at most 2e+06 are allowed"), std::string::npos)
      << error_of("wall", wall);
  GeneratorInput bridge = default_input(find_generator("cs1"));
  for (const char* key : {"block_length", "block_width", "block_height", "fill_length", "fill_width", "fill_height"})
    bridge.values.at(key) = 0.05;
  bridge.values["block_scale"] = 0.25;
  EXPECT_NE(error_of("cs1", bridge).find("blocks; at most 2e+06 are allowed"), std::string::npos);
}

TEST(Generators, FeetThatGrowIntoOneAnotherAreRefused) {
  GeneratorInput bridge = default_input(find_generator("cs2"));
  bridge.values["batter_x"] = 0.3, bridge.values["pier_height"] = 40.0;
  EXPECT_NE(error_of("cs2", bridge).find("the feet of pier 0 and pier 1 overlap"), std::string::npos)
      << error_of("cs2", bridge);
}

TEST(Wall, CountsOfBlocksAndJoints) {
  const Assembly small = build("wall");
  EXPECT_EQ(moving(small), 105);
  EXPECT_EQ(small.joints.size(), 285u);
  const Assembly large = build("wall", {{"length_blocks", 32.0}, {"courses", 32.0}});
  EXPECT_EQ(moving(large), 1040);
  EXPECT_EQ(large.joints.size(), 3024u);
  EXPECT_NEAR(moving_mass(small), 2000.0 * 6.0 * 5.0 * 0.45, 1e-6);
  EXPECT_EQ(small.groups.at("top").size(), 11u);
}

TEST(Wall, MayEndInHalfABlockOnEitherSide) {
  const Assembly wall = build("wall", {{"length_blocks", 4.5}, {"courses", 16.0}});
  EXPECT_EQ(moving(wall), 16 * 5);
  EXPECT_EQ(wall.joints.size(), 16u * 4 + 15u * 9 + 5u);
  EXPECT_NEAR(moving_mass(wall), 2000.0 * 2.7 * 8.0 * 0.45, 1e-6);
  GeneratorInput third = default_input(find_generator("wall"));
  third.values["length_blocks"] = 4.3;
  EXPECT_NE(error_of("wall", third).find("length_blocks = 4.3"), std::string::npos);
}

TEST(Wall, BlocksMayCrackInTheirMiddle) {
  const Assembly wall =
      build("wall", {{"length_blocks", 4.5}, {"courses", 3.0}, {"crack_strength", 2e6}, {"crack_energy", 80.0}});
  EXPECT_EQ(moving(wall), 3 * 9);
  int cracks = 0, heads = 0;
  for (const Joint& joint : wall.joints) {
    const JointLaw& law = wall.laws[std::size_t(joint.law)];
    const bool upright = std::abs(joint.normal.x()) > 0.5;
    cracks += upright && law.tension == 2e6, heads += upright && law.tension == 0.0;
    EXPECT_TRUE(upright || law.tension == 0.0);
    if (law.tension == 0.0) continue;
    EXPECT_EQ(law.kind, JointLaw::Kind::composite);
    EXPECT_NEAR(joint.kn, 4e9 / 0.3, 1.0);
    const Vec3 at = polygon_centroid(joint.polygon);  // whole blocks from 0 in even courses, from 0.3 m in odd ones
    const double from = int(at.z() / 0.5) % 2 ? 0.3 : 0.0;
    EXPECT_NEAR(std::remainder(at.x() - from - 0.3, 0.6), 0.0, 1e-9);
  }
  EXPECT_EQ(cracks, 3 * 4);
  EXPECT_EQ(heads, 3 * 4);
}

TEST(Wall, StiffnessFromTheModuliAndFromTheKeys) {
  const Assembly wall = build("wall");
  for (const Joint& joint : wall.joints) {
    const Block &a = wall.blocks[std::size_t(joint.a)], &b = wall.blocks[std::size_t(joint.b)];
    if (a.fixed || b.fixed || std::abs(joint.normal.z()) > 0.5) {
      EXPECT_NEAR(joint.kn, 4.0e9 / 0.50, 1.0);  // bed joints, and the base: half a block above, half a nominal one
      EXPECT_NEAR(joint.ks, 1.6e9 / 0.50, 1.0);
    } else {
      EXPECT_NEAR(joint.kn, 4.0e9 / std::abs(a.centroid.x() - b.centroid.x()), 1.0);
    }
    EXPECT_EQ(wall.laws[std::size_t(joint.law)].tension, 0.0);
    EXPECT_NEAR(wall.laws[std::size_t(joint.law)].friction_angle, M_PI / 6.0, 1e-15);
  }
  const Assembly given = build("wall", {{"kn", 3e9}, {"ks", 2e9}});
  for (const Joint& joint : given.joints) EXPECT_TRUE(joint.kn == 3e9 && joint.ks == 2e9);
}

TEST(Column, StackOnAFixedBlockOfTheSameStiffness) {
  const Assembly column = build("column", {{"blocks", 10.0}, {"block_height", 0.4}});
  EXPECT_EQ(column.blocks.size(), 11u);
  ASSERT_EQ(column.joints.size(), 10u);
  for (const Joint& joint : column.joints) {
    EXPECT_NEAR(joint.kn, 4.0e9 / 0.4, 10.0);
    EXPECT_NEAR(joint.ks, 1.6e9 / 0.4, 4.0);
    EXPECT_NEAR(joint.area, 1.0, 1e-12);
  }
  EXPECT_EQ(column.groups.at("top").front(), 9);
  EXPECT_NEAR(column.blocks[9].centroid.z(), 3.8, 1e-12);
}

TEST(Arch, OppenheimMassJointsAndSpringingPlanes) {
  const Assembly arch = build("arch", {{"embrace_angle", 157.5}, {"voussoirs", 7.0}, {"thickness_ratio", 0.15}});
  EXPECT_EQ(moving(arch), 7);
  ASSERT_EQ(arch.joints.size(), 8u);
  const double step = 157.5 / 7.0 * M_PI / 180.0;
  const double area = 0.5 * std::sin(step) * (10.75 * 10.75 - 9.25 * 9.25);  // flat-faced wedge
  EXPECT_NEAR(moving_mass(arch), 7.0 * 2000.0 * area, 1e-6);
  int springings = 0;
  for (const Joint& joint : arch.joints) {
    EXPECT_NEAR(joint.area, 1.5, 1e-9);
    const bool fixed = arch.blocks[std::size_t(joint.a)].fixed || arch.blocks[std::size_t(joint.b)].fixed;
    if (!fixed) continue;
    ++springings;  // the plane of the joint makes 78.75 degrees with the vertical
    EXPECT_NEAR(std::abs(joint.normal.z()), std::sin(78.75 * M_PI / 180.0), 1e-12);
  }
  EXPECT_EQ(springings, 2);
  EXPECT_EQ(arch.groups.at("keystone 0"), std::vector<std::int64_t>{3});
  EXPECT_EQ(arch.groups.at("voussoir 5"), std::vector<std::int64_t>{5});
}

TEST(Arch, RowsLieInStretcherBondAndLeaveNothingOpen) {
  const Assembly arch = build("arch", {{"voussoirs", 9.0}, {"rows", 3.0}, {"width", 3.0}, {"thickness", 1.0}});
  EXPECT_EQ(moving(arch), 5 * 3 + 4 * 4);
  double outer = 0.0;  // soffit, back and sides of the arch; five free faces of each springing block
  const double step = M_PI / 9.0, in = 9.5, out = 10.5;
  const double side = 0.5 * std::sin(step) * (out * out - in * in);
  outer += 11.0 * (2.0 * side + 3.0 * 2.0 * std::sin(0.5 * step) * (in + out)) + 2.0 * 1.0 * 3.0;
  EXPECT_NEAR(uncovered_surface(arch), outer, 1e-6);
  EXPECT_TRUE(find_overlaps(arch, 1e-9).empty());
}

TEST(Arch, PointedArchMeetsInTheMiddlePlane) {
  const Assembly arch = build("arch", {{"voussoirs", 12.0}, {"eccentricity", 0.3}, {"thickness", 1.0}});
  EXPECT_EQ(arch.joints.size(), 13u);
  EXPECT_EQ(arch.groups.at("keystone 0").size(), 2u);
  int middle = 0;
  for (const Joint& joint : arch.joints) {
    if (std::abs(std::abs(joint.normal.x()) - 1.0) > 1e-9) continue;
    ++middle;  // heights of the two circles, centre 3 m beyond the middle line
    EXPECT_NEAR(joint.area, std::sqrt(10.5 * 10.5 - 9.0) - std::sqrt(9.5 * 9.5 - 9.0), 1e-9);
  }
  EXPECT_EQ(middle, 1);
  EXPECT_TRUE(find_overlaps(arch, 1e-9).empty());
  GeneratorInput odd = default_input(find_generator("arch"));
  odd.values["eccentricity"] = 0.3;
  EXPECT_NE(error_of("arch", odd).find("even"), std::string::npos);
}

/// Ring, two buttresses in courses, the fixed blocks under them; with level, rising and falling springing joints.
TEST(Arch, StandsOnButtresses) {
  for (const double embrace : {180.0, 150.0, 195.0}) {
    const Assembly arch = build("arch", {{"mean_radius", 5.0},
                                         {"thickness", 0.8},
                                         {"voussoirs", 11.0},
                                         {"embrace_angle", embrace},
                                         {"width", 1.5},
                                         {"buttress_width", 2.0},
                                         {"buttress_height", 3.0},
                                         {"buttress_courses", 3.0}});
    EXPECT_EQ(arch.blocks.size(), std::size_t(11 + 6 + 2));
    EXPECT_EQ(moving(arch), 11 + 6);
    EXPECT_EQ(arch.joints.size(), std::size_t(10 + 2 + 6)) << embrace;
    EXPECT_TRUE(find_overlaps(arch, 1e-9).empty());
    EXPECT_EQ(arch.groups.at("buttress left").size(), 3u);
    // Below the joint's lower point 2 × 3 m. Above it: a joint that rises outwards and a level top; one that falls
    // outwards is extended.
    const double foot = 0.5 * embrace * std::numbers::pi / 180.0, run = 0.8 * std::sin(foot),
                 rise = 0.8 * std::cos(foot);
    const double above = rise >= 0.0 ? rise * (2.0 - 0.5 * run) : -rise * 2.0 * (1.0 - 1.0 / run);
    for (const char* side : {"buttress left", "buttress right"}) {
      double mass = 0.0;
      for (const std::int64_t b : arch.groups.at(side)) mass += arch.blocks[std::size_t(b)].mass;
      EXPECT_NEAR(mass, 2000.0 * 1.5 * (6.0 + above), 1e-6) << side << " at " << embrace;
    }
    EXPECT_TRUE(arch.blocks[std::size_t(arch.groups.at("base right").at(0))].fixed);
    EXPECT_EQ(arch.groups.count("springing left"), 0u);
  }
  GeneratorInput slim = default_input(find_generator("arch"));
  slim.values["buttress_height"] = 3.0;
  slim.values["buttress_width"] = 1.0;
  EXPECT_NE(
      error_of("arch", slim).find("buttress_width = 1 m is less than the width of the springing joint in plan, 1.5 m"),
      std::string::npos);
  GeneratorInput low = default_input(find_generator("arch"));
  for (const auto& [key, value] : {std::pair{"embrace_angle", 200.0},
                                   {"mean_radius", 10.0},
                                   {"thickness", 1.5},
                                   {"buttress_width", 8.0},
                                   {"buttress_height", 1.0}})
    low.values[key] = value;
  EXPECT_NE(error_of("arch", low).find("slopes down by 1.41 m over this width, but its top course is 1 m high"),
            std::string::npos)
      << error_of("arch", low);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
