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

LostBonds::LostBonds(const Assembly& assembly, const Model& model) : bonds_(assembly.joints.size()) {
  const std::vector<Component> components = bonded_components(assembly);
  bonded_.assign(components.size(), 0.0);
  lost_.assign(model.tiles.size(), bonded_);
  const auto number = [&](std::int64_t block) {
    const Component component = assembly.blocks[std::size_t(block)].component;
    return std::uint8_t(std::find(components.begin(), components.end(), component) - components.begin());
  };
  for (std::size_t j = 0; j < bonds_.size(); ++j) {
    const Joint& joint = assembly.joints[j];
    if (!has_bond(model.laws[std::size_t(joint.law)])) continue;
    bonds_[j] = {joint.area, {number(joint.a), number(joint.b)}};
    for (const std::uint8_t c : bonds_[j].of) bonded_[c] += joint.area;
  }
}

void LostBonds::count(const Model& model, const State& state, std::size_t tile) {
  std::vector<double>& lost = lost_[tile];
  std::fill(lost.begin(), lost.end(), 0.0);
  for (auto i = std::size_t(model.tiles[tile].first_joint); i < std::size_t(model.tiles[tile].end_joint); ++i) {
    if (!(state.joint.mode[i] & (mode_gone | mode_points | mode_broken))) continue;
    const Bond& bond = bonds_[std::size_t(model.joint_of_patch[i])];
    if (bond.area == 0.0) continue;
    const double area = bond.area * broken_share(model, state, i);
    for (const std::uint8_t c : bond.of) lost[c] += area;
  }
}

std::vector<double> LostBonds::shares() const {
  std::vector<double> shares(bonded_.size(), 0.0);
  for (const std::vector<double>& lost : lost_)
    for (std::size_t c = 0; c < shares.size(); ++c) shares[c] += lost[c];
  for (std::size_t c = 0; c < shares.size(); ++c) shares[c] /= bonded_[c];
  return shares;
}

}  // namespace voussoir
