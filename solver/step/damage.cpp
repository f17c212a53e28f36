#include "solver/step/damage.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "solver/contact/jump.h"

namespace voussoir {

namespace {

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

Component component_of(const Assembly& assembly, std::int64_t block) {
  return assembly.blocks[std::size_t(block)].component;
}

}  // namespace

std::string joint_family(Component a, Component b) {
  const auto [first, second] = std::minmax(a, b);
  const std::string& name = component_names()[std::size_t(first)];
  return first == second ? name : name + "-" + component_names()[std::size_t(second)];
}

std::vector<std::string> bonded_families(const Assembly& assembly) {
  std::set<std::tuple<bool, Component, Component>> bonded;
  for (const Joint& joint : assembly.joints) {
    if (!has_bond(law_constants(assembly.laws[std::size_t(joint.law)]))) continue;
    const auto [a, b] = std::minmax({component_of(assembly, joint.a), component_of(assembly, joint.b)});
    bonded.insert({a != b, a, b});
  }
  std::vector<std::string> families;
  for (const auto& [apart, a, b] : bonded) families.push_back(joint_family(a, b));
  return families;
}

LostBonds::LostBonds(const Assembly& assembly, const Model& model) : bonds_(assembly.joints.size()) {
  const std::vector<std::string> families = bonded_families(assembly);
  bonded_.assign(families.size(), 0.0);
  lost_.assign(model.tiles.size(), bonded_);
  for (std::size_t j = 0; j < bonds_.size(); ++j) {
    const Joint& joint = assembly.joints[j];
    if (!has_bond(model.laws[std::size_t(joint.law)])) continue;
    const std::string family = joint_family(component_of(assembly, joint.a), component_of(assembly, joint.b));
    bonds_[j] = {joint.area, std::size_t(std::find(families.begin(), families.end(), family) - families.begin())};
    bonded_[bonds_[j].of] += joint.area;
  }
}

void LostBonds::count(const Model& model, const State& state, std::size_t tile) {
  std::vector<double>& lost = lost_[tile];
  std::fill(lost.begin(), lost.end(), 0.0);
  for (auto i = std::size_t(model.tiles[tile].first_joint); i < std::size_t(model.tiles[tile].end_joint); ++i) {
    if (!(state.joint.mode[i] & (mode_gone | mode_points | mode_broken))) continue;
    const Bond& bond = bonds_[std::size_t(model.joint_of_patch[i])];
    if (bond.area == 0.0) continue;
    lost[bond.of] += bond.area * broken_share(model, state, i);
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
