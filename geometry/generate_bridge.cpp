// bridge: any number of spans of any shape on abutments and piers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/generate.h"
#include "geometry/masonry_build.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr std::size_t most_spans = 60;

std::string span_prefix(std::size_t i) {
  return fmt::format("span.{}.", i + 1);
}

std::string span_heading(std::size_t i) {
  return fmt::format("[[bridge.span]] number {}", i + 1);
}

/// Keys of a pier; one entry holds for all.
std::string pier_prefix(const GeneratorInput& in, std::size_t pier) {
  const std::size_t entries = in.entries.at("pier");
  return fmt::format("pier.{}.", entries == 1 ? 1 : pier + 1);
}

double span_length(const GeneratorInput& in, std::size_t i) {
  const auto line = in.profiles.find(span_prefix(i) + "intrados");
  return line == in.profiles.end() ? in(span_prefix(i) + "clear_span")
                                   : line->second.back().x() - line->second.front().x();
}

/// The shape of a vault whose left springing is at x (m), of springings about z (m).
VaultShape read_shape(const GeneratorInput& in, std::size_t i, double x, double z) {
  const std::string key = span_prefix(i);
  VaultShape v;
  v.shape = in.choices.at(key + "shape");
  const auto line = in.profiles.find(key + "intrados");
  const bool given = line != in.profiles.end();
  if (given && v.shape != "surveyed")
    throw InputError("{}: intrados is given, and shape = \"{}\": give shape = \"surveyed\", or leave out intrados",
                     span_heading(i), v.shape);
  if (!given && v.shape == "surveyed")
    throw InputError("{}: shape = \"surveyed\" needs intrados = [[x, z], …], from springing to springing",
                     span_heading(i));
  if (given && line->second.size() < 3)
    throw InputError("{}: intrados has {} points, expected at least 3, from springing to springing", span_heading(i),
                     line->second.size());
  if (given && (in(key + "rise") != 0.0 || in(key + "springing_right") != 0.0))
    throw InputError("{}: rise = {:g} m and springing_right = {:g} m follow from intrados: leave them out",
                     span_heading(i), in(key + "rise"), in(key + "springing_right"));
  v.left = {x, 0.0, z + in(key + "springing_left")};
  v.right = {x + span_length(in, i), 0.0, z + in(key + "springing_right")};
  if (given) {
    for (const Vec3& p : line->second) v.surveyed.push_back(v.left + (p - line->second.front()));
    v.right = v.surveyed.back();
    for (const Vec3& p : v.surveyed) v.rise = std::max(v.rise, p.z() - std::max(v.left.z(), v.right.z()));
  } else {
    const double half = 0.5 * v.span();
    const double usual = v.shape == "semicircular" ? half : v.shape == "pointed" ? 1.2 * half : 0.5 * half;
    v.rise = in(key + "rise") > 0.0 ? in(key + "rise") : usual;
  }
  const double crown = in(key + "ring_thickness"), own = in(key + "springing_thickness");
  const auto rings = std::size_t(in(key + "rings"));
  v.crown.assign(rings, crown / double(rings));
  v.springing.assign(rings, (own > 0.0 ? own : crown) / double(rings));
  v.voussoirs = int(in(key + "voussoirs"));
  if (v.voussoirs == 0)  // an even number, so that the crown is a joint
    v.voussoirs =
        2 * std::max(2, int(std::ceil(0.5 * intrados_length(v) / (in("voussoir_length") * in("block_scale")) - 1e-9)));
  return v;
}

Vault make_vault(const GeneratorInput& in, std::size_t i, const VaultShape& shape) {
  return {vault_rings(shape, span_heading(i)),
          {intrados_length(shape) / shape.voussoirs, in("voussoir_width") * in("block_scale"), shape.crown.front()}};
}

double support_height(const GeneratorInput& in, std::size_t support, std::size_t spans) {
  if (support == 0) return in("abutment.left.height");
  if (support == spans) return in("abutment.right.height");
  return in(pier_prefix(in, support - 1) + "height");
}

/// To which the heights of piers and abutments reach, above the lowest base, m.
double springing_level(const GeneratorInput& in, std::size_t spans) {
  double level = 0.0;
  for (std::size_t i = 0; i <= spans; ++i) level = std::max(level, support_height(in, i, spans));
  return level;
}

std::string support_key(std::size_t support, std::size_t spans) {
  if (support == 0) return "[bridge.abutment.left]";
  if (support == spans) return "[bridge.abutment.right]";
  return fmt::format("[[bridge.pier]] number {}", support);
}

void read_spans(Bridge& bridge, const GeneratorInput& in) {
  const std::size_t spans = in.entries.at("span");
  const double level = springing_level(in, spans);
  double x = in("abutment.left.length");
  double crown = 0.0;
  bridge.springing = 1e300;
  for (std::size_t i = 0; i < spans; ++i) {
    const VaultShape shape = read_shape(in, i, x, level);
    bridge.vaults.push_back(make_vault(in, i, shape));
    bridge.springing = std::min({bridge.springing, shape.left.z(), shape.right.z()});
    for (const Vec3& p : bridge.vaults.back().rings.back().extrados) crown = std::max(crown, p.z());
    x = shape.right.x() + (i + 1 < spans ? in(pier_prefix(in, i) + "thickness") : 0.0);
  }
  bridge.deck = crown + in("fill_over_crown");
  bridge.backing_top = bridge.springing + in("backing_height");
}

/// What an abutment or a pier says beside its height.
void read_makeup(Support& support, const GeneratorInput& in, const std::string& prefix, const std::string& heading,
                 bool pier) {
  support.leaf = in.choices.at(prefix + "makeup") == "leaf";
  support.slope_x = pier ? in(prefix + "batter_x") : 0.0;
  support.slope_y = in(prefix + "batter_y");
  if (support.leaf && (support.slope_x > 0.0 || support.slope_y > 0.0))
    throw InputError("{}: makeup = \"leaf\" has upright faces: set its batter to 0, or makeup = \"solid\"", heading);
}

void read_supports(Bridge& bridge, const GeneratorInput& in) {
  const std::size_t spans = bridge.vaults.size();
  const double level = springing_level(in, spans);
  for (std::size_t i = 0; i <= spans; ++i) {
    const std::string heading = support_key(i, spans);
    Support support;
    const Vault* before = i > 0 ? &bridge.vaults[i - 1] : nullptr;
    const Vault* after = i < spans ? &bridge.vaults[i] : nullptr;
    support.x0 = before ? before->right() : 0.0;
    support.x1 = after ? after->left() : support.x0 + in("abutment.right.length");
    support.base = level - support_height(in, i, spans);
    support.springing = 1e300, support.top = -1e300;
    const auto stands = [&](const Vec3& in_end, const Vec3& out_end) {
      support.springing = std::min(support.springing, in_end.z());
      support.top = std::max({support.top, in_end.z(), out_end.z()});
    };
    if (before) stands(before->rings.front().intrados.back(), before->rings.back().extrados.back());
    if (after) stands(after->rings.front().intrados.front(), after->rings.back().extrados.front());
    support.height = support.springing - support.base;
    if (support.height < 0.05)
      throw InputError("{}: height = {:g} m leaves {:g} m below the springing there: make it higher", heading,
                       support_height(in, i, spans), support.height);
    const std::string prefix = i == 0 ? "abutment.left." : i == spans ? "abutment.right." : pier_prefix(in, i - 1);
    read_makeup(support, in, prefix, heading, before && after);
    support.leaf_beside_span = support.x1 - support.x0;
    const double left = before ? before->rings.back().extrados.back().x() : support.x0 + 0.05,
                 right = after ? after->rings.back().extrados.front().x() : support.x1 - 0.05;
    if (right < left - 1e-9)
      throw InputError("{}: {} = {:g} m is too little for the feet of the vaults on it: at least {:g} m", heading,
                       before && after ? "thickness" : "length", support.x1 - support.x0,
                       support.x1 - support.x0 + left - right);
    bridge.supports.push_back(support);
  }
}

Bridge read_bridge(const GeneratorInput& in) {
  const std::size_t spans = in.entries.at("span"), piers = in.entries.at("pier");
  if (piers != 1 && piers + 1 != spans)
    throw InputError("[[bridge.pier]] is there {} times for {} spans: give one, which holds for all, or {}", piers,
                     spans, spans - 1);
  Bridge bridge;
  read_spans(bridge, in);
  read_supports(bridge, in);
  bridge.width = in("width");
  const auto length = [](const Support& support) { return support.x1 - support.x0; };
  bridge.backing_over_abutment[0] = length(bridge.supports.front());
  bridge.backing_over_abutment[1] = length(bridge.supports.back());
  bridge.spandrel_bottom = in("spandrel_thickness_bottom"), bridge.spandrel_top = in("spandrel_thickness_top");
  bridge.parapet_height = in("parapet_height"), bridge.parapet_thickness = in("parapet_thickness");
  bridge.base_depth = in("base_depth"), bridge.restraint_depth = in("restraint_depth");
  bridge.wing_wall_thickness = in("spandrel_thickness_bottom");
  bridge.leaf_thickness[0] = in("leaf_thickness_even"), bridge.leaf_thickness[1] = in("leaf_thickness_odd");
  read_fill_and_blocks(bridge, in);
  return bridge;
}

/// Keys that contradict one another, by name.
void check_bridge(const Bridge& bridge, const GeneratorInput& in) {
  const auto at_most = [](double low, const std::string& small, double high, const std::string& large) {
    if (low > high + 1e-9)
      throw InputError("[bridge] {} = {:g} m is more than {} = {:g} m: make the first smaller or the second larger",
                       small, low, large, high);
  };
  at_most(in("backing_height"), "backing_height", bridge.deck - bridge.springing, "springing to deck");
  const double inside = 0.9 * in("width");
  at_most(2.0 * in("spandrel_thickness_bottom"), "2 spandrel_thickness_bottom", inside, "0.9 width");
  at_most(2.0 * in("spandrel_thickness_top"), "2 spandrel_thickness_top", inside, "0.9 width");
  at_most(in("parapet_height") > 0.0 ? in("parapet_thickness") : 0.0, "parapet_thickness", in("spandrel_thickness_top"),
          "spandrel_thickness_top");
  for (std::size_t i = 0; i < bridge.supports.size(); ++i) {
    const Support& support = bridge.supports[i];
    const std::string heading = support_key(i, bridge.vaults.size());
    const double backing = bridge.backing_top - bridge.springing;
    if (support.top > bridge.backing_top + 1e-9)
      throw InputError(
          "[bridge] backing_height = {:g} m ends below the feet of the vaults on {}: at least {:g} m are needed",
          backing, heading, support.top - bridge.springing);
    if (support.leaf)
      for (const char* key : {"leaf_thickness_even", "leaf_thickness_odd"})
        at_most(2.0 * in(key), std::string("2 ") + key, 0.95 * std::min(support.x1 - support.x0, bridge.width),
                "0.95 times the least of width and what " + heading + " is long");
  }
}

/// What the interface's share refers to: moduli over the mean size of a block of each component.
std::map<Component, Stiffness> masonry_stiffness(const Bridge& bridge, const std::vector<Material>& materials,
                                                 const JointRules& rules) {
  std::map<Component, Stiffness> table;
  for (const auto& [component, size] : rules.nominal) {
    const Material& m = materials[std::size_t(component == Component::arch     ? bridge.vault
                                              : component == Component::infill ? bridge.infill_material
                                                                               : bridge.masonry)];
    table[component] = {m.youngs_modulus / size.mean(), m.shear_modulus / size.mean()};
  }
  return table;
}

Assembly build(const std::vector<Material>& defaults, const GeneratorInput& in) {
  Bridge bridge = read_bridge(in);
  check_bridge(bridge, in);
  const std::vector<Material> materials = in_order(defaults, in);
  find_materials(bridge, materials);
  JointRules rules = joint_rules(bridge, in);
  rules.table = masonry_stiffness(bridge, materials, rules);
  return lay_bridge(bridge, materials, rules, in);
}

std::vector<Parameter> own_keys() {
  return {{"width", 8.0, 1.0, 40.0, "m", "from face to face of the spandrel walls"},
          {"fill_over_crown", 0.5, 0.0, 20.0, "m", "from the highest crown of the extrados to the deck"},
          {"backing_height", 1.0, 0.0, 60.0, "m", "top of the backing above the lowest springing"},
          {"spandrel_thickness_bottom", 0.6, 0.1, 10.0, "m", "lowest course of the spandrel walls"},
          {"spandrel_thickness_top", 0.6, 0.1, 10.0, "m", "topmost course; stepped by course in between"},
          {"parapet_height", 1.0, 0.0, 5.0, "m", "above the deck; 0: no parapets"},
          {"parapet_thickness", 0.35, 0.05, 5.0, "m", "flush with the outer faces"},
          {"base_depth", 1.0, 0.1, 20.0, "m", "depth of the fixed block under each support"},
          {"restraint_depth", 1.0, 0.1, 20.0, "m", "length of the fixed block at each end, if restrained"},
          {"leaf_thickness_even", 0.3, 0.05, 5.0, "m", "leaf: thickness in courses 0, 2, … from the base"},
          {"leaf_thickness_odd", 0.5, 0.05, 5.0, "m", "leaf: thickness in courses 1, 3, …"},
          {"block_scale", 1.0, 0.25, 6.0, "-", "factor on all block sizes"},
          {"voussoir_length", 0.4, 0.03, 10.0, "m", "voussoirs along the intrados, at most"},
          {"voussoir_width", 0.6, 0.05, 10.0, "m", "voussoirs across"},
          {"block_length", 0.8, 0.05, 10.0, "m", "masonry in courses: along the bridge"},
          {"block_width", 0.6, 0.05, 10.0, "m", "the same, across"},
          {"block_height", 0.4, 0.05, 10.0, "m", "the same, course height"},
          {"leaf_course_height", 0.8, 0.05, 10.0, "m", "leaf: course height; the infill has two courses in one"},
          {"leaf_length", 0.7, 0.05, 10.0, "m", "leaf: length of its pieces along the face"},
          {"infill_length", 0.7, 0.05, 10.0, "m", "infill: along the bridge"},
          {"infill_width", 0.7, 0.05, 10.0, "m", "infill: across"},
          {"fill_length", 0.8, 0.05, 10.0, "m", "rigid backfill: along the bridge"},
          {"fill_width", 0.8, 0.05, 10.0, "m", "rigid backfill: across"},
          {"fill_height", 0.4, 0.05, 10.0, "m", "rigid backfill: course height"},
          {"fill_edge", 0.5, 0.05, 5.0, "m", "deformable backfill: longest edge of its tetrahedra, at any block_scale"},
          {"sliver_thickness", 0.15, 0.0, 1.0, "m", "a thinner cut block (times block_scale) joins its neighbour"},
          {"sliver_share", 0.25, 0.0, 0.9, "-", "and so does one of a smaller share of its nominal volume"},
          {"interface_share", 0.2, 1e-6, 10.0, "-", "masonry to backfill: share of the masonry's stiffness"},
          {"interface_friction", 35.0, 0.0, 80.0, "deg", "masonry to backfill: friction, without cohesion or tension"},
          {"restraint_share", 0.5, 1e-6, 10.0, "-", "restrained ends: share of the adjacent material's stiffness"}};
}

std::vector<Choice> own_choices() {
  return {{"abutments", {"free", "restrained"}, "restrained: a fixed block over the whole end face at each end"},
          {"backfill", {"rigid", "deformable", "none"}, "blocks, one continuum of tetrahedra, or left out"},
          {"fill_bond", {"stack", "running"}, "rigid backfill: joints above joints, or running bond"}};
}

KeyTable span_keys() {
  KeyTable t;
  t.name = "span", t.help = "the vaults from left to right; `repeat` = 3 stands for three alike";
  t.least = 1, t.most = most_spans;
  t.choices = {{"shape", vault_shapes(), "of the intrados"}};
  t.parameters = {
      {"clear_span", 8.0, 0.3, 100.0, "m", "between the springings; of a surveyed vault its intrados says it"},
      {"rise", 0.0, 0.0, 60.0, "m",
       "of the crown; 0: half the span, of a pointed vault 0.6, of other shapes a quarter"},
      {"ring_thickness", 0.5, 0.03, 5.0, "m", "at the crown, of all rings together"},
      {"springing_thickness", 0.0, 0.0, 5.0, "m", "at the springings, likewise; 0: as at the crown"},
      {"rings", 1.0, 1.0, 8.0, "-", "rings of equal thickness, joint over joint", true},
      {"voussoirs", 0.0, 0.0, 400.0, "-", "of each ring; 0: an even number from voussoir_length", true},
      {"springing_left", 0.0, -20.0, 20.0, "m", "above the level that the heights of piers and abutments reach to"},
      {"springing_right", 0.0, -20.0, 20.0, "m", "likewise"}};
  t.profiles = {{"intrados", "surveyed, from springing to springing, x and z from any origin"}};
  return t;
}

std::vector<Choice> makeup() {
  return {{"makeup", {"solid", "leaf"}, "solid courses, or an outer leaf around infill"}};
}

KeyTable pier_keys() {
  KeyTable t;
  t.name = "pier", t.help = "the piers from left to right; one entry holds for all";
  t.least = 1, t.most = most_spans;
  t.choices = makeup();
  t.parameters = {{"height", 5.0, 0.1, 100.0, "m", "from the base to the level of the springings"},
                  {"thickness", 1.5, 0.1, 20.0, "m", "along the bridge, at the springing"},
                  {"batter_x", 0.0, 0.0, 0.3, "-", "slope of its faces along the bridge, widening downwards"},
                  {"batter_y", 0.0, 0.0, 0.3, "-", "slope of its side faces"}};
  return t;
}

KeyTable abutment_keys(const std::string& side) {
  KeyTable t;
  t.name = "abutment." + side, t.help = "the " + side + " abutment";
  t.choices = makeup();
  t.parameters = {{"length", 4.0, 0.3, 60.0, "m", "from the end of the bridge to the springing"},
                  {"height", 4.0, 0.1, 100.0, "m", "from the base to the level of the springings"},
                  {"batter_y", 0.0, 0.0, 0.3, "-", "slope of its side faces"}};
  return t;
}

}  // namespace

Generator bridge_generator() {
  const double friction = radians(30.0), loose = radians(35.0);
  Generator generator;
  generator.name = "bridge";
  generator.help = "Any number of spans of any shape, on abutments and piers";
  generator.parameters = own_keys();
  generator.choices = own_choices();
  generator.tables = {span_keys(), pier_keys(), abutment_keys("left"), abutment_keys("right")};
  generator.materials = {{"masonry", 1900.0, 3.0e9, 1.2e9, 0.10e6, 0.15e6, friction},
                         {"vault", 1900.0, 4.0e9, 1.6e9, 0.10e6, 0.15e6, friction},
                         {"infill", 1700.0, 0.8e9, 0.32e9, 0.0, 0.02e6, loose},
                         {"backfill", 1800.0, 0.1e9, 0.04e9, 0.0, 0.01e6, loose}};
  generator.fill_space = [](const GeneratorInput& in) { return fill_space(read_bridge(in)); };
  generator.build = [materials = generator.materials](const GeneratorInput& in) { return build(materials, in); };
  return generator;
}

}  // namespace voussoir
