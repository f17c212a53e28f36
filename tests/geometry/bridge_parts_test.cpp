// The generator "bridge", part by part: rings, materials, walls, backing, supports, and what cannot be built.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "geometry/fill_mesh.h"
#include "geometry/generator.h"
#include "geometry/joints.h"
#include "geometry/rings.h"
#include "geometry/vault_shape.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "tests/folder.h"
#include "tests/geometry/bridges.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

TEST(BridgeGenerator, EachSpanHasItsOwnRingsAndKeystones) {
  GeneratorInput in = with_entries(2, 1);
  in.choices["span.1.shape"] = in.choices["span.2.shape"] = "segmental";
  in.values["span.1.rings"] = 3.0;
  const Assembly assembly = find_generator("bridge").build(in);
  std::size_t stones[2] = {0, 0};
  for (const Block& block : assembly.blocks)
    if (block.component == Component::arch) ++stones[block.part];
  EXPECT_NEAR(double(stones[0]), 3.0 * double(stones[1]), 0.1 * double(stones[0]));
  EXPECT_EQ(assembly.groups.at("keystone 0").size() % 3, 0u);
  EXPECT_EQ(assembly.groups.count("keystone 2"), 0u);
}

/// One segmental span on two solid abutments, filled, without parapets.
GeneratorInput plain_skew(double skew, const char* bond, double rings) {
  GeneratorInput in = with_entries(1, 1);
  in.values["skew"] = skew, in.values["width"] = 5.0, in.values["parapet_height"] = 0.0;
  in.values["block_scale"] = 1.5;
  in.choices["skew_bond"] = bond, in.choices["span.1.shape"] = "segmental";
  in.values["span.1.rise"] = 2.0, in.values["span.1.rings"] = rings;
  return in;
}

/// By Cavalieri: whatever is cut along the barrel is as long as the width over cos α, and the faces are the elevation
/// stretched by 1 / cos α.
TEST(BridgeGenerator, SkewBridgesHaveTheSurfaceOfTheirElevation) {
  for (const double skew : {-40.0, 10.0, 30.0}) {
    for (const char* bond : {"parallel", "helicoidal", "logarithmic"}) {
      const GeneratorInput in = plain_skew(skew, bond, 2.0);
      const Assembly assembly = find_generator("bridge").build(in);
      VaultShape shape;
      shape.shape = "segmental", shape.rise = 2.0, shape.right.x() = 8.0;
      shape.crown = shape.springing = {0.25, 0.25};
      shape.voussoirs = 2 * int(std::ceil(0.5 * intrados_length(shape) / 0.6 - 1e-9));
      const std::vector<Ring> rings = vault_rings(shape, "");
      double crown = 0.0, along = 0.0;
      for (const Vec3& p : rings.back().extrados) crown = std::max(crown, p.z());
      const Polygon& intrados = rings.front().intrados;
      for (std::size_t i = 0; i + 1 < intrados.size(); ++i) along += (intrados[i + 1] - intrados[i]).norm();
      const double deck = 4.0 + crown + 0.5, under = 5.0;  // above the abutments' feet, and the bases with them
      const double area = 16.0 * (deck + 1.0) - 8.0 * under - area_under(intrados, 0.0);
      const double outline = 16.0 + 2.0 * (deck + 1.0) + 8.0 + 2.0 * under + along;
      const double expected = (2.0 * area + 5.0 * outline) / std::cos(radians(skew));
      EXPECT_NEAR(uncovered_surface(assembly), expected, 1e-6 * expected) << skew << " " << bond;
    }
  }
}

TEST(BridgeGenerator, BedsOfSkewVaultsMeetTheFacesSquareAtTheCrown) {
  for (const char* bond : {"helicoidal", "logarithmic"}) {
    const GeneratorInput in = plain_skew(30.0, bond, 1.0);
    const Assembly assembly = find_generator("bridge").build(in);
    double beds = 0.0, square = 0.0;
    for (const Joint& joint : assembly.joints) {
      const Block &a = assembly.blocks[std::size_t(joint.a)], &b = assembly.blocks[std::size_t(joint.b)];
      if (a.component != Component::arch || b.component != Component::arch || std::abs(joint.normal.y()) > 0.99)
        continue;
      const double x =
          polygon_centroid(joint.polygon).x() - polygon_centroid(joint.polygon).y() * std::tan(radians(30.0));
      if (std::abs(x - 8.0 / std::cos(radians(30.0))) > 0.5) continue;  // the crown, at u = 8 m
      beds += joint.area;
      square += joint.area * std::abs(joint.normal.x());
    }
    ASSERT_GT(beds, 0.5) << bond;
    EXPECT_GT(square / beds, 0.98) << bond;  // of parallel beds: cos 30°
  }
}

TEST(BridgeGenerator, HeadersBindTheRings) {
  GeneratorInput in = plain_skew(0.0, "parallel", 2.0);
  const auto area_between_rings = [&](double every) {
    in.values["span.1.headers_every"] = every;
    const Assembly assembly = find_generator("bridge").build(in);
    const RingJoints between(assembly);
    double area = 0.0;
    for (const Joint& joint : assembly.joints) area += between(joint) ? joint.area : 0.0;
    return area;
  };
  const double none = area_between_rings(0.0), third = area_between_rings(3.0), all = area_between_rings(1.0);
  EXPECT_NEAR(third / none, 2.0 / 3.0, 0.05);
  EXPECT_EQ(all, 0.0);
}

TEST(BridgeGenerator, RingsWithoutBondHaveFrictionOnlyAndTheirOwnJoints) {
  GeneratorInput in = plain_skew(20.0, "helicoidal", 3.0);
  in.choices["ring_bond"] = "none";
  Assembly assembly = find_generator("bridge").build(in);
  EXPECT_EQ(RingJoints(assembly).vaults(), std::vector<std::int32_t>{0});
  for (const Joint& joint : assembly.joints) {
    if (!RingJoints(assembly)(joint)) continue;
    EXPECT_EQ(assembly.laws[std::size_t(joint.law)].tension, 0.0);
    break;
  }
  GeneratorInput::JointOverride own;
  own.kn = 1.2345e9, own.ks = 4e8;
  in.joints["ring-ring"] = own;
  assembly = find_generator("bridge").build(in);
  std::size_t ring = 0, other = 0;
  const RingJoints between(assembly);
  for (const Joint& joint : assembly.joints) {
    ring += between(joint);
    other += joint.kn == 1.2345e9;
    EXPECT_EQ(joint.kn == 1.2345e9, between(joint));
  }
  EXPECT_GT(ring, 100u);
  EXPECT_EQ(ring, other);
  in.values["span.1.rings"] = 1.0;
  EXPECT_NE(message_of<InputError>([&] { find_generator("bridge").build(in); }).find("no vault of this bridge"),
            std::string::npos);
}

TEST(BridgeGenerator, EveryRingMayHaveItsThickness) {
  GeneratorInput in = plain_skew(0.0, "parallel", 2.0);
  const Assembly equal = find_generator("bridge").build(in);
  in.profiles["span.1.ring_thicknesses"] = {{0.25, 0.0, 0.25}, {0.25, 0.0, 0.25}};
  const Assembly said = find_generator("bridge").build(in);
  ASSERT_EQ(said.blocks.size(), equal.blocks.size());
  ASSERT_EQ(said.joints.size(), equal.joints.size());
  for (std::size_t i = 0; i < said.blocks.size(); ++i) ASSERT_EQ(said.blocks[i].mass, equal.blocks[i].mass) << i;
  for (std::size_t i = 0; i < said.joints.size(); ++i) ASSERT_EQ(said.joints[i].kn, equal.joints[i].kn) << i;

  VaultShape shape;
  shape.shape = "segmental", shape.rise = 2.0, shape.right.x() = 8.0;
  shape.crown = {0.2, 0.35, 0.15}, shape.springing = {0.3, 0.35, 0.25};
  shape.voussoirs = 2 * int(std::ceil(0.5 * intrados_length(shape) / 0.6 - 1e-9));
  in.profiles["span.1.ring_thicknesses"] = {{0.2, 0.0, 0.3}, {0.35, 0.0, 0.35}, {0.15, 0.0, 0.25}};
  const Assembly unequal = find_generator("bridge").build(in);
  EXPECT_TRUE(find_overlaps(unequal, 1e-7).empty());
  const std::vector<Ring> rings = vault_rings(shape, "");
  for (std::size_t k = 0; k < 3; ++k) {
    double expected = 0.0, volume = 0.0;
    for (int wedge = 0; wedge < rings[k].wedges(); ++wedge) expected += 5.0 * polygon_area(rings[k].wedge(wedge));
    for (const std::int64_t block : unequal.groups.at(ring_group(0, k)))
      volume += mass_properties(unequal.blocks[std::size_t(block)].cells).volume;
    EXPECT_NEAR(volume, expected, 1e-9 * expected) << k;
  }
  // The interface to the fill is a share of the highest ring's modulus over the mean size of its stones.
  const double size = (intrados_length(shape) / shape.voussoirs + 0.6 * 1.5 + 0.15) / 3.0;
  std::size_t interfaces = 0;
  for (const Joint& joint : unequal.joints) {
    const Component a = unequal.blocks[std::size_t(joint.a)].component,
                    b = unequal.blocks[std::size_t(joint.b)].component;
    if (a != Component::arch || b != Component::backfill) continue;
    ++interfaces;
    ASSERT_NEAR(joint.kn, 0.2 * 1.5 * 4.0e9 / size, 1e-9 * joint.kn);
  }
  EXPECT_GT(interfaces, 10u);
  in.profiles["span.1.ring_thicknesses"][1].z() = 0.001;
  EXPECT_NE(message_of<InputError>([&] {
              find_generator("bridge").build(in);
            }).find("[[bridge.span]] number 1: ring_thicknesses has 0.001 m in ring 2"),
            std::string::npos);
}

TEST(BridgeGenerator, SpansAndSupportsMayHaveMaterialsOfTheirOwn) {
  GeneratorInput in = with_entries(2, 1);
  in.values["block_scale"] = 2.0, in.values["pier.1.cutwater_height"] = 2.0;
  in.choices["pier.1.cutwater"] = "round";
  const Assembly plain = find_generator("bridge").build(in);
  in.materials["tuff"] = {"tuff", 1400.0, 2.0e9, 0.8e9, 0.1e6, 0.1e6, radians(25.0)};
  in.materials["granite"] = {"granite", 2600.0, 9.0e9, 3.6e9, 0.2e6, 0.3e6, radians(35.0)};
  in.choices["span.2.material"] = in.choices["pier.1.material"] = "granite";
  in.choices["abutment.left.material"] = "tuff", in.choices["abutment.right.material"] = "vault";
  const Assembly own = find_generator("bridge").build(in);
  std::vector<std::string> names;
  for (const Material& m : own.materials) names.push_back(m.name);
  EXPECT_EQ(names, (std::vector<std::string>{"masonry", "vault", "infill", "backfill", "granite", "tuff"}));
  ASSERT_EQ(own.blocks.size(), plain.blocks.size());
  for (std::size_t i = 0; i < own.blocks.size(); ++i) {
    const Block& block = own.blocks[i];
    const bool granite = block.component == Component::pier || (block.component == Component::arch && block.part == 1);
    const std::string was = plain.materials[std::size_t(plain.blocks[i].material)].name;
    const std::string expected = granite                                  ? "granite"
                                 : block.component != Component::abutment ? was
                                 : block.part == 0                        ? "tuff"
                                                                          : "vault";
    ASSERT_EQ(names[std::size_t(block.material)], expected) << i;
  }
  ASSERT_EQ(own.joints.size(), plain.joints.size());
  std::size_t shares = 0, within = 0;
  for (std::size_t i = 0; i < own.joints.size(); ++i) {
    const Joint& joint = own.joints[i];
    const Block &a = own.blocks[std::size_t(joint.a)], &b = own.blocks[std::size_t(joint.b)];
    const bool vaults[] = {a.component == Component::arch && a.part == 1,
                           b.component == Component::arch && b.part == 1};
    const double ratio = joint.kn / plain.joints[i].kn;
    if (vaults[0] && (vaults[1] || b.component == Component::backfill)) {
      (vaults[1] ? within : shares) += 1;
      ASSERT_NEAR(ratio, 9.0 / 4.0, 1e-9);
      const double cohesion = own.laws[std::size_t(joint.law)].cohesion;
      ASSERT_EQ(cohesion, vaults[1] ? 0.3e6 : 0.0);
    }
  }
  EXPECT_GT(within, 20u);
  EXPECT_GT(shares, 5u);
  in.choices["span.1.material"] = "granit";
  const std::string text = message_of<InputError>([&] { find_generator("bridge").build(in); });
  EXPECT_NE(text.find("span.1.material = \"granit\""), std::string::npos) << text;
  EXPECT_NE(text.find("backfill, granite, infill"), std::string::npos) << text;
}

/// Area, and first moment about z = 0, of what lies above the supports' tops and the extrados and below the deck.
struct Section {
  double area = 0.0, moment = 0.0;
};
Section above_the_vault(const Assembly& assembly) {
  VaultShape shape;
  shape.shape = "segmental", shape.rise = 2.0, shape.left = {4.0, 0.0, 4.0}, shape.right = {12.0, 0.0, 4.0};
  shape.crown = shape.springing = {0.5};
  shape.voussoirs = 2 * int(std::ceil(0.5 * intrados_length(shape) / 0.6 - 1e-9));
  Polygon outline = vault_rings(shape, "").front().extrados;
  double deck = 0.0;
  for (const Vec3& p : outline) deck = std::max(deck, p.z() + 0.5);
  outline.insert(outline.begin(), {0.0, 0.0, outline.front().z()});
  outline.emplace_back(16.0, 0.0, outline.back().z());
  outline.emplace_back(16.0, 0.0, deck);
  outline.emplace_back(0.0, 0.0, deck);
  Section s;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 &p = outline[i], &q = outline[(i + 1) % outline.size()];
    const double cross = p.x() * q.z() - q.x() * p.z();
    s.area += 0.5 * cross, s.moment += cross * (p.z() + q.z()) / 6.0;
  }
  double top = 0.0;
  for (const Block& block : assembly.blocks) top = std::max(top, block_box(block).high.z());
  EXPECT_NEAR(top, deck, 1e-9);
  return s;
}

double volume_of(const Assembly& assembly, Component component) {
  double volume = 0.0;
  for (const Block& block : assembly.blocks)
    if (block.component == component) volume += mass_properties(block.cells).volume;
  return volume;
}

/// The wall's volume is the integral of its thickness, which is linear in z, over the section.
TEST(BridgeGenerator, TaperedSpandrelWallsHaveAPlaneBack) {
  const double bottom = 0.9, top = 0.4;
  for (const double skew : {0.0, 25.0}) {
    for (const char* backfill : {"rigid", "deformable"}) {
      SCOPED_TRACE(std::to_string(skew) + " " + backfill);
      GeneratorInput in = plain_skew(skew, "helicoidal", 1.0);
      in.choices["backfill"] = backfill, in.values["fill_edge"] = 0.8;
      const Assembly straight = find_generator("bridge").build(in);
      in.choices["spandrel_back"] = "tapered";
      in.values["spandrel_thickness_bottom"] = bottom, in.values["spandrel_thickness_top"] = top;
      const Assembly tapered = find_generator("bridge").build(in);
      EXPECT_TRUE(find_overlaps(tapered, 1e-7).empty());
      const Section s = above_the_vault(tapered);
      double deck = 0.0;
      for (const Block& block : tapered.blocks) deck = std::max(deck, block_box(block).high.z());
      const double slope = (top - bottom) / (deck - 4.0), stretch = 1.0 / std::cos(radians(skew));
      const double walls = 2.0 * (s.area * (bottom - 4.0 * slope) + s.moment * slope) * stretch;
      EXPECT_NEAR(volume_of(tapered, Component::spandrel), walls, 1e-9 * walls);
      const double inside = 5.0 * s.area * stretch - walls - volume_of(tapered, Component::backing);
      EXPECT_NEAR(find_generator("bridge").fill_space(in), inside, 1e-9 * inside);
      const bool rigid = backfill == std::string("rigid");
      EXPECT_NEAR(rigid ? volume_of(tapered, Component::backfill) : fill_volume(tapered.fill), inside, 1e-9 * inside);
      EXPECT_NEAR(free_surface(tapered), free_surface(straight), 1e-6 * free_surface(straight));
      const double longest = rigid || skew != 0.0 ? 0.0 : fill_quality(tapered.fill).longest_edge;
      EXPECT_LE(longest, 0.8 + 1e-9);
    }
  }
  GeneratorInput in = plain_skew(0.0, "parallel", 1.0);
  in.choices["abutment.left.makeup"] = "leaf", in.values["abutment.left.built_length"] = 2.0;  // with wing walls
  in.values["spandrel_thickness_bottom"] = 0.8;
  const double straight = free_surface(find_generator("bridge").build(in));
  in.choices["spandrel_back"] = "tapered";
  const Assembly winged = find_generator("bridge").build(in);
  EXPECT_TRUE(find_overlaps(winged, 1e-7).empty());
  EXPECT_NEAR(free_surface(winged), straight, 1e-6 * straight);
  in.choices["backfill"] = "deformable";
  std::string text = message_of<InputError>([&] { find_generator("bridge").build(in); });
  EXPECT_NE(text.find("[bridge.abutment.left] has built_length = 2 m"), std::string::npos) << text;
  in.choices["internal.between"] = "void", in.values["internal.walls"] = 2.0;
  text = message_of<InputError>([&] { find_generator("bridge").build(in); });
  EXPECT_NE(text.find("spandrel_back = \"tapered\""), std::string::npos) << text;
  EXPECT_NE(text.find("between = \"void\""), std::string::npos) << text;
}

TEST(BridgeGenerator, ASurfacingHasItsDepthOverTheWholeFill) {
  const auto surfacing_mass = [](const Assembly& assembly) {
    double mass = 0.0;
    for (const Block& block : assembly.blocks)
      if (assembly.materials[std::size_t(block.material)].name == "surfacing" && !block.fixed) mass += block.mass;
    const FillMesh& fill = assembly.fill;
    for (std::size_t t = 0; t < fill.tets.size(); ++t) {
      const Material& m = assembly.materials[std::size_t(fill.material[t])];
      const auto x = [&](std::size_t k) -> const Vec3& { return fill.nodes[std::size_t(fill.tets[t][k])]; };
      if (m.name == "surfacing") mass += m.density * (x(1) - x(0)).dot((x(2) - x(0)).cross(x(3) - x(0))) / 6.0;
    }
    return mass;
  };
  for (const char* backfill : {"rigid", "deformable"}) {
    for (const double gradient : {0.0, 3.0}) {
      const bool rigid = backfill == std::string("rigid");
      if (!rigid && gradient != 0.0) continue;
      SCOPED_TRACE(std::string(backfill) + " " + std::to_string(gradient));
      GeneratorInput in = plain_skew(20.0, "parallel", 1.0);
      in.choices["backfill"] = backfill, in.values["fill_edge"] = 0.8, in.values["gradient"] = gradient;
      const Assembly without = find_generator("bridge").build(in);
      for (const Material& m : without.materials) EXPECT_NE(m.name, "surfacing");
      in.values["surfacing_depth"] = 0.3;
      const Assembly assembly = find_generator("bridge").build(in);
      const double mass = 2200.0 * 0.3 * (5.0 - 2.0 * 0.6) * 16.0 / std::cos(radians(20.0));
      EXPECT_NEAR(surfacing_mass(assembly), mass, 1e-9 * mass);
      EXPECT_TRUE(find_overlaps(assembly, 1e-7).empty());
      EXPECT_NEAR(free_surface(assembly), free_surface(without), 1e-6 * free_surface(without));
      const double all = find_generator("bridge").fill_space(in);
      EXPECT_NEAR(rigid ? volume_of(assembly, Component::backfill) : fill_volume(assembly.fill), all, 1e-9 * all);
      if (rigid) continue;
      for (std::size_t t = 0; t < assembly.fill.tets.size(); ++t)  // no tetrahedron reaches across the boundary
        for (const std::int32_t node : assembly.fill.tets[t]) {
          const double depth = 4.0 + 2.0 + 0.5 + 0.5 - assembly.fill.nodes[std::size_t(node)].z();
          const bool surfacing = assembly.materials[std::size_t(assembly.fill.material[t])].name == "surfacing";
          ASSERT_TRUE(surfacing ? depth <= 0.3 + 1e-9 : depth >= 0.3 - 1e-9) << depth;
        }
    }
  }
  GeneratorInput in = plain_skew(0.0, "parallel", 1.0);
  in.choices["backfill"] = "deformable", in.values["gradient"] = 2.0, in.values["surfacing_depth"] = 0.2;
  const std::string text = message_of<InputError>([&] { find_generator("bridge").build(in); });
  EXPECT_NE(text.find("surfacing_depth = 0.2 m"), std::string::npos) << text;
  EXPECT_NE(text.find("gradient = 2 %"), std::string::npos) << text;
}

TEST(BridgeGenerator, ABackingHasTheVolumeUnderItsLine) {
  GeneratorInput in = plain_skew(15.0, "parallel", 1.0);
  Polygon& line = in.profiles["backing.profile"];
  line = {{0.0, 0.0, 2.6}, {4.0, 0.0, 1.0}, {9.0, 0.0, 2.0}, {16.0, 0.0, 0.7}};
  double surface[2] = {0.0, 0.0}, volume[2] = {0.0, 0.0};
  for (const double raised : {0.0, 0.2}) {
    for (Vec3& p : line) p.z() += raised;
    const Assembly assembly = find_generator("bridge").build(in);
    EXPECT_TRUE(find_overlaps(assembly, 1e-7).empty());
    for (const Block& block : assembly.blocks) {
      const double v = mass_properties(block.cells).volume;
      volume[0] += block.component == Component::backing ? (raised > 0.0 ? v : -v) : 0.0;
      volume[1] += block.component == Component::backfill ? (raised > 0.0 ? v : -v) : 0.0;
    }
    surface[raised > 0.0] = uncovered_surface(assembly);
  }
  EXPECT_NEAR(volume[0], -volume[1], 1e-9);  // what one wins the other loses
  EXPECT_GT(volume[0], 0.2 * 8.0 * 3.8);
  EXPECT_NEAR(surface[0], surface[1], 1e-6 * surface[0]);  // nothing is left open between backing and fill
  line[1].z() = 0.1;
  EXPECT_NE(message_of<InputError>([&] { find_generator("bridge").build(in); }).find("[bridge.backing] profile"),
            std::string::npos);
}

/// Under slabs lacks what the space up to them is, less its walls; with fill between the walls nothing.
TEST(BridgeGenerator, InternalWallsStandInVoidsOrInTheFill) {
  GeneratorInput in = plain_skew(-20.0, "helicoidal", 1.0);
  in.values["fill_over_crown"] = 1.2;
  const Generator& generator = find_generator("bridge");
  const auto volume = [&](const GeneratorInput& of) {
    const Assembly assembly = generator.build(of);
    EXPECT_TRUE(find_overlaps(assembly, 1e-7).empty());
    return moving_volume(assembly);
  };
  const double filled = volume(in);
  in.values["internal.walls"] = 2.0, in.values["internal.thickness"] = 0.3;
  EXPECT_NEAR(volume(in), filled, 1e-9 * filled);
  in.choices["internal.between"] = "void";
  in.values["internal.slab_thickness"] = 0.2, in.values["internal.fill_over_slabs"] = 0.5;
  const double hollow = volume(in);
  GeneratorInput below = plain_skew(-20.0, "helicoidal", 1.0);  // the fill up to the slabs
  below.values["fill_over_crown"] = 0.5;
  const double space = generator.fill_space(below), between = 5.0 - 2.0 * 0.6;
  EXPECT_NEAR(filled - hollow, space * (1.0 - 2.0 * 0.3 / between), 1e-9 * filled);
  in.values["internal.walls"] = 12.0, in.values["internal.thickness"] = 1.0;
  EXPECT_NE(message_of<InputError>([&] { generator.build(in); }).find("[bridge.internal] 12 walls of 1 m"),
            std::string::npos);
}

TEST(BridgeGenerator, AHollowPierLacksWhatItsLeafEncloses) {
  GeneratorInput in = with_entries(2, 1);
  in.values["pier.1.thickness"] = 2.4, in.values["pier.1.height"] = 6.4;
  const auto pier = [&](const char* makeup) {
    in.choices["pier.1.makeup"] = makeup;
    double volume = 0.0;
    for (const Block& block : find_generator("bridge").build(in).blocks)
      if (block.component == Component::pier) volume += mass_properties(block.cells).volume;
    return volume;
  };
  double enclosed = 0.0;  // eight courses of 0.8 m, the topmost of slabs
  for (int k = 0; k < 7; ++k) {
    const double t = k % 2 == 0 ? 0.3 : 0.5;
    enclosed += 0.8 * (2.4 - 2.0 * t) * (8.0 - 2.0 * t);
  }
  EXPECT_NEAR(pier("solid") - pier("hollow"), enclosed, 1e-9);
}

TEST(BridgeGenerator, WhatCannotBeNamesItsKeys) {
  const auto refused = [](GeneratorInput in) {
    return message_of<InputError>([&] { find_generator("bridge").build(in); });
  };
  GeneratorInput in = with_entries(2, 1);
  in.values["pier.1.thickness"] = 0.4;
  EXPECT_NE(refused(in).find("[[bridge.pier]] number 1: thickness = 0.4 m"), std::string::npos) << refused(in);
  in = with_entries(3, 1);
  in.values["pier.1.height"] = 50.0, in.values["pier.1.batter_x"] = 0.1;
  EXPECT_NE(refused(in).find("the feet of pier 0 and pier 1"), std::string::npos) << refused(in);
  in = with_entries(3, 3);
  EXPECT_NE(refused(in).find("is given 3 times for 3 spans"), std::string::npos) << refused(in);
  in = with_entries(1, 1);
  in.choices["span.1.shape"] = "surveyed";
  EXPECT_NE(refused(in).find("needs intrados"), std::string::npos) << refused(in);
  in.profiles["span.1.intrados"] = {{0, 0, 0}, {2, 0, 0}};
  EXPECT_NE(refused(in).find("has 2 points. It must have at least 3"), std::string::npos) << refused(in);
  in.profiles["span.1.intrados"] = {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}};
  in.values["span.1.rise"] = 1.0;
  EXPECT_NE(refused(in).find("follow from intrados"), std::string::npos) << refused(in);
  in.choices["span.1.shape"] = "elliptical";
  in.profiles["span.1.intrados"] = {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}};
  EXPECT_NE(refused(in).find("leave out intrados"), std::string::npos) << refused(in);
  in = with_entries(1, 1);
  in.choices["span.1.shape"] = "segmental";
  in.values["backing_height"] = 0.0;
  EXPECT_NE(refused(in).find("backing_height = 0 m is below"), std::string::npos) << refused(in);
  in = with_entries(1, 1);
  in.values["abutment.left.height"] = 0.1, in.values["span.1.springing_left"] = -0.3,
  in.values["abutment.right.height"] = 0.1;
  EXPECT_NE(refused(in).find("[bridge.abutment.left]: height = 0.1 m"), std::string::npos) << refused(in);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
