// cs1 and cs2: one layout of a multi-span masonry arch bridge with two sets of defaults. Dimensions and materials are
// those of the paper "From Monitoring to Modeling: 3D-DEM Application to Masonry Arch Bridge Case Studies" where
// it gives them; the rest is fitted to its periods (see the documentation of the bridges).
#include "geometry/generate_cs.h"

#include <cmath>

#include "geometry/generate.h"
#include "geometry/masonry_build.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

int cs_voussoirs(const GeneratorInput& in) {
  const int given = int(in("voussoirs"));
  if (given > 0) return given;
  // An even number, so that the crown is a joint and the vault its own mirror image.
  const double middle = pi * 0.5 * (in("clear_span") + in("ring_thickness"));
  return 2 * std::max(2, int(std::ceil(0.5 * middle / (in("voussoir_length") * in("block_scale")) - 1e-9)));
}

double cs_support_height(const GeneratorInput& in, int support) {
  if (support == 0 || support == int(in("spans"))) return in("abutment_height");
  const double own = in(fmt::format("pier_{}_height", support - 1));
  return own > 0.0 ? own : in("pier_height");
}

double cs_clear_span(const GeneratorInput& in, int span) {
  const double own = in(fmt::format("span_{}_clear", span));
  return own > 0.0 ? own : in("clear_span");
}

double span_start(const GeneratorInput& in, int span) {
  double start = in("abutment_length") + span * (in("clear_span") + in("pier_thickness"));
  for (int j = 0; j < span; ++j) start += cs_clear_span(in, j) - in("clear_span");
  return start;
}

void read_cs_spans(Bridge& bridge, const GeneratorInput& in) {
  const int spans = int(in("spans"));
  for (int i = 0; i <= spans; ++i) bridge.springing = std::max(bridge.springing, cs_support_height(in, i));
  bridge.deck = bridge.springing + 0.5 * in("clear_span") + in("ring_thickness") + in("fill_over_crown");
  bridge.backing_top = bridge.springing + in("backing_height");
  const double thickness = in("ring_thickness");
  const int n = cs_voussoirs(in);
  const Vec3 voussoir(pi * 0.5 * (in("clear_span") + thickness) / n, in("voussoir_width") * in("block_scale"),
                      thickness);
  for (int i = 0; i < spans; ++i) {
    const double x0 = span_start(in, i), x1 = x0 + cs_clear_span(in, i), radius = 0.5 * cs_clear_span(in, i);
    Vault vault;
    vault.rings = {make_semicircle({0.5 * (x0 + x1), 0.0, bridge.springing}, radius, radius + thickness, n)};
    vault.thickness = {thickness}, vault.voussoir = voussoir;
    bridge.vaults.push_back(vault);
  }
}

void read_cs_supports(Bridge& bridge, const GeneratorInput& in) {
  const int spans = int(in("spans"));
  const bool leaf = in.choices.at("makeup") == "leaf";
  for (int i = 0; i <= spans; ++i) {
    Support support;
    support.x0 = i == 0 ? 0.0 : span_start(in, i - 1) + cs_clear_span(in, i - 1);
    support.x1 = i < spans ? span_start(in, i) : support.x0 + in("abutment_length");
    support.height = cs_support_height(in, i);
    support.base = bridge.springing - support.height;
    support.springing = support.top = bridge.springing;
    support.makeup = leaf ? Makeup::leaf : Makeup::solid;
    support.width = in("width");
    support.leaf_beside_span = in("abutment_leaf_length");
    if (!leaf) {
      support.slope_x = i == 0 || i == spans ? 0.0 : in("batter_x");
      support.slope_y = in("batter_y");
    }
    bridge.supports.push_back(support);
  }
}

Bridge read_cs(const GeneratorInput& in) {
  Bridge bridge;
  read_cs_spans(bridge, in);
  read_cs_supports(bridge, in);
  bridge.width = in("width");
  for (double& length : bridge.backing_over_abutment) length = in("backing_over_abutment");
  bridge.spandrel_bottom = in("spandrel_thickness_bottom");
  bridge.spandrel_top = in("spandrel_thickness_top");
  bridge.parapet_height = in("parapet_height");
  bridge.parapet_thickness = in("parapet_thickness");
  bridge.base_depth = in("base_depth");
  bridge.restraint_depth = in("restraint_depth");
  bridge.wing_wall_thickness = in("wing_wall_thickness");
  bridge.leaf_thickness[0] = in("leaf_thickness_even");
  bridge.leaf_thickness[1] = in("leaf_thickness_odd");
  read_fill_and_blocks(bridge, in);
  return bridge;
}

/// Throws InputError for keys that contradict one another.
void check_cs(const GeneratorInput& in) {
  const auto at_most = [&](double low, const std::string& small, double high, const std::string& large) {
    if (low > high + 1e-9) {
      throw InputError("[bridge] {} = {:g} m is larger than {} = {:g} m. Make the first smaller or the second larger.",
                       small, low, large, high);
    }
  };
  const double deck = 0.5 * in("clear_span") + in("ring_thickness") + in("fill_over_crown");
  at_most(in("backing_height"), "backing_height", deck, "clear_span / 2 + ring_thickness + fill_over_crown");
  for (int i = 0; i < int(in("spans")); ++i) {
    const std::string key = fmt::format("span_{}_clear", i);
    at_most(in(key), key, in("clear_span") + 2.0 * in("fill_over_crown"), "clear_span + 2 fill_over_crown");
  }
  if (in("spans") > 1) at_most(2.0 * in("ring_thickness"), "2 ring_thickness", in("pier_thickness"), "pier_thickness");
  at_most(in("ring_thickness"), "ring_thickness", in("abutment_length"), "abutment_length");
  at_most(in("backing_over_abutment"), "backing_over_abutment", in("abutment_length"), "abutment_length");
  at_most(in("ring_thickness"), "ring_thickness", in("backing_over_abutment"), "backing_over_abutment");
  const double inside = 0.9 * in("width");
  at_most(2.0 * in("spandrel_thickness_bottom"), "2 spandrel_thickness_bottom", inside, "0.9 width");
  at_most(2.0 * in("spandrel_thickness_top"), "2 spandrel_thickness_top", inside, "0.9 width");
  at_most(in("parapet_height") > 0.0 ? in("parapet_thickness") : 0.0, "parapet_thickness", in("spandrel_thickness_top"),
          "spandrel_thickness_top");
  if (in("voussoirs") > 0.0 && in("voussoirs") < 4.0) {
    throw InputError("[bridge] voussoirs = {:g}. A vault needs at least 4; 0 gives the number from voussoir_length.",
                     in("voussoirs"));
  }
  if (in.choices.at("makeup") != "leaf") return;
  at_most(in("abutment_leaf_length"), "abutment_leaf_length", in("abutment_length"), "abutment_length");
  at_most(2.0 * in("wing_wall_thickness"), "2 wing_wall_thickness", inside, "0.9 width");
  const double least = std::min({in("pier_thickness"), in("abutment_leaf_length"), in("width")});
  for (const char* key : {"leaf_thickness_even", "leaf_thickness_odd"}) {
    at_most(2.0 * in(key), std::string("2 ") + key, 0.95 * least,
            "0.95 times the least of pier_thickness, abutment_leaf_length and width");
  }
  if (in("batter_x") > 0.0 || in("batter_y") > 0.0) {
    throw InputError(
        "[bridge] batter_x = {:g} and batter_y = {:g}, but piers with a leaf (makeup = \"leaf\") have upright faces. "
        "Set both to 0, or makeup = \"solid\".",
        in("batter_x"), in("batter_y"));
  }
}

/// The values of the table, for the scaled blocks. They belong to the default moduli: a case that changes a modulus
/// changes them in proportion.
std::map<Component, Stiffness> contact_table(const Bridge& bridge, const std::vector<Material>& defaults,
                                             const std::vector<Material>& materials, const GeneratorInput& in) {
  const auto row = [&](const char* name, std::int32_t material) {
    const Material &now = materials[std::size_t(material)], &then = defaults[std::size_t(material)];
    const double scale = in("block_scale");
    return Stiffness{in(std::string("kn_") + name) / scale * (now.youngs_modulus / then.youngs_modulus),
                     in(std::string("ks_") + name) / scale * (now.shear_modulus / then.shear_modulus)};
  };
  const Stiffness wall = row("wall", bridge.masonry), support = row("support", bridge.masonry);
  return {{Component::arch, row("vault", bridge.vault)},
          {Component::backing, wall},
          {Component::spandrel, wall},
          {Component::parapet, wall},
          {Component::pier, support},
          {Component::abutment, support},
          {Component::infill, row("infill", bridge.infill_material)}};
}

Assembly build_cs(const std::vector<Material>& defaults, const GeneratorInput& in) {
  check_cs(in);
  Bridge bridge = read_cs(in);
  const std::vector<Material> materials = in_order(defaults, in);
  find_materials(bridge, materials);
  JointRules rules = joint_rules(bridge, in);
  rules.kind = in.choices.at("stiffness") == "table" ? JointRules::Kind::table : JointRules::Kind::moduli;
  rules.table = contact_table(bridge, defaults, materials, in);
  return lay_bridge(bridge, materials, rules, in);
}

Generator cs_generator(const std::string& name, const std::string& help, std::vector<Parameter> parameters,
                       std::vector<Choice> choices, const std::vector<Material>& materials) {
  Generator generator;
  generator.name = name;
  generator.help = help;
  generator.parameters = std::move(parameters);
  generator.choices = std::move(choices);
  generator.materials = materials;
  generator.build = [materials](const GeneratorInput& in) { return build_cs(materials, in); };
  generator.fill_space = [](const GeneratorInput& in) { return fill_space(read_cs(in)); };
  return generator;
}

std::vector<Choice> bridge_choices(bool leaf, bool table) {
  const std::vector<std::string> makeup =
      leaf ? std::vector<std::string>{"leaf", "solid"} : std::vector<std::string>{"solid", "leaf"};
  const std::vector<std::string> stiffness =
      table ? std::vector<std::string>{"table", "moduli"} : std::vector<std::string>{"moduli", "table"};
  return {
      {"abutments", {"free", "restrained"}, "restrained: a fixed block over the whole end face at each end"},
      {"backfill",
       {"rigid", "deformable", "none"},
       "rigid: blocks; deformable: one continuum of tetrahedra; none: no backfill"},
      {"fill_bond", {"stack", "running"}, "rigid backfill: joints above joints (stack), or running bond *"},
      {"makeup", makeup, "piers and abutments: leaf around infill (in abutments abutment_leaf_length long), or solid"},
      {"stiffness", stiffness, "joint stiffness from the table kn_, ks_ of each component, or from E/dc and G/dc"}};
}

}  // namespace

Generator cs1_generator() {
  const double friction = radians(30.0), loose = radians(40.0);
  return cs_generator("cs1",
                      "Bridge with four semicircular spans of 10 m on piers of an outer leaf and infill (S. Chiara)",
                      bridge_parameters(true), bridge_choices(true, true),
                      {{"masonry", 1722.0, 4.0e9, 1.6e9, 0.10e6, 0.18e6, friction},
                       {"infill", 1524.0, 1.0e9, 0.4e9, 0.0, 0.02e6, loose},
                       {"backfill", 1500.0, 0.4e9, 0.16e9, 0.0, 0.02e6, loose}});
}

Generator cs2_generator() {
  const double friction = radians(30.0), loose = radians(40.0);
  return cs_generator("cs2", "Bridge with three semicircular spans of 15 m on tall solid piers (Gresal)",
                      bridge_parameters(false), bridge_choices(false, false),
                      {{"masonry", 1600.0, 1.41e9, 0.45e9, 0.10e6, 0.15e6, friction},
                       {"vault", 1600.0, 1.692e9, 0.54e9, 0.10e6, 0.15e6, friction},
                       {"backfill", 1600.0, 0.1e9, 0.042e9, 0.0, 0.02e6, loose}});
}

}  // namespace voussoir
