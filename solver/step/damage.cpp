#include "solver/step/damage.h"

#include <algorithm>
#include <array>

#include "solver/contact/jump.h"

namespace voussoir {

namespace {

constexpr std::size_t most_components = 32;

/// Share of a patch's area whose bond is lost.
double broken_share(const Model& model, const State& state, std::size_t i) {
  const auto mode = state.joint.mode[i];
  if (mode & mode_gone) return 1.0;
  if (!(mode & mode_points)) return mode & mode_broken ? 1.0 : 0.0;
  const Patch& p = model.joints[i];
  double area = 0.0, broken = 0.0;
  for (int k = 0; k < p.point_count; ++k) {
    const double weight = patch_point(p, model.points, k).weight;
    area += weight;
    if (state.joint.broken[point_index(p, k, 1, 0)]) broken += weight;
  }
  return broken / area;
}

}  // namespace

bool has_bond(const LawConstants& law) {
  return law.kind == JointLaw::Kind::elastic || law.tension > 0.0 || law.cohesion > law.residual_cohesion;
}

std::vector<Component> bonded_components(const Assembly& assembly) {
  std::array<bool, most_components> bonded = {};
  for (const Joint& joint : assembly.joints)
    if (has_bond(law_constants(assembly.laws[std::size_t(joint.law)])))
      for (const std::int64_t block : {joint.a, joint.b})
        bonded[std::size_t(assembly.blocks[std::size_t(block)].component)] = true;
  std::vector<Component> components;
  for (std::size_t c = 0; c < component_names().size(); ++c)
    if (bonded[c]) components.push_back(Component(c));
  return components;
}

std::vector<double> broken_shares(const Assembly& assembly, const Model& model, const State& state,
                                  const std::vector<Component>& components) {
  std::vector<double> lost(assembly.joints.size(), 0.0);
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    if (has_bond(model.laws[std::size_t(model.joints[i].law)]))
      lost[std::size_t(model.joint_of_patch[i])] = broken_share(model, state, i);
  std::array<double, most_components> bonded = {}, broken = {};
  for (std::size_t j = 0; j < lost.size(); ++j) {
    const Joint& joint = assembly.joints[j];
    if (!has_bond(model.laws[std::size_t(joint.law)])) continue;
    for (const std::int64_t block : {joint.a, joint.b}) {
      const auto c = std::size_t(assembly.blocks[std::size_t(block)].component);
      bonded[c] += joint.area, broken[c] += joint.area * lost[j];
    }
  }
  std::vector<double> shares;
  for (const Component c : components)
    shares.push_back(bonded[std::size_t(c)] > 0.0 ? broken[std::size_t(c)] / bonded[std::size_t(c)] : 0.0);
  return shares;
}

}  // namespace voussoir
