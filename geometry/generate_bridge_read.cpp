// The keys of the generator "bridge" as dimensions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/generate_bridge.h"
#include "geometry/masonry_build.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

std::string support_heading(std::size_t support, std::size_t spans) {
  if (support == 0) return "[bridge.abutment.left]";
  if (support == spans) return "[bridge.abutment.right]";
  return fmt::format("[[bridge.pier]] number {}", support);
}

namespace {

double backing_at(const Bridge& bridge, double x) {
  const Polygon& line = bridge.backing_line;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (x <= line[i + 1].x())
      return line[i].z() + (line[i + 1].z() - line[i].z()) * (x - line[i].x()) / (line[i + 1].x() - line[i].x());
  return line.empty() ? bridge.backing_top : line.back().z();  // an end of the bridge may be rounded to beyond it
}

}  // namespace

double least_backing(const Bridge& bridge, double x0, double x1) {
  double least = std::min(backing_at(bridge, x0), backing_at(bridge, x1));
  for (const Vec3& p : bridge.backing_line)
    if (p.x() > x0 && p.x() < x1) least = std::min(least, p.z());
  return least;
}

std::string span_prefix(std::size_t i) {
  return fmt::format("span.{}.", i + 1);
}

std::string support_prefix(const GeneratorInput& in, std::size_t support, std::size_t spans) {
  if (support == 0) return "abutment.left.";
  if (support == spans) return "abutment.right.";
  return fmt::format("pier.{}.", in.entries.at("pier") == 1 ? 1 : support);
}

namespace {

std::string span_heading(std::size_t i) {
  return fmt::format("[[bridge.span]] number {}", i + 1);
}

double span_length(const GeneratorInput& in, std::size_t i) {
  const auto line = in.profiles.find(span_prefix(i) + "intrados");
  return line == in.profiles.end() ? in(span_prefix(i) + "clear_span")
                                   : line->second.back().x() - line->second.front().x();
}

/// The thickness of each ring: as given for each of them, or in equal parts.
void read_rings(VaultShape& v, const GeneratorInput& in, std::size_t i) {
  const std::string key = span_prefix(i);
  const auto each = in.profiles.find(key + "ring_thicknesses");
  if (each == in.profiles.end()) {
    const double crown = in(key + "ring_thickness"), own = in(key + "springing_thickness");
    const auto rings = std::size_t(in(key + "rings"));
    v.crown.assign(rings, crown / double(rings));
    v.springing.assign(rings, (own > 0.0 ? own : crown) / double(rings));
    return;
  }
  constexpr double least = 0.01, most = 5.0;  // m
  constexpr std::size_t most_rings = 8;
  if (each->second.size() > most_rings)
    throw InputError("{}: ring_thicknesses has {} rings. At most {} are allowed.", span_heading(i), each->second.size(),
                     most_rings);
  for (const Vec3& pair : each->second) {
    v.crown.push_back(pair.x()), v.springing.push_back(pair.z());
    for (const double t : {pair.x(), pair.z()})
      if (!(t >= least && t <= most))
        throw InputError("{}: ring_thicknesses has {:g} m in ring {}. It must be from {:g} to {:g} m.", span_heading(i),
                         t, v.crown.size(), least, most);
  }
}

/// The shape of a vault whose left springing is at x (m), of springings about z (m).
VaultShape read_shape(const GeneratorInput& in, std::size_t i, double x, double z) {
  const std::string key = span_prefix(i);
  VaultShape v;
  v.shape = in.choices.at(key + "shape");
  const auto line = in.profiles.find(key + "intrados");
  const bool given = line != in.profiles.end();
  if (given && v.shape != "surveyed")
    throw InputError("{}: intrados is given, but shape = \"{}\". Set shape = \"surveyed\", or leave out intrados.",
                     span_heading(i), v.shape);
  if (!given && v.shape == "surveyed")
    throw InputError("{}: shape = \"surveyed\" needs intrados = [[x, z], …], from springing to springing",
                     span_heading(i));
  if (given && line->second.size() < 3)
    throw InputError("{}: intrados has {}. It must have at least 3, from springing to springing.", span_heading(i),
                     counted(line->second.size(), "point"));
  if (given && (in(key + "rise") != 0.0 || in(key + "springing_right") != 0.0))
    throw InputError(
        "{}: rise = {:g} m and springing_right = {:g} m are given, but follow from intrados. Leave them out.",
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
  read_rings(v, in, i);
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
          "{}: its intrados overhangs a springing by {:g} m. Reduce the difference between springing_left = {:g} m and "
          "springing_right = {:g} m, or choose another shape.",
          span_heading(i), std::max(shape.left.x() - p.x(), p.x() - shape.right.x()),
          in(span_prefix(i) + "springing_left"), in(span_prefix(i) + "springing_right"));
  Vault vault;
  vault.rings = rings;
  vault.thickness = shape.crown;
  vault.voussoir = {intrados_length(shape) / shape.voussoirs, in("voussoir_width") * in("block_scale"),
                    shape.crown.back()};
  vault.headers_every = std::size_t(in(span_prefix(i) + "headers_every"));
  return vault;
}

double support_height(const GeneratorInput& in, std::size_t support, std::size_t spans) {
  return in(support_prefix(in, support, spans) + "height");
}

/// The common springing level above the lowest base, m.
double springing_level(const GeneratorInput& in, std::size_t spans) {
  double level = 0.0;
  for (std::size_t i = 0; i <= spans; ++i) level = std::max(level, support_height(in, i, spans));
  return level;
}

/// The top of a backing that is not level; the bridge is `length` m long, square to the supports.
void read_backing_line(Bridge& bridge, const GeneratorInput& in, double length) {
  const auto given = in.profiles.find("backing.profile");
  if (given == in.profiles.end()) return;
  for (const Vec3& p : given->second) bridge.backing_line.push_back(p + Vec3(0.0, 0.0, bridge.springing));
  const Polygon& line = bridge.backing_line;
  if (line.size() < 2 || std::abs(line.front().x()) > 1e-6 || std::abs(line.back().x() - length) > 1e-6)
    throw InputError(
        "[bridge.backing] profile goes from x = {:g} to {:g} m. It must go from 0 to {:g} m, the length of the bridge "
        "square to its supports.",
        line.empty() ? 0.0 : line.front().x(), line.empty() ? 0.0 : line.back().x(), length);
  bridge.backing_line.front().x() = 0.0, bridge.backing_line.back().x() = length;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (line[i + 1].x() - line[i].x() < 0.01)
      throw InputError(
          "[bridge.backing] profile: point {} has x = {:g} m. It must be at least 0.01 m more than {:g} m.", i + 2,
          line[i + 1].x(), line[i].x());
  bridge.backing_top = bridge.springing;  // no course of the spandrel walls ends with it
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
    x = shape.right.x() + (i + 1 < spans ? in(support_prefix(in, i + 1, spans) + "thickness") : 0.0);
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
  const double given = in("deck_height");
  if (given > 0.0) {
    if (bridge.gradient != 0.0 || bridge.springing + given < crown - 1e-9)
      throw InputError(
          "[bridge] deck_height = {:g} m, but it needs a deck without gradient and above the highest crown, which is "
          "at {:g} m. Set it to 0, so that fill_over_crown gives the height of the deck, or to a larger value.",
          given, crown - bridge.springing);
    bridge.deck = bridge.springing + given;
  }
  bridge.backing_top = bridge.springing + in("backing_height");
  read_backing_line(bridge, in, end);
}

/// Reads makeup, width and batter of an abutment or a pier.
void read_makeup(Support& support, const GeneratorInput& in, const std::string& prefix, const std::string& heading,
                 bool pier) {
  const std::string& makeup = in.choices.at(prefix + "makeup");
  support.makeup = makeup == "leaf" ? Makeup::leaf : makeup == "hollow" ? Makeup::hollow : Makeup::solid;
  const double own = in(prefix + "width"), width = in("width");
  support.width = own > 0.0 ? own : width;
  if (support.width < width)
    throw InputError(
        "{}: width = {:g} m is less than [bridge] width = {:g} m. Make it larger, or 0 for the same width.", heading,
        support.width, width);
  support.slope_x = pier ? in(prefix + "batter_x") : 0.0;
  support.slope_y = in(prefix + "batter_y");
  if (support.makeup != Makeup::solid && (support.slope_x > 0.0 || support.slope_y > 0.0))
    throw InputError("{}: makeup = \"{}\" has upright faces. Set the batter to 0, or makeup = \"solid\".", heading,
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
    throw InputError("{}: cutwater_height = {:g} m is larger than the height of the springing above the base, {:g} m",
                     heading, height, support.height);
  if (support.slope_y * support.height > 0.8 * support.cutwater.length)
    throw InputError(
        "{}: batter_y = {:g} uses {:g} m of cutwater_length = {:g} m. Make the first smaller or the second larger.",
        heading, support.slope_y, support.slope_y * support.height, support.cutwater.length);
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
    throw InputError(
        "{}: wing_length or counterforts need the same space as [bridge] abutments = \"restrained\". Keep one of them.",
        heading);
  const double most =
      std::max(wings.length > 0.0 ? wings.top : 0.0, wings.counterforts > 0 ? wings.counterfort_top : 0.0);
  if (most > deck + 1e-9)
    throw InputError(
        "{}: wing_height or counterfort_height reaches {:g} m above the base, which is {:g} m above the deck", heading,
        most - support.base, most - deck);
  const double room = bridge.width - (wings.length > 0.0 ? 2.0 * wings.thickness : 0.0);
  if (room < 0.1 || wings.counterforts * wings.counterfort_thickness > 0.9 * room)
    throw InputError(
        "{}: wing_thickness and counterforts x counterfort_thickness are too large for [bridge] width = {:g} m",
        heading, bridge.width);
}

void read_supports(Bridge& bridge, const GeneratorInput& in) {
  const std::size_t spans = bridge.vaults.size();
  const double level = springing_level(in, spans);
  for (std::size_t i = 0; i <= spans; ++i) {
    const std::string heading = support_heading(i, spans);
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
            "{}: the foot of a vault on this support reaches {:g} m below its springing, into the support. Reduce the "
            "difference between springing_left and springing_right of its [[bridge.span]].",
            heading, in_end.z() - out_end.z());
      support.springing = std::min(support.springing, in_end.z());
      support.top = std::max({support.top, in_end.z(), out_end.z()});
    };
    if (before) stands(before->rings.front().intrados.back(), before->rings.back().extrados.back());
    if (after) stands(after->rings.front().intrados.front(), after->rings.back().extrados.front());
    support.height = support.springing - support.base;
    if (support.height < 0.05)
      throw InputError("{}: height = {:g} m leaves only {:g} m below the springing. Make it larger.", heading,
                       support_height(in, i, spans), support.height);
    const std::string prefix = support_prefix(in, i, spans);
    read_makeup(support, in, prefix, heading, before && after);
    if (before && after) {
      read_cutwater(support, in, prefix, heading);
    } else {
      read_wings(support, bridge, in, prefix, heading, before ? support.x1 : 0.0);
    }
    support.leaf_beside_span = support.x1 - support.x0;
    if (!(before && after) && in(prefix + "built_length") > 0.0) {
      support.leaf_beside_span = in(prefix + "built_length");
      if (support.makeup != Makeup::leaf || support.leaf_beside_span > support.x1 - support.x0 + 1e-9)
        throw InputError("{}: built_length = {:g} m needs makeup = \"leaf\" and must be at most length = {:g} m",
                         heading, support.leaf_beside_span, support.x1 - support.x0);
    }
    const double left = before ? before->rings.back().extrados.back().x() : support.x0 + 0.05,
                 right = after ? after->rings.back().extrados.front().x() : support.x1 - 0.05;
    if (right < left - 1e-9)
      throw InputError("{}: {} = {:g} m is too small for the feet of the vaults on it. It must be at least {:g} m.",
                       heading, before && after ? "thickness" : "length", support.x1 - support.x0,
                       support.x1 - support.x0 + left - right);
    bridge.supports.push_back(support);
  }
}

/// Tapered walls are laid out with their mean thickness.
void read_spandrels(Bridge& bridge, const GeneratorInput& in) {
  bridge.spandrel_bottom = in("spandrel_thickness_bottom"), bridge.spandrel_top = in("spandrel_thickness_top");
  bridge.tapered = in.choices.at("spandrel_back") == "tapered";
  if (!bridge.tapered) return;
  bridge.taper_bottom = bridge.spandrel_bottom, bridge.taper_top = bridge.spandrel_top;
  bridge.spandrel_bottom = bridge.spandrel_top = 0.5 * (bridge.taper_bottom + bridge.taper_top);
  if (in("internal.walls") > 0.0 && in.choices.at("internal.between") == "void")
    throw InputError(
        "[bridge] spandrel_back = \"tapered\" gives no bearing to the slabs of [bridge.internal] between = \"void\". "
        "Choose \"stepped\" or \"fill\".");
  for (const std::size_t i : {std::size_t(0), bridge.last_support()}) {
    const auto [x0, x1] = wing_extent(bridge, i);
    if (bridge.deformable_backfill && x1 - x0 > no_masonry)
      throw InputError(
          "[bridge] spandrel_back = \"tapered\" with backfill = \"deformable\" allows no fill between wing walls, but "
          "{} has built_length = {:g} m. Set it to 0, or choose \"stepped\" or \"rigid\".",
          support_heading(i, bridge.vaults.size()), in(support_prefix(in, i, bridge.vaults.size()) + "built_length"));
  }
}

void read_internal_walls(Bridge& bridge, const GeneratorInput& in) {
  InternalWalls& walls = bridge.internal;
  walls.number = int(in("internal.walls")), walls.thickness = in("internal.thickness");
  walls.hollow = in.choices.at("internal.between") == "void";
  if (walls.number == 0) return;
  const double room = 2.0 * (bridge.half_width() - std::max(bridge.spandrel_bottom, bridge.spandrel_top));
  if (walls.number * walls.thickness > 0.8 * room)
    throw InputError(
        "[bridge.internal] {} of {:g} m {} too little of the {:g} m between the spandrel walls. Use fewer or "
        "thinner walls.",
        counted(walls.number, "wall"), walls.thickness, walls.number == 1 ? "leaves" : "leave", room);
  const double lowest = std::min(bridge.deck_at(0.0), bridge.deck_at(bridge.length()));
  walls.slab_thickness = in("internal.slab_thickness");
  walls.slab_top = lowest - in("internal.fill_over_slabs");
  walls.bearing = std::min(0.1, 0.3 * std::min(bridge.spandrel_bottom, bridge.spandrel_top));
  if (walls.hollow && walls.slab_bottom() < std::max(bridge.backing_top, bridge.springing) + 0.05)
    throw InputError(
        "[bridge.internal] slab_thickness = {:g} m and fill_over_slabs = {:g} m bring the slabs {:g} m above the "
        "springing, into the backing. Make them or backing_height smaller.",
        walls.slab_thickness, in("internal.fill_over_slabs"), walls.slab_bottom() - bridge.springing);
  const bool covered = in("backing_over_abutment") <= 0.0;
  if (!walls.hollow && !covered && bridge.deformable_backfill)
    throw InputError(
        "[bridge.internal] between = \"fill\" with backfill = \"deformable\" needs backing over the whole "
        "abutments. Set backing_over_abutment to 0.");
}

/// Makes the bridge a strip, without walls along the faces, cutwaters and wing walls.
void make_strip(Bridge& bridge, const GeneratorInput& in) {
  if (bridge.skew != 0.0)
    throw InputError(
        "[bridge] extent = \"strip\" is square to the supports, but skew = {:g} degrees. Set skew to 0, or extent to "
        "\"whole\".",
        in("skew"));
  bridge.strip = true;
  bridge.width = in("strip_width");
  bridge.spandrel_bottom = bridge.spandrel_top = bridge.wing_wall_thickness = 0.0;
  bridge.parapet_height = bridge.string_height = 0.0;
  bridge.internal.number = 0;
  for (std::size_t i = 0; i < bridge.supports.size(); ++i) {
    Support& support = bridge.supports[i];
    if (support.makeup != Makeup::solid)
      throw InputError(
          "{}: makeup must be \"solid\" with extent = \"strip\", because plane strain has no leaf around a support",
          support_heading(i, bridge.vaults.size()));
    support.width = bridge.width, support.slope_y = 0.0;
    support.cutwater = {}, support.wings = {};
  }
}

void read_load_beam(Bridge& bridge, const GeneratorInput& in) {
  LoadBeam& beam = bridge.beam;
  beam.length = in("beam.length"), beam.height = in("beam.height");
  if (beam.length <= 0.0) return;
  const auto span = std::size_t(in("beam.span"));
  if (span > bridge.vaults.size())
    throw InputError("[bridge.beam] span = {}, but the bridge has {}", span, counted(bridge.vaults.size(), "span"));
  const Vault& vault = bridge.vaults[span - 1];
  beam.middle = vault.left() + in("beam.at") * (vault.right() - vault.left());
  const double room = 2.0 * std::min(beam.middle, bridge.length() - beam.middle);
  if (beam.length > room)
    throw InputError(
        "[bridge.beam] length = {:g} m reaches beyond the end of the bridge. At this place it must be at most {:g} m.",
        beam.length, room);
  if (in.choices.at("backfill") == "none")
    throw InputError(
        "[bridge.beam] length = {:g} m, but backfill = \"none\" gives no fill to load. Set backfill to \"rigid\" or "
        "\"deformable\".",
        beam.length);
}

}  // namespace

Bridge read_any_bridge(const GeneratorInput& in) {
  const std::size_t spans = in.entries.at("span"), piers = in.entries.at("pier");
  if (piers != 1 && piers + 1 != spans)
    throw InputError("[[bridge.pier]] is given {} times for {} spans. Give one, which applies to all piers, or {}.",
                     piers, spans, spans - 1);
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
  for (const int end : {0, 1}) {
    const double all = length(end == 0 ? bridge.supports.front() : bridge.supports.back());
    const double own = in("backing_over_abutment");
    bridge.backing_over_abutment[end] = own > 0.0 ? std::min(own, all) : all;
  }
  bridge.surfacing_depth = in("surfacing_depth");
  bridge.parapet_height = in("parapet_height"), bridge.parapet_thickness = in("parapet_thickness");
  bridge.base_depth = in("base_depth"), bridge.restraint_depth = in("restraint_depth");
  const double wing = in("wing_wall_thickness");
  bridge.wing_wall_thickness = wing > 0.0 ? wing : in("spandrel_thickness_bottom");
  bridge.leaf_thickness[0] = in("leaf_thickness_even"), bridge.leaf_thickness[1] = in("leaf_thickness_odd");
  read_fill_and_blocks(bridge, in);
  if (in.choices.at("extent") == "strip") {
    make_strip(bridge, in);
  } else {
    read_spandrels(bridge, in);
    read_internal_walls(bridge, in);
  }
  read_load_beam(bridge, in);
  return bridge;
}

}  // namespace voussoir
