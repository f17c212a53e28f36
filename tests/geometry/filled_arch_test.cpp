// filled-arch: its fill, what touches it and how, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/fill_mesh.h"
#include "geometry/generator.h"
#include "geometry/joints.h"
#include "solver/base/error.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// Coarse, of 4 m span, 1 m rise and 0.3 m thickness.
Assembly small_bridge(const std::map<std::string, double>& more = {}) {
  const Generator& generator = find_generator("filled-arch");
  GeneratorInput input = default_input(generator);
  std::map<std::string, double> values = {{"clear_span", 4.0},      {"rise", 1.0},     {"ring_thickness", 0.3},
                                          {"voussoirs", 11.0},      {"approach", 1.5}, {"width", 0.6},
                                          {"fill_over_crown", 0.4}, {"fill_edge", 0.6}};
  for (const auto& [key, value] : more) values[key] = value;
  for (const auto& [key, value] : values) input.values.at(key) = value;
  return generator.build(input);
}

std::string complaint(const std::map<std::string, double>& values) {
  try {
    small_bridge(values);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool in_group(const Assembly& assembly, const char* group, std::int64_t block) {
  const auto& blocks = assembly.groups.at(group);
  return std::find(blocks.begin(), blocks.end(), block) != blocks.end();
}

TEST(FilledArch, FillTakesUpWhatIsLeft) {
  const Assembly assembly = small_bridge();
  const double radius = 2.5, outer = radius + 0.3, half_angle = std::asin(2.0 / radius), foot = outer * 0.6 - 1.5;
  const double under = 0.5 * outer * outer * (11.0 * std::sin(2.0 * half_angle / 11.0) - std::sin(2.0 * half_angle));
  const double section = 7.0 * (1.7 - foot) - under;
  EXPECT_NEAR(fill_volume(assembly.fill), 0.6 * section, 1e-9);
  // Of the fill's surface only the deck beside the beam is bare.
  double surface = 0.0, covered = 0.0;
  for (std::size_t i = 0; i < assembly.fill.triangles.size(); ++i)
    surface += polygon_area(triangle_polygon(assembly.fill, std::int32_t(i)));
  for (const FillJoint& joint : assembly.fill_joints) covered += joint.area;
  EXPECT_NEAR(surface - covered, 0.6 * (7.0 - 0.3), 1e-7);
  EXPECT_TRUE(find_overlaps(assembly, 1e-9).empty());
}

TEST(FilledArch, RingStandsOnItsSpringings) {
  const Assembly assembly = small_bridge();
  int ring = 0, springing = 0;
  double lowest = 1e300, highest = -1e300;
  for (const Joint& joint : assembly.joints) {
    if (in_group(assembly, "walls", joint.a) || in_group(assembly, "walls", joint.b)) continue;
    EXPECT_NEAR(joint.area, 0.3 * 0.6, 1e-12);
    const bool fixed = in_group(assembly, "springing left", joint.b) || in_group(assembly, "springing right", joint.b);
    (fixed ? springing : ring) += 1;
  }
  EXPECT_EQ(ring, 10);
  EXPECT_EQ(springing, 2);
  for (int i = 0; i < 11; ++i)
    for (const Vec3& p : assembly.blocks[std::size_t(i)].cells[0].vertices)
      lowest = std::min(lowest, p.z()), highest = std::max(highest, p.z());
  EXPECT_NEAR(lowest, 0.0, 1e-12);
  EXPECT_NEAR(highest, 1.0 - 2.5 + 2.8 * std::cos(std::asin(0.8) / 11.0), 1e-12);  // the corners of the key
  EXPECT_EQ(assembly.groups.at("keystone 0"), std::vector<std::int64_t>{5});
}

TEST(FilledArch, WallsAreSmoothAndTheRestIsRough) {
  const Assembly assembly = small_bridge({{"interface_friction", 30.0}, {"interface_depth", 0.2}});
  const auto check = [&](const auto& joint, double friction, double cohesion) {
    const JointLaw& law = assembly.laws[std::size_t(joint.law)];
    EXPECT_NEAR(law.friction_angle * 180.0 / M_PI, friction, 1e-9);
    EXPECT_NEAR(law.residual_friction_angle * 180.0 / M_PI, friction, 1e-9);
    EXPECT_EQ(law.cohesion, cohesion);
    EXPECT_EQ(law.tension, 0.0);
  };
  int walls = 0, ring = 0, beam = 0;
  for (const FillJoint& joint : assembly.fill_joints) {
    EXPECT_NEAR(joint.kn, 50e6 / 0.2, 1.0);
    EXPECT_NEAR(joint.ks, 19.2e6 / 0.2, 1.0);
    if (in_group(assembly, "walls", joint.block)) {
      check(joint, 0.0, 0.0), ++walls;
    } else if (!assembly.blocks[std::size_t(joint.block)].fixed) {
      check(joint, 30.0, 0.0), ++ring;
    } else {
      check(joint, 37.0, 7e3), beam += in_group(assembly, "load", joint.block);
    }
  }
  EXPECT_GT(walls, 0);
  EXPECT_GT(ring, 0);
  EXPECT_GT(beam, 0);
  int sides = 0;
  for (const Joint& joint : assembly.joints)
    if (in_group(assembly, "walls", joint.b)) check(joint, 0.0, 0.0), ++sides;
  EXPECT_EQ(sides, 22);
}

TEST(FilledArch, WhatCannotBeIsSaid) {
  EXPECT_NE(complaint({{"rise", 1.9}}).find("rise = 1.9 m"), std::string::npos);
  EXPECT_NE(complaint({{"approach", 0.2}}).find("approach = 0.2 m"), std::string::npos);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
