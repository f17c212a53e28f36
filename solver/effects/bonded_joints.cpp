// Repointed, injected or glued joints: the joints inside a part of the masonry get more tensile strength, cohesion and
// stiffness.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

/// The infill of a pier or abutment is unchanged: see grouted_infill.
void apply_bonded_joints(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  const BlockSet part = masonry_part(assembly, where), infill = component(assembly, Component::infill);
  const auto in = [&](std::int64_t block) { return part[std::size_t(block)] && !infill[std::size_t(block)]; };
  strengthen(
      assembly, [&](const Joint& joint) { return in(joint.a) && in(joint.b); }, values[0], values[1], values[2]);
}

}  // namespace

Effect bonded_joints() {
  return {"bonded_joints",
          "joints of a part are repointed, injected or glued",
          "",
          {{"tensile_strength", "Pa", "lower limit for its joints", 0.0, 1e7, 0.0, 2e5, 1e5},
           {"cohesion", "Pa", "lower limit for its joints", 0.0, 1e7, 0.0, 3e5, 1e5},
           {"stiffness_factor", "-", "factor on the stiffness of its joints", 1.0, 5.0, 1.0, 1.2, 0.2, true}},
          masonry_parts,
          apply_bonded_joints,
          nullptr,
          nullptr,
          0.0};
}

}  // namespace voussoir
