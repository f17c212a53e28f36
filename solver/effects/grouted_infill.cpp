// Grout in the loose infill of piers and abutments: the infill gets more tensile strength, cohesion, stiffness and
// weight.
#include <algorithm>

#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

BlockSet infill_of(const Assembly& assembly, const std::string& where) {
  BlockSet set = component(assembly, Component::infill);
  if (where == "all") return set;
  const BlockSet part = masonry_part(assembly, where);
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = set[i] && part[i];
  return set;
}

bool any(const BlockSet& set) {
  return std::find(set.begin(), set.end(), true) != set.end();
}

/// Masonry parts with infill in them.
std::vector<std::string> places_of_grouted_infill(const Assembly& assembly) {
  std::vector<std::string> names;
  for (const std::string& name : masonry_parts(assembly))
    if (any(infill_of(assembly, name))) names.push_back(name);
  return names;
}

/// The joints inside the infill and those with the masonry around it.
void apply_grouted_infill(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  const BlockSet infill = infill_of(assembly, where);
  const auto grouted = [&](const Joint& joint) { return infill[std::size_t(joint.a)] || infill[std::size_t(joint.b)]; };
  strengthen(assembly, grouted, values[0], values[1], values[2]);
  if (values[3] != 1.0) scale_density(assembly, infill, values[3]);
}

}  // namespace

Effect grouted_infill() {
  return {"grouted_infill",
          "the infill of piers and abutments is grouted",
          "",
          {{"tensile_strength", "Pa", "lower limit for its joints", 0.0, 1e7, 0.0, 1e5, 1e5},
           {"cohesion", "Pa", "lower limit for its joints", 0.0, 1e7, 0.0, 1.5e5, 1e5},
           {"stiffness_factor", "-", "factor on the stiffness of its joints", 1.0, 20.0, 1.0, 2.0, 0.5, true},
           {"density_factor", "-", "factor on its density", 1.0, 1.5, 1.0, 1.05, 0.05, true}},
          places_of_grouted_infill,
          apply_grouted_infill,
          nullptr,
          nullptr,
          0.0};
}

}  // namespace voussoir
