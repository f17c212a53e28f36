// The generator "bridge": random bridges against volumes in closed form.
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

/// Keys drawn from ranges in which most bridges can be built, in blocks of more than twice the size.
class Draw {
 public:
  explicit Draw(int seed) : random_(unsigned(seed)) {}
  double between(double low, double high) { return low + (high - low) * std::generate_canonical<double, 53>(random_); }
  int whole(int low, int high) { return low + int(random_() % unsigned(high - low + 1)); }

 private:
  std::mt19937_64 random_;
};

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

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
