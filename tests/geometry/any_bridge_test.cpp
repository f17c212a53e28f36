// The generator "bridge": random bridges against volumes in closed form, and what cannot be built.
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

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Keys drawn from ranges in which most bridges can be built, in blocks of more than twice the size.
class Draw {
 public:
  explicit Draw(int seed) : random_(unsigned(seed)) {}
  double between(double low, double high) { return low + (high - low) * std::generate_canonical<double, 53>(random_); }
  int whole(int low, int high) { return low + int(random_() % unsigned(high - low + 1)); }

 private:
  std::mt19937_64 random_;
};

GeneratorInput with_entries(std::size_t spans, std::size_t piers) {
  const Generator& generator = find_generator("bridge");
  GeneratorInput in = default_input(generator);
  in.entries["span"] = spans, in.entries["pier"] = piers;
  const Keys keys = keys_of(generator, in);
  for (const Parameter& p : keys.parameters) in.values.try_emplace(p.name, p.value);
  for (const Choice& c : keys.choices) in.choices.try_emplace(c.name, c.words.front());
  return in;
}

/// Skew, gradient, headers, cutwaters, wings and walls.
void draw_details(GeneratorInput& in, Draw& draw, int spans) {
  auto& v = in.values;
  if (draw.whole(0, 1)) {
    v["skew"] = draw.between(-45.0, 45.0);
    in.choices["skew_bond"] = std::array{"parallel", "helicoidal", "logarithmic"}[std::size_t(draw.whole(0, 2))];
  }
  if (!draw.whole(0, 2)) v["gradient"] = draw.between(-4.0, 4.0);
  if (!draw.whole(0, 2)) v["string_course_height"] = 0.3, v["string_course_projection"] = draw.between(0.0, 0.2);
  if (!draw.whole(0, 3)) v["transverse_walls"] = draw.between(0.4, 0.8);
  if (!draw.whole(0, 3)) v["internal.walls"] = draw.whole(1, 3), v["internal.thickness"] = 0.3;
  in.choices["ring_bond"] = draw.whole(0, 1) ? "mortar" : "none";
  for (int i = 0; i < spans; ++i) v["span." + std::to_string(i + 1) + ".headers_every"] = draw.whole(0, 5);
  for (std::size_t i = 0; i < in.entries["pier"]; ++i) {
    const std::string key = "pier." + std::to_string(i + 1) + ".";
    if (!draw.whole(0, 2)) v[key + "width"] = v["width"] + draw.between(0.0, 1.0);
    if (draw.whole(0, 1)) continue;
    v[key + "batter_y"] = 0.0;
    in.choices[key + "cutwater"] = draw.whole(0, 1) ? "triangular" : "round";
    v[key + "cutwater_length"] = draw.between(0.3, 2.0), v[key + "cutwater_height"] = draw.between(0.5, 2.0);
  }
  if (in.choices["abutments"] == "restrained") return;
  for (const std::string key : {"abutment.left.", "abutment.right."}) {
    if (!draw.whole(0, 2))
      v[key + "wing_length"] = draw.between(1.0, 5.0), v[key + "wing_splay"] = draw.between(0.0, 60.0);
    if (!draw.whole(0, 2)) v[key + "counterforts"] = draw.whole(1, 2);
    v[key + "wing_height"] = draw.between(0.5, 2.0), v[key + "counterfort_height"] = draw.between(0.5, 1.0);
  }
}

/// Rings of a thickness each and materials of the case's own.
void draw_materials_and_rings(GeneratorInput& in, Draw& draw, int spans) {
  for (int i = 0; i < spans; ++i) {
    const std::string key = "span." + std::to_string(i + 1) + ".";
    if (draw.whole(0, 3)) continue;
    for (int ring = draw.whole(1, 3); ring > 0; --ring) {
      const double crown = draw.between(0.02, 0.05) * in(key + "clear_span");
      in.profiles[key + "ring_thicknesses"].emplace_back(crown, 0.0, draw.between(1.0, 1.5) * crown);
    }
  }
  if (!draw.whole(0, 2)) in.choices["spandrel_back"] = "tapered";
  if (!draw.whole(0, 2)) in.values["surfacing_depth"] = draw.between(0.05, 0.6);
  if (draw.whole(0, 2)) return;
  in.materials["granite"] = {"granite", 2600.0, 9.0e9, 3.6e9, 0.2e6, 0.3e6, radians(35.0)};
  for (auto& [key, word] : in.choices)
    if (key.ends_with(".material") && draw.whole(0, 1)) word = "granite";
}

GeneratorInput random_bridge(int seed) {
  Draw draw(seed);
  const int spans = draw.whole(1, 3);
  const bool one_pier = draw.whole(0, 1) || spans == 1;
  GeneratorInput in = with_entries(std::size_t(spans), one_pier ? 1 : std::size_t(spans) - 1);
  auto& v = in.values;
  v["block_scale"] = 2.5;
  v["width"] = draw.between(3.0, 9.0);
  v["fill_over_crown"] = draw.between(0.0, 1.5);
  v["backing_height"] = draw.between(0.5, 3.0);
  v["spandrel_thickness_bottom"] = draw.between(0.3, 0.9), v["spandrel_thickness_top"] = draw.between(0.35, 0.6);
  v["parapet_height"] = draw.whole(0, 1) * draw.between(0.5, 1.2);
  in.choices["backfill"] = draw.whole(0, 2) ? "rigid" : "none";
  in.choices["abutments"] = draw.whole(0, 3) ? "free" : "restrained";
  for (int i = 0; i < spans; ++i) {
    const std::string key = "span." + std::to_string(i + 1) + ".";
    const std::string shape = vault_shapes()[std::size_t(draw.whole(0, 6))];
    const double clear = draw.between(2.0, 14.0);
    in.choices[key + "shape"] = shape;
    v[key + "clear_span"] = clear;
    v[key + "rise"] = shape == "semicircular" ? 0.0
                      : shape == "pointed"    ? draw.between(0.51, 0.8) * clear
                                              : draw.between(0.16, 0.45) * clear;
    v[key + "ring_thickness"] = draw.between(0.04, 0.1) * clear;
    v[key + "springing_thickness"] = draw.whole(0, 1) ? draw.between(1.0, 1.5) * v[key + "ring_thickness"] : 0.0;
    v[key + "rings"] = draw.whole(1, 3);
    if (!draw.whole(0, 2)) v[key + "springing_left"] = draw.between(-0.5, 0.5);
    if (!draw.whole(0, 2)) v[key + "springing_right"] = draw.between(-0.5, 0.5);
    if (shape == "surveyed") {
      v[key + "rise"] = v[key + "springing_right"] = 0.0;
      Polygon& line = in.profiles[key + "intrados"];
      for (int k = 0; k <= 6; ++k) {
        const double x = k / 3.0 - 1.0;
        line.emplace_back(7.0 + 0.5 * clear * x, 0.0,
                          2.0 + 0.3 * clear * (1.0 - x * x) + 0.02 * draw.between(-1.0, 1.0));
      }
    }
  }
  for (std::size_t i = 0; i < in.entries["pier"]; ++i) {
    const std::string key = "pier." + std::to_string(i + 1) + ".";
    v[key + "height"] = draw.between(1.0, 12.0), v[key + "thickness"] = draw.between(0.8, 3.0);
    in.choices[key + "makeup"] = draw.whole(0, 2) ? "solid" : "leaf";
    if (in.choices[key + "makeup"] == "solid")
      v[key + "batter_x"] = draw.between(0.0, 0.05), v[key + "batter_y"] = draw.between(0.0, 0.05);
  }
  for (const std::string key : {"abutment.left.", "abutment.right."}) {
    v[key + "length"] = draw.between(1.5, 6.0), v[key + "height"] = draw.between(1.0, 8.0);
    v[key + "batter_y"] = draw.whole(0, 1) * draw.between(0.0, 0.05);
  }
  draw_details(in, draw, spans);
  draw_materials_and_rings(in, draw, spans);
  return in;
}

double area_under(const Polygon& line, double level) {
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    area += (line[i + 1].x() - line[i].x()) * (0.5 * (line[i].z() + line[i + 1].z()) - level);
  return area;
}

/// Σ of what stands above the lowest springing: the whole section but the openings, and the supports where they stand
/// there, all over the width; supports below their springings; parapets.
double expected_volume(const GeneratorInput& in) {
  const auto spans = in.entries.at("span");
  const auto pier = [&](std::size_t i) {
    return "pier." + std::to_string(in.entries.at("pier") == 1 ? 1 : i + 1) + ".";
  };
  const double width = in("width");
  struct Foot {
    double x0, x1, height, level, slope_x, slope_y, width;
  };
  std::vector<Foot> feet(spans + 1);
  const double gradient = 0.01 * in("gradient") / std::cos(radians(in("skew")));
  double x = in("abutment.left.length"), openings = 0.0, floor = 1e300, crown = -1e300, level = 0.0;
  std::vector<VaultShape> shapes;
  for (std::size_t i = 0; i < spans; ++i) {
    const std::string key = "span." + std::to_string(i + 1) + ".";
    VaultShape s;
    s.shape = in.choices.at(key + "shape");
    s.left = {x, 0.0, in(key + "springing_left")},
    s.right = {x + in(key + "clear_span"), 0.0, in(key + "springing_right")};
    s.rise = in(key + "rise") > 0.0 ? in(key + "rise") : 0.5 * s.span();
    if (s.shape == "surveyed") {
      const Polygon& line = in.profiles.at(key + "intrados");
      for (const Vec3& p : line) s.surveyed.push_back(s.left + p - line.front());
      s.right = s.surveyed.back();
    }
    const double rings = in(key + "rings"), thickness = in(key + "ring_thickness"),
                 own = in(key + "springing_thickness");
    s.crown.assign(std::size_t(rings), thickness / rings),
        s.springing.assign(std::size_t(rings), (own > 0.0 ? own : thickness) / rings);
    if (const auto each = in.profiles.find(key + "ring_thicknesses"); each != in.profiles.end()) {
      s.crown.clear(), s.springing.clear();
      for (const Vec3& pair : each->second) s.crown.push_back(pair.x()), s.springing.push_back(pair.z());
    }
    s.voussoirs =
        2 * std::max(2, int(std::ceil(0.5 * intrados_length(s) / (in("voussoir_length") * in("block_scale")) - 1e-9)));
    floor = std::min({floor, s.left.z(), s.right.z()});
    shapes.push_back(s);
    x = s.right.x() + (i + 1 < spans ? in(pier(i) + "thickness") : 0.0);
  }
  for (std::size_t i = 0; i < spans; ++i) {
    const std::vector<Ring> rings = vault_rings(shapes[i], "");
    openings += area_under(rings.front().intrados, floor);
    for (const Vec3& p : rings.back().extrados) crown = std::max(crown, p.z() - gradient * p.x());
  }
  for (std::size_t i = 0; i <= spans; ++i) {
    Foot& f = feet[i];
    const std::string key = i == 0 ? "abutment.left." : i == spans ? "abutment.right." : pier(i - 1);
    f.x0 = i == 0 ? 0.0 : shapes[i - 1].right.x();
    f.x1 = i < spans ? shapes[i].left.x() : f.x0 + in("abutment.right.length");
    f.level = std::min(i > 0 ? shapes[i - 1].right.z() : 1e300, i < spans ? shapes[i].left.z() : 1e300);
    f.height = in(key + "height");
    f.slope_x = i == 0 || i == spans ? 0.0 : in(key + "batter_x"), f.slope_y = in(key + "batter_y");
    level = std::max(level, f.height);
    f.width = in(key + "width") > 0.0 ? in(key + "width") : width;
  }
  const double length = feet.back().x1;
  const double deck = crown + in("fill_over_crown") + 0.5 * gradient * length;  // in the mean
  double volume =
      width * (length * (deck - floor) - openings) + 2.0 * in("parapet_height") * in("parapet_thickness") * length;
  for (const Foot& f : feet) {
    const double h = f.level + f.height, a = f.x1 - f.x0;  // springings are given above the level the heights reach to
    const double sx = 2.0 * f.slope_x, sy = 2.0 * f.slope_y;
    volume += a * f.width * h + 0.5 * (a * sy + f.width * sx) * h * h + sx * sy * h * h * h / 3.0;
    volume -= a * width * (f.level - floor);
  }
  if (in("string_course_height") > 0.0)
    volume += 2.0 * in("string_course_height") * (in("parapet_thickness") + in("string_course_projection")) * length;
  for (std::size_t i = 1; i < spans; ++i) {  // half an ellipse in eight facets, or a triangle
    const std::string key = pier(i - 1), &shape = in.choices.at(key + "cutwater");
    const double area = 0.5 * (feet[i].x1 - feet[i].x0) * in(key + "cutwater_length") *
                        (shape == "none"    ? 0.0
                         : shape == "round" ? 8.0 * std::sin(pi / 8.0)
                                            : 2.0);
    volume += area * in(key + "cutwater_height");
  }
  for (const std::string key : {"abutment.left.", "abutment.right."}) {
    volume += 2.0 * in(key + "wing_length") * in(key + "wing_thickness") * in(key + "wing_height");
    volume += in(key + "counterforts") * in(key + "counterfort_length") * in(key + "counterfort_thickness") *
              in(key + "counterfort_height");
  }
  return volume / std::cos(radians(in("skew")));
}

double moving_volume(const Assembly& assembly) {
  double sum = 0.0;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) sum += mass_properties(block.cells).volume;
  return sum;
}

double free_surface(const Assembly& assembly) {
  double free = uncovered_surface(assembly);
  for (std::size_t t = 0; t < assembly.fill.triangles.size(); ++t)
    free += polygon_area(triangle_polygon(assembly.fill, std::int32_t(t)));
  for (const FillJoint& joint : assembly.fill_joints) free -= joint.area;
  return free;
}

TEST(BridgeGenerator, RandomBridgesHaveTheirVolumesOrAreRefusedByName) {
  const Generator& generator = find_generator("bridge");
  int built = 0, refused = 0;
  for (int seed = 1; seed <= 500; ++seed) {
    const GeneratorInput in = random_bridge(seed);
    try {
      const Assembly assembly = generator.build(in);
      ++built;
      EXPECT_TRUE(find_overlaps(assembly, 1e-7).empty()) << "seed " << seed;
      double missing = 0.0;  // of a bridge without fill: what the fill would take
      if (in.choices.at("backfill") == "none") missing = generator.fill_space(in);
      const double expected = expected_volume(in);
      EXPECT_NEAR(moving_volume(assembly) + missing, expected, 1e-9 * expected) << "seed " << seed;
      for (const char* group : {"keystone 0", "base abutment left", "spandrel y- abutment right"})
        EXPECT_TRUE(assembly.groups.contains(group)) << group;
    } catch (const InputError& error) {
      ++refused;
      const std::string text = error.what();
      EXPECT_TRUE(text.find("[bridge]") != std::string::npos || text.find("[[bridge.") != std::string::npos ||
                  text.find("[bridge.") != std::string::npos)
          << "seed " << seed << ": " << text;
    }
  }
  EXPECT_GT(built, 350) << refused;
}

/// The mesh fills the space that the keys say, and nothing between it and the stones is left open.
TEST(BridgeGenerator, RandomBridgesAreFilledWithTetrahedra) {
  const Generator& generator = find_generator("bridge");
  int built = 0;
  for (int seed = 1; seed <= 40; ++seed) {
    GeneratorInput in = random_bridge(seed);
    const auto surface = [&](const char* backfill) {
      in.choices["backfill"] = backfill, in.values["fill_edge"] = 1.5;
      const Assembly assembly = generator.build(in);
      const double volume = fill_volume(assembly.fill), space = generator.fill_space(in);
      EXPECT_NEAR(volume, assembly.fill.empty() ? 0.0 : space, 1e-9 * space) << "seed " << seed;
      return free_surface(assembly);
    };
    try {
      const double filled = surface("deformable");
      ++built;
      EXPECT_NEAR(filled, surface("rigid"), 1e-6 * filled) << "seed " << seed;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("[bridge"), std::string::npos)
          << "seed " << seed << ": " << error.what();
    }
  }
  EXPECT_GT(built, 15);
}

/// All of each key's range, in blocks as large as there are: most cannot be built, and say why.
TEST(BridgeGenerator, TheWholeKeySpaceIsBuiltOrRefusedByName) {
  const Generator& generator = find_generator("bridge");
  int built = 0;
  for (int seed = 1; seed <= 1500; ++seed) {
    Draw draw(1000 + seed);
    GeneratorInput in = with_entries(std::size_t(draw.whole(1, 3)), std::size_t(draw.whole(1, 2)));
    const Keys keys = keys_of(generator, in);
    for (const Parameter& p : keys.parameters) {
      if (draw.whole(0, 23)) continue;  // 23 of 24 keep their default
      double& value = in.values.at(p.name);
      value = draw.between(p.low, p.high);
      if (p.integer) value = std::floor(value);
    }
    for (const Choice& c : keys.choices)
      in.choices.at(c.name) = c.words[std::size_t(draw.whole(0, int(c.words.size()) - 1))];
    in.choices.at("backfill") = draw.whole(0, 1) ? "rigid" : "none";
    in.choices.at("extent") = draw.whole(0, 3) ? "whole" : "strip";  // most draws are too crooked for a strip
    in.values["block_scale"] = 6.0;
    for (const char* key :
         {"block_length", "block_width", "block_height", "fill_length", "fill_width", "fill_height", "infill_length",
          "infill_width", "leaf_length", "leaf_course_height", "voussoir_width", "voussoir_length"})
      in.values[key] = 1.0;
    try {
      const Assembly assembly = generator.build(in);
      ++built;
      EXPECT_TRUE(find_overlaps(assembly, 1e-6).empty()) << "seed " << seed;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("[bridge"), std::string::npos)
          << "seed " << seed << ": " << error.what();
    }
  }
  EXPECT_GT(built, 100);
}

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
  EXPECT_NE(refused(in).find("is there 3 times for 3 spans"), std::string::npos) << refused(in);
  in = with_entries(1, 1);
  in.choices["span.1.shape"] = "surveyed";
  EXPECT_NE(refused(in).find("needs intrados"), std::string::npos) << refused(in);
  in.profiles["span.1.intrados"] = {{0, 0, 0}, {2, 0, 0}};
  EXPECT_NE(refused(in).find("has 2 points, expected at least 3"), std::string::npos) << refused(in);
  in.profiles["span.1.intrados"] = {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}};
  in.values["span.1.rise"] = 1.0;
  EXPECT_NE(refused(in).find("follow from intrados"), std::string::npos) << refused(in);
  in.choices["span.1.shape"] = "elliptical";
  in.profiles["span.1.intrados"] = {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}};
  EXPECT_NE(refused(in).find("leave out intrados"), std::string::npos) << refused(in);
  in = with_entries(1, 1);
  in.choices["span.1.shape"] = "segmental";
  in.values["backing_height"] = 0.0;
  EXPECT_NE(refused(in).find("backing_height = 0 m ends below"), std::string::npos) << refused(in);
  in = with_entries(1, 1);
  in.values["abutment.left.height"] = 0.1, in.values["span.1.springing_left"] = -0.3,
  in.values["abutment.right.height"] = 0.1;
  EXPECT_NE(refused(in).find("[bridge.abutment.left]: height = 0.1 m"), std::string::npos) << refused(in);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
