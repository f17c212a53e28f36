#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "solver/base/error.h"
#include "solver/base/suggestion.h"
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

const std::vector<Effect>& effects() {
  static const std::vector<Effect> list = {
      abutment_restraint(),      //
      foundation_flexibility(),  //
      scour(),                   //
      added_mass(),              //
      joint_softening(),         //
      stiffer_masonry(),         //
      fill_stiffness(),          //
      fill_interface(),          //
      spandrel_separation(),     //
      ring_separation(),         //
      tie_rods(),                //
      parapet_not_structural(),  //
      neighbouring_structure(),  //
      amplitude_stiffness(),     //
      damping_ratio(),           //
      support_motion(),          //
      sensor_fault(),            //
      calibration(),             //
      retrofit_ties(),           //
      grouted_infill(),          //
      bonded_joints(),
  };
  return list;
}

const Effect& find_effect(const std::string& name) {
  std::vector<std::string> names;
  for (const Effect& effect : effects()) {
    if (effect.name == name) return effect;
    names.push_back(effect.name);
  }
  throw InputError("unknown effect '{}'{}; the effects are: {}", name, suggestion(name, names), fmt::join(names, ", "));
}

namespace {

std::vector<double> values_of(const Effect& effect, const EffectSetting& setting) {
  std::vector<double> values;
  for (const EffectParameter& p : effect.parameters) values.push_back(setting.values.at(p.name));
  return values;
}

}  // namespace

std::string EffectSetting::text() const {
  std::string text = name + " " + where;
  for (const auto& [parameter, value] : values) text += fmt::format(" {}={}", parameter, value);
  return text;
}

void complete(EffectSetting& setting) {
  const Effect& effect = find_effect(setting.name);
  std::vector<std::string> names;
  for (const EffectParameter& p : effect.parameters) names.push_back(p.name);
  for (const auto& [name, value] : setting.values)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError("effect {}: unknown parameter '{}'{}; its parameters are: {}", effect.name, name,
                       suggestion(name, names), fmt::join(names, ", "));
  for (const EffectParameter& p : effect.parameters) {
    const double value = setting.values.emplace(p.name, p.usual).first->second;
    if (!(value >= p.low && value <= p.high))
      throw InputError("effect {}: {} is {:g}. It must be from {:g} to {:g} {}.", effect.name, p.name, value, p.low,
                       p.high, p.unit);
  }
}

void apply_effect(Assembly& assembly, const EffectSetting& setting) {
  const Effect& effect = find_effect(setting.name);
  if (effect.apply_to_sensors) return;  // once they are attached
  const std::vector<std::string> places = effect.places(assembly);
  if (places.empty()) throw InputError("effect {} cannot act anywhere in this assembly ({})", effect.name, effect.help);
  const std::string where = setting.where.empty() && places.size() == 1 ? places[0] : setting.where;
  if (std::find(places.begin(), places.end(), where) == places.end())
    throw InputError("effect {} cannot act at '{}'{}; its places in this assembly are: {}", effect.name, where,
                     suggestion(where, places), fmt::join(places, ", "));
  if (!effect.apply) return;
  effect.apply(assembly, where, values_of(effect, setting));
  sort_joints(assembly);
  assembly.effects.push_back(setting.text());
}

void take_back_effects(Assembly& copy, const Assembly& assembly) {
  copy.materials = assembly.materials;
  copy.laws = assembly.laws;
  copy.groups = assembly.groups;
  copy.effects = assembly.effects;
  copy.blocks.resize(assembly.blocks.size());
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& from = assembly.blocks[i];
    Block& to = copy.blocks[i];
    to.component = from.component, to.part = from.part, to.material = from.material, to.fixed = from.fixed;
    to.mass = from.mass, to.centroid = from.centroid, to.inertia = from.inertia;
  }
  copy.joints = assembly.joints;
  copy.fill_joints = assembly.fill_joints;
  copy.fill.material = assembly.fill.material;
}

void apply_effect(std::vector<Sensor>& sensors, const EffectSetting& setting) {
  const Effect& effect = find_effect(setting.name);
  if (effect.apply_to_sensors) effect.apply_to_sensors(sensors, setting.where, values_of(effect, setting));
}

void apply_effect(SolverSettings& settings, const EffectSetting& setting) {
  const Effect& effect = find_effect(setting.name);
  if (effect.apply_to_settings) effect.apply_to_settings(settings, setting.where, values_of(effect, setting));
}

}  // namespace voussoir
