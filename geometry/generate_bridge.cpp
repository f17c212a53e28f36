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
  const std::vector<Ring> rings = vault_rings(shape, span_heading(i));
  for (const Vec3& p : rings.front().intrados)
    if (p.x() < shape.left.x() - no_masonry || p.x() > shape.right.x() + no_masonry)
      throw InputError(
          "{}: its intrados overhangs a springing by {:g} m: lessen the difference of springing_left = {:g} m and "
          "springing_right = {:g} m, or choose another shape",
          span_heading(i), std::max(shape.left.x() - p.x(), p.x() - shape.right.x()),
          in(span_prefix(i) + "springing_left"), in(span_prefix(i) + "springing_right"));
  return {rings,
          {intrados_length(shape) / shape.voussoirs, in("voussoir_width") * in("block_scale"), shape.crown.front()},
          std::size_t(in(span_prefix(i) + "headers_every"))};
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

/// The top of a backing that is not level; the bridge is `length` m long, square to the supports.
void read_backing_line(Bridge& bridge, const GeneratorInput& in, double length) {
  const auto given = in.profiles.find("backing.profile");
  if (given == in.profiles.end()) return;
  for (const Vec3& p : given->second) bridge.backing_line.push_back(p + Vec3(0.0, 0.0, bridge.springing));
  const Polygon& line = bridge.backing_line;
  if (line.size() < 2 || std::abs(line.front().x()) > 1e-6 || std::abs(line.back().x() - length) > 1e-6)
    throw InputError(
        "[bridge.backing] profile goes from x = {:g} to {:g} m, expected from 0 to {:g} m, the length of the bridge "
        "square to its supports",
        line.empty() ? 0.0 : line.front().x(), line.empty() ? 0.0 : line.back().x(), length);
  bridge.backing_line.front().x() = 0.0, bridge.backing_line.back().x() = length;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (line[i + 1].x() - line[i].x() < 0.01)
      throw InputError("[bridge.backing] profile: point {} has x = {:g} m, expected at least 0.01 m more than {:g} m",
                       i + 2, line[i + 1].x(), line[i].x());
  bridge.backing_top = bridge.springing;  // no course of the spandrel walls ends with it
}

double backing_at(const Bridge& bridge, double x) {
  const Polygon& line = bridge.backing_line;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (x <= line[i + 1].x())
      return line[i].z() + (line[i + 1].z() - line[i].z()) * (x - line[i].x()) / (line[i + 1].x() - line[i].x());
  return bridge.backing_top;
}

/// The lowest point of the backing's top from x0 to x1.
double least_backing(const Bridge& bridge, double x0, double x1) {
  double least = std::min(backing_at(bridge, x0), backing_at(bridge, x1));
  for (const Vec3& p : bridge.backing_line)
    if (p.x() > x0 && p.x() < x1) least = std::min(least, p.z());
  return least;
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
  // The gradient goes with the way square to the supports; the deck is level along them.
  bridge.gradient = 0.01 * in("gradient") / std::cos(radians(in("skew")));
  const double end = x + in("abutment.right.length");
  double start = -1e300;  // of the deck, at x = 0
  for (const Vault& vault : bridge.vaults)
    for (const Vec3& p : vault.rings.back().extrados) start = std::max(start, p.z() - bridge.gradient * p.x());
  bridge.deck_start = start + in("fill_over_crown");
  bridge.deck =
      bridge.gradient == 0.0 ? crown + in("fill_over_crown") : bridge.deck_start + std::max(0.0, bridge.gradient * end);
  bridge.backing_top = bridge.springing + in("backing_height");
  read_backing_line(bridge, in, end);
}

/// What an abutment or a pier says beside its height.
void read_makeup(Support& support, const GeneratorInput& in, const std::string& prefix, const std::string& heading,
                 bool pier) {
  const std::string& makeup = in.choices.at(prefix + "makeup");
  support.makeup = makeup == "leaf" ? Makeup::leaf : makeup == "hollow" ? Makeup::hollow : Makeup::solid;
  const double own = in(prefix + "width"), width = in("width");
  support.width = own > 0.0 ? own : width;
  if (support.width < width)
    throw InputError("{}: width = {:g} m is less than [bridge] width = {:g} m: make it wider, or 0 for the same",
                     heading, support.width, width);
  support.slope_x = pier ? in(prefix + "batter_x") : 0.0;
  support.slope_y = in(prefix + "batter_y");
  if (support.makeup != Makeup::solid && (support.slope_x > 0.0 || support.slope_y > 0.0))
    throw InputError("{}: makeup = \"{}\" has upright faces: set its batter to 0, or makeup = \"solid\"", heading,
                     makeup);
}

void read_cutwater(Support& support, const GeneratorInput& in, const std::string& prefix, const std::string& heading) {
  const std::string& shape = in.choices.at(prefix + "cutwater");
  if (shape == "none") return;
  const double length = in(prefix + "cutwater_length"), height = in(prefix + "cutwater_height");
  support.cutwater.round = shape == "round";
  support.cutwater.length = length > 0.0 ? length : 0.5 * (support.x1 - support.x0);
  support.cutwater.height = height > 0.0 ? height : support.height;
  if (support.cutwater.height > support.height + 1e-9)
    throw InputError("{}: cutwater_height = {:g} m is more than the height to the springing, {:g} m", heading, height,
                     support.height);
  if (support.slope_y * support.height > 0.8 * support.cutwater.length)
    throw InputError(
        "{}: batter_y = {:g} takes up {:g} m of cutwater_length = {:g} m: make the one less or the other more", heading,
        support.slope_y, support.slope_y * support.height, support.cutwater.length);
}

void read_wings(Support& support, const Bridge& bridge, const GeneratorInput& in, const std::string& prefix,
                const std::string& heading, double end) {
  Wings& wings = support.wings;
  const double deck = bridge.deck_at(end), height = in(prefix + "wing_height");
  wings.length = in(prefix + "wing_length"), wings.thickness = in(prefix + "wing_thickness");
  wings.slope = std::tan(radians(in(prefix + "wing_splay")));
  wings.top = height > 0.0 ? support.base + height : deck;
  wings.counterforts = int(in(prefix + "counterforts"));
  wings.counterfort_length = in(prefix + "counterfort_length");
  wings.counterfort_thickness = in(prefix + "counterfort_thickness");
  const double own = in(prefix + "counterfort_height");
  wings.counterfort_top = own > 0.0 ? support.base + own : support.springing;
  if (wings.length <= 0.0 && wings.counterforts == 0) return;
  if (in.choices.at("abutments") == "restrained")
    throw InputError("{}: wing_length or counterforts and [bridge] abutments = \"restrained\" take up the same space",
                     heading);
  const double most =
      std::max(wings.length > 0.0 ? wings.top : 0.0, wings.counterforts > 0 ? wings.counterfort_top : 0.0);
  if (most > deck + 1e-9)
    throw InputError(
        "{}: wing_height or counterfort_height reaches {:g} m above the base, {:g} m more than the deck there", heading,
        most - support.base, most - deck);
  const double room = bridge.width - (wings.length > 0.0 ? 2.0 * wings.thickness : 0.0);
  if (room < 0.1 || wings.counterforts * wings.counterfort_thickness > 0.9 * room)
    throw InputError(
        "{}: wing_thickness and counterforts times counterfort_thickness leave too little of [bridge] width = {:g} m",
        heading, bridge.width);
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
      if (out_end.z() < in_end.z() - no_masonry)
        throw InputError(
            "{}: the foot of a vault there reaches {:g} m below its springing, into the support: lessen the difference "
            "of springing_left and springing_right of its [[bridge.span]]",
            heading, in_end.z() - out_end.z());
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
    if (before && after) {
      read_cutwater(support, in, prefix, heading);
    } else {
      read_wings(support, bridge, in, prefix, heading, before ? support.x1 : 0.0);
    }
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
  bridge.width = in("width");
  bridge.skew = radians(in("skew"));
  bridge.skew_bond = in.choices.at("skew_bond") == "helicoidal"    ? SkewBond::helicoidal
                     : in.choices.at("skew_bond") == "logarithmic" ? SkewBond::logarithmic
                                                                   : SkewBond::parallel;
  bridge.string_height = in("string_course_height"), bridge.string_projection = in("string_course_projection");
  bridge.transverse_thickness = in("transverse_walls");
  read_spans(bridge, in);
  read_supports(bridge, in);
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
  const double lowest = std::min(bridge.deck_at(0.0), bridge.deck_at(bridge.length()));
  if (bridge.backing_line.empty())
    at_most(in("backing_height"), "backing_height", lowest - bridge.springing, "springing to deck");
  for (const Vec3& p : bridge.backing_line)
    at_most(p.z() - bridge.springing, "z of [bridge.backing] profile", bridge.deck_at(p.x()) - bridge.springing,
            "springing to deck there");
  if (lowest < bridge.springing + 0.1)
    throw InputError("[bridge] gradient = {:g} % takes the deck {:g} m below the springing: make it less",
                     in("gradient"), bridge.springing - lowest);
  const double inside = 0.9 * in("width");
  at_most(2.0 * in("spandrel_thickness_bottom"), "2 spandrel_thickness_bottom", inside, "0.9 width");
  at_most(2.0 * in("spandrel_thickness_top"), "2 spandrel_thickness_top", inside, "0.9 width");
  at_most(in("parapet_height") > 0.0 ? in("parapet_thickness") : 0.0, "parapet_thickness", in("spandrel_thickness_top"),
          "spandrel_thickness_top");
  for (std::size_t i = 0; i < bridge.supports.size(); ++i) {
    const Support& support = bridge.supports[i];
    const std::string heading = support_key(i, bridge.vaults.size());
    const double backing = least_backing(bridge, support.x0, support.x1);
    if (support.top > backing + 1e-9)
      throw InputError("{} = {:g} m ends below the feet of the vaults on {}: at least {:g} m are needed",
                       bridge.backing_line.empty() ? "[bridge] backing_height" : "[bridge.backing] profile: z",
                       backing - bridge.springing, heading, support.top - bridge.springing);
    const double wall = bridge.transverse_thickness, least = support.x1 - support.x0;
    if (!bridge.is_abutment(i)) at_most(wall, "transverse_walls", least, "what " + heading + " is long");
    if (support.makeup != Makeup::solid)
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
  rules.rings_bonded = in.choices.at("ring_bond") == "mortar";
  rules.table = masonry_stiffness(bridge, materials, rules);
  return lay_bridge(bridge, materials, rules, in);
}

std::vector<Parameter> own_keys() {
  return {{"width", 8.0, 1.0, 40.0, "m", "from face to face of the spandrel walls"},
          {"skew", 0.0, -45.0, 45.0, "deg",
           "of the supports against the square to the bridge; lengths along it are measured square to them"},
          {"gradient", 0.0, -12.0, 12.0, "%", "rise of the deck over the way along the bridge, from left to right"},
          {"fill_over_crown", 0.5, 0.0, 20.0, "m", "from the extrados to the deck, where it is least"},
          {"backing_height", 1.0, 0.0, 60.0, "m", "top of the backing above the lowest springing"},
          {"spandrel_thickness_bottom", 0.6, 0.1, 10.0, "m", "lowest course of the spandrel walls"},
          {"spandrel_thickness_top", 0.6, 0.1, 10.0, "m", "topmost course; stepped by course in between"},
          {"parapet_height", 1.0, 0.0, 5.0, "m", "above the deck; 0: no parapets"},
          {"parapet_thickness", 0.35, 0.05, 5.0, "m", "flush with the outer faces"},
          {"string_course_height", 0.0, 0.0, 1.0, "m", "of a course between deck and parapets; 0: none"},
          {"string_course_projection", 0.1, 0.0, 1.0, "m", "how far it stands out of the outer faces"},
          {"transverse_walls", 0.0, 0.0, 5.0, "m", "thickness of walls across over the piers, to the deck; 0: none"},
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
  return {
      {"abutments", {"free", "restrained"}, "restrained: a fixed block over the whole end face at each end"},
      {"backfill", {"rigid", "deformable", "none"}, "blocks, one continuum of tetrahedra, or left out"},
      {"skew_bond",
       {"parallel", "helicoidal", "logarithmic"},
       "beds of the vaults of a skew bridge: parallel to the supports (false skew), or square to the faces at their "
       "chord (English) or everywhere (French)"},
      {"ring_bond",
       {"mortar", "none"},
       "joints between the rings of a vault: as strong as the vault's, or with friction only"},
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
      {"headers_every", 0.0, 0.0, 100.0, "-",
       "courses from one of headers, stones through two rings, to the next; 0: none", true},
      {"voussoirs", 0.0, 0.0, 400.0, "-", "of each ring; 0: an even number from voussoir_length", true},
      {"springing_left", 0.0, -20.0, 20.0, "m", "above the level that the heights of piers and abutments reach to"},
      {"springing_right", 0.0, -20.0, 20.0, "m", "likewise"}};
  t.profiles = {{"intrados", "surveyed, from springing to springing, x and z from any origin"}};
  return t;
}

std::vector<Choice> makeup() {
  return {{"makeup", {"solid", "leaf", "hollow"}, "solid courses, or an outer leaf around infill or around nothing"}};
}

KeyTable pier_keys() {
  KeyTable t;
  t.name = "pier", t.help = "the piers from left to right; one entry holds for all";
  t.least = 1, t.most = most_spans;
  t.choices = makeup();
  t.choices.push_back({"cutwater", {"none", "triangular", "round"}, "noses on both side faces"});
  t.parameters = {{"height", 5.0, 0.1, 100.0, "m", "from the base to the level of the springings"},
                  {"thickness", 1.5, 0.1, 20.0, "m", "along the bridge, at the springing"},
                  {"batter_x", 0.0, 0.0, 0.3, "-", "slope of its faces along the bridge, widening downwards"},
                  {"batter_y", 0.0, 0.0, 0.3, "-", "slope of its side faces"},
                  {"width", 0.0, 0.0, 60.0, "m", "across, at the springing; 0: as the bridge"},
                  {"cutwater_length", 0.0, 0.0, 20.0, "m", "out of the side face; 0: half the thickness"},
                  {"cutwater_height", 0.0, 0.0, 100.0, "m", "above the base; 0: to the springing"}};
  return t;
}

KeyTable backing_keys() {
  KeyTable t;
  t.name = "backing", t.help = "a backing whose top is not level, instead of backing_height";
  t.profiles = {{"profile", "its top; x from the left end, square to the supports, z above the lowest springing"}};
  return t;
}

KeyTable abutment_keys(const std::string& side) {
  KeyTable t;
  t.name = "abutment." + side, t.help = "the " + side + " abutment";
  t.choices = makeup();
  t.parameters = {{"length", 4.0, 0.3, 60.0, "m", "from the end of the bridge to the springing"},
                  {"height", 4.0, 0.1, 100.0, "m", "from the base to the level of the springings"},
                  {"batter_y", 0.0, 0.0, 0.3, "-", "slope of its side faces"},
                  {"width", 0.0, 0.0, 60.0, "m", "across, at the springing; 0: as the bridge"},
                  {"wing_length", 0.0, 0.0, 60.0, "m", "of walls beyond the end, along the bridge; 0: none"},
                  {"wing_thickness", 0.6, 0.1, 10.0, "m", "across the bridge"},
                  {"wing_splay", 0.0, 0.0, 60.0, "deg", "angle outwards against the bridge's axis; 0: straight on"},
                  {"wing_height", 0.0, 0.0, 100.0, "m", "above the base; 0: to the deck at the end"},
                  {"counterforts", 0.0, 0.0, 20.0, "-", "buttresses against the end face", true},
                  {"counterfort_length", 1.0, 0.1, 20.0, "m", "along the bridge"},
                  {"counterfort_thickness", 0.6, 0.1, 10.0, "m", "across"},
                  {"counterfort_height", 0.0, 0.0, 100.0, "m", "above the base; 0: to the springing"}};
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
  generator.tables = {span_keys(), pier_keys(), abutment_keys("left"), abutment_keys("right"), backing_keys()};
  generator.materials = {{"masonry", 1900.0, 3.0e9, 1.2e9, 0.10e6, 0.15e6, friction},
                         {"vault", 1900.0, 4.0e9, 1.6e9, 0.10e6, 0.15e6, friction},
                         {"infill", 1700.0, 0.8e9, 0.32e9, 0.0, 0.02e6, loose},
                         {"backfill", 1800.0, 0.1e9, 0.04e9, 0.0, 0.01e6, loose}};
  generator.fill_space = [](const GeneratorInput& in) { return fill_space(read_bridge(in)); };
  generator.build = [materials = generator.materials](const GeneratorInput& in) { return build(materials, in); };
  return generator;
}

}  // namespace voussoir
