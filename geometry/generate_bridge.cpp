// bridge: any number of spans of any shape on abutments and piers.
#include "geometry/generate_bridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/generate.h"
#include "geometry/masonry_build.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// Throws InputError for keys that contradict one another.
void check_bridge(const Bridge& bridge, const GeneratorInput& in) {
  const auto at_most = [](double low, const std::string& small, double high, const std::string& large) {
    if (low > high + 1e-9)
      throw InputError("[bridge] {} = {:g} m is larger than {} = {:g} m. Make the first smaller or the second larger.",
                       small, low, large, high);
  };
  const double lowest = std::min(bridge.deck_at(0.0), bridge.deck_at(bridge.length()));
  if (bridge.backing_line.empty())
    at_most(in("backing_height"), "backing_height", lowest - bridge.springing, "springing to deck");
  for (const Vec3& p : bridge.backing_line)
    at_most(p.z() - bridge.springing, "z of [bridge.backing] profile", bridge.deck_at(p.x()) - bridge.springing,
            "springing to deck there");
  if (lowest < bridge.springing + 0.1)
    throw InputError("[bridge] gradient = {:g} % brings the deck {:g} m below the springing. Make it smaller.",
                     in("gradient"), bridge.springing - lowest);
  const double surfacing = in("surfacing_depth");
  at_most(surfacing, "surfacing_depth", lowest - bridge.springing, "springing to deck");
  if (surfacing > 0.0 && bridge.gradient != 0.0 && bridge.deformable_backfill)
    throw InputError(
        "[bridge] surfacing_depth = {:g} m with backfill = \"deformable\" needs a level deck, but gradient = {:g} %. "
        "Choose backfill = \"rigid\", or set one of the two values to 0.",
        surfacing, in("gradient"));
  if (!bridge.strip) {
    const double inside = 0.9 * in("width");
    at_most(2.0 * in("spandrel_thickness_bottom"), "2 spandrel_thickness_bottom", inside, "0.9 width");
    at_most(2.0 * in("spandrel_thickness_top"), "2 spandrel_thickness_top", inside, "0.9 width");
    at_most(in("parapet_height") > 0.0 ? in("parapet_thickness") : 0.0, "parapet_thickness",
            in("spandrel_thickness_top"), "spandrel_thickness_top");
  }
  for (std::size_t i = 0; i < bridge.supports.size(); ++i) {
    const Support& support = bridge.supports[i];
    const std::string heading = support_heading(i, bridge.vaults.size());
    const double backing = least_backing(bridge, support.x0, support.x1);
    if (support.top > backing + 1e-9)
      throw InputError("{} = {:g} m is below the feet of the vaults on {}. At least {:g} m are needed.",
                       bridge.backing_line.empty() ? "[bridge] backing_height" : "[bridge.backing] profile: z",
                       backing - bridge.springing, heading, support.top - bridge.springing);
    const double wall = bridge.transverse_thickness, least = support.x1 - support.x0;
    if (!bridge.is_abutment(i)) at_most(wall, "transverse_walls", least, "the thickness of " + heading);
    if (support.makeup != Makeup::solid)
      for (const char* key : {"leaf_thickness_even", "leaf_thickness_odd"})
        at_most(2.0 * in(key), std::string("2 ") + key, 0.95 * std::min(support.leaf_beside_span, bridge.width),
                "0.95 times the smaller of width and the length of " + heading);
  }
}

/// The stiffnesses of the components whose keys are given.
std::map<Component, Stiffness> given_table(const JointRules& rules, const GeneratorInput& in) {
  std::map<Component, Stiffness> table;
  for (const auto& [component, size] : rules.nominal) {
    const std::string row = component == Component::arch                                       ? "vault"
                            : component == Component::infill                                   ? "infill"
                            : component == Component::pier || component == Component::abutment ? "support"
                                                                                               : "wall";
    const double kn = in("kn_" + row), ks = in("ks_" + row);
    if ((kn > 0.0) != (ks > 0.0))
      throw InputError(
          "[bridge] kn_{0} = {1:g} and ks_{0} = {2:g} Pa/m. Give both, or neither; then they follow from the moduli.",
          row, kn, ks);
    if (kn > 0.0) table[component] = {kn / in("block_scale"), ks / in("block_scale")};
  }
  return table;
}

/// The materials that vaults and supports name.
void find_named_materials(Bridge& bridge, const std::vector<Material>& materials, const GeneratorInput& in) {
  const auto named = [&](const std::string& prefix) {
    const std::string& name = in.choices.at(prefix + "material");
    const auto found =
        std::find_if(materials.begin(), materials.end(), [&](const Material& m) { return m.name == name; });
    return std::int32_t(found - materials.begin());
  };
  for (std::size_t i = 0; i < bridge.vaults.size(); ++i) bridge.vaults[i].material = named(span_prefix(i));
  for (std::size_t i = 0; i < bridge.supports.size(); ++i)
    bridge.supports[i].material = named(support_prefix(in, i, bridge.vaults.size()));
}

/// The materials, without that of the surfacing if there is none.
std::vector<Material> used_materials(const std::vector<Material>& defaults, const GeneratorInput& in) {
  std::vector<Material> materials = in_order(defaults, in);
  const auto names_it = [](const auto& choice) {
    return choice.first.ends_with("material") && choice.second == "surfacing";
  };
  if (in("surfacing_depth") <= 0.0 && std::none_of(in.choices.begin(), in.choices.end(), names_it))
    std::erase_if(materials, [](const Material& m) { return m.name == "surfacing"; });
  return materials;
}

Assembly build(const std::vector<Material>& defaults, const GeneratorInput& in) {
  Bridge bridge = read_any_bridge(in);
  check_bridge(bridge, in);
  const std::vector<Material> materials = used_materials(defaults, in);
  find_materials(bridge, materials);
  find_named_materials(bridge, materials, in);
  JointRules rules = joint_rules(bridge, in);
  rules.rings_bonded = in.choices.at("ring_bond") == "mortar";
  rules.table = given_table(rules, in);
  rules.rows_from_moduli = true;
  if (in.choices.at("stiffness") == "table") rules.kind = JointRules::Kind::table;
  return lay_bridge(bridge, materials, rules, in);
}

}  // namespace

Generator bridge_generator() {
  const double friction = radians(30.0), loose = radians(35.0);
  Generator generator;
  generator.name = "bridge";
  generator.help = "Bridge with any number of spans of any shape, on abutments and piers";
  generator.parameters = any_bridge_keys();
  generator.choices = any_bridge_choices();
  generator.tables = any_bridge_tables();
  generator.materials = {{"masonry", 1900.0, 3.0e9, 1.2e9, 0.10e6, 0.15e6, friction},
                         {"vault", 1900.0, 4.0e9, 1.6e9, 0.10e6, 0.15e6, friction},
                         {"infill", 1700.0, 0.8e9, 0.32e9, 0.0, 0.02e6, loose},
                         {"backfill", 1800.0, 0.1e9, 0.04e9, 0.0, 0.01e6, loose},
                         // As heavy as asphalt; stiff and strong as a compacted granular base, whose moduli are 0.2 to
                         // 0.4 GPa (asphalt itself creeps, and is thin).
                         {"surfacing", 2200.0, 0.3e9, 0.12e9, 0.0, 0.02e6, radians(40.0)}};
  generator.fill_space = [](const GeneratorInput& in) { return fill_space(read_any_bridge(in)); };
  generator.build = [materials = generator.materials](const GeneratorInput& in) { return build(materials, in); };
  return generator;
}

}  // namespace voussoir
