#include "tools/run/inventory.h"

#include <algorithm>
#include <map>

#include "solver/base/constants.h"
#include "solver/step/damage.h"

namespace voussoir {

namespace {

using nlohmann::json;

double degrees(double radians) {
  return radians * 180.0 / pi;
}

json materials_json(const Assembly& assembly) {
  std::vector<double> mass(assembly.materials.size(), 0.0);
  for (const Block& block : assembly.blocks) mass[std::size_t(block.material)] += block.mass;
  const FillMesh& fill = assembly.fill;
  for (std::size_t i = 0; i < fill.tets.size(); ++i) {
    const auto x = [&](std::size_t k) { return fill.nodes[std::size_t(fill.tets[i][k])]; };
    const double volume = (x(1) - x(0)).dot((x(2) - x(0)).cross(x(3) - x(0))) / 6.0;
    mass[std::size_t(fill.material[i])] += volume * assembly.materials[std::size_t(fill.material[i])].density;
  }
  json all = json::array();
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const Material& m = assembly.materials[i];
    if (mass[i] > 0.0)
      all.push_back({{"name", m.name},
                     {"mass", mass[i]},
                     {"density", m.density},
                     {"youngs_modulus", m.youngs_modulus},
                     {"shear_modulus", m.shear_modulus},
                     {"tensile_strength", m.tensile_strength},
                     {"cohesion", m.cohesion},
                     {"friction_angle", degrees(m.friction_angle)},
                     {"dilation_angle", degrees(m.dilation_angle)}});
  }
  return all;
}

/// The numbers of a joint law for the page. Numbers that a kind of law does not use are left out.
json law_json(const JointLaw& law, double area) {
  json one = {{"kind", joint_law_kinds()[std::size_t(law.kind)]}, {"area", area}};
  if (law.kind == JointLaw::Kind::elastic) return one;
  one["tension"] = law.tension, one["cohesion"] = law.cohesion, one["friction_angle"] = degrees(law.friction_angle);
  if (law.residual_cohesion > 0.0) one["residual_cohesion"] = law.residual_cohesion;
  if (law.residual_friction_angle != law.friction_angle)
    one["residual_friction_angle"] = degrees(law.residual_friction_angle);
  if (law.dilation_angle > 0.0) one["dilation_angle"] = degrees(law.dilation_angle);
  if (law.fracture_energy[0] > 0.0 || law.fracture_energy[1] > 0.0) one["fracture_energy"] = law.fracture_energy;
  if (law.compressive_strength > 0.0) one["compressive_strength"] = law.compressive_strength;
  return one;
}

struct JointFamily {
  std::int64_t count = 0;
  double area = 0.0, kn[2] = {1e300, 0.0}, ks[2] = {1e300, 0.0};
  std::map<std::int32_t, double> laws;  // area of each

  void add(double a, double normal, double shear, std::int32_t law) {
    ++count, area += a, laws[law] += a;
    kn[0] = std::min(kn[0], normal), kn[1] = std::max(kn[1], normal);
    ks[0] = std::min(ks[0], shear), ks[1] = std::max(ks[1], shear);
  }
};

json joints_json(const Assembly& assembly) {
  std::map<std::string, JointFamily> families;
  const auto component = [&](std::int64_t block) { return assembly.blocks[std::size_t(block)].component; };
  for (const Joint& j : assembly.joints)
    if (assembly.laws[std::size_t(j.law)].kind != JointLaw::Kind::tie)
      families[joint_family(component(j.a), component(j.b))].add(j.area, j.kn, j.ks, j.law);
  for (const FillJoint& j : assembly.fill_joints)
    families[component_names()[std::size_t(component(j.block))] + "-fill"].add(j.area, j.kn, j.ks, j.law);
  json all = json::array();
  for (const auto& [name, f] : families) {
    json laws = json::array();
    for (const auto& [law, area] : f.laws) laws.push_back(law_json(assembly.laws[std::size_t(law)], area));
    std::stable_sort(laws.begin(), laws.end(), [](const json& a, const json& b) { return a["area"] > b["area"]; });
    all.push_back({{"joints", name},
                   {"count", f.count},
                   {"area", f.area},
                   {"kn", {f.kn[0], f.kn[1]}},
                   {"ks", {f.ks[0], f.ks[1]}},
                   {"laws", laws}});
  }
  return all;
}

json supports_json(const Simulation& run, bool& each_once) {
  const Assembly& assembly = run.assembly();
  json all = json::array();
  std::vector<int> named(assembly.blocks.size(), 0);
  for (const std::string& group : run.held_groups()) {
    const std::vector<std::int64_t>& blocks = assembly.groups.at(group);
    for (const std::int64_t b : blocks) ++named[std::size_t(b)];
    all.push_back({{"group", group}, {"blocks", blocks.size()}});
  }
  std::int64_t others = 0;
  for (std::size_t i = 0; i < named.size(); ++i) others += assembly.blocks[i].fixed && named[i] == 0;
  each_once = others == 0 && std::ranges::all_of(named, [](int n) { return n <= 1; });
  if (others > 0) all.push_back({{"group", "without a name"}, {"blocks", others}});
  return all;
}

/// Weight of the blocks that are free to move, N.
json weight_json(const Model& model) {
  const double g = model.gravity.norm();
  double stones = 0.0, fill = 0.0;
  for (const Body& body : model.bodies)
    if (!body.fixed) stones += g * body.mass;
  for (const double mass : model.fill.mass) fill += g * mass;
  return {{"stones", stones}, {"fill", fill}};
}

}  // namespace

json inventory_json(const Simulation& run) {
  bool each_once = true;
  const json supports = supports_json(run, each_once);
  return {{"materials", materials_json(run.assembly())},
          {"joints", joints_json(run.assembly())},
          {"supports", supports},
          {"supports_each_once", each_once},
          {"weight", weight_json(run.model())}};
}

}  // namespace voussoir
