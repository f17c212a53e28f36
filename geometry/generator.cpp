#include "geometry/generator.h"

#include <algorithm>
#include <cmath>

#include "geometry/generate.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/suggestion.h"

namespace voussoir {

namespace {

/// The same generator with a build() that checks its input first.
Generator checked(Generator generator) {
  Generator keys = generator;
  keys.build = nullptr;
  generator.build = [keys, build = generator.build](const GeneratorInput& input) {
    check_input(keys, input);
    Assembly assembly = build(input);
    assembly.generator = keys.name;
    return assembly;
  };
  return generator;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void check_value(const Generator& generator, const Parameter& parameter, const GeneratorInput& input) {
  const auto found = input.values.find(parameter.name);
  if (found == input.values.end()) {
    throw InputError("generator \"{}\": \"{}\" has no value. Give one from {} to {} {} (default {}).", generator.name,
                     parameter.name, parameter.low, parameter.high, parameter.unit, parameter.value);
  }
  const double value = found->second;
  if (!(value >= parameter.low && value <= parameter.high)) {  // also catches NaN
    throw InputError("[bridge] {} = {} {}. For generator \"{}\" it must be from {} to {} {} ({}; default {}).",
                     parameter.name, value, parameter.unit, generator.name, parameter.low, parameter.high,
                     parameter.unit, parameter.help, parameter.value);
  }
  if (parameter.integer && value != std::floor(value)) {
    throw InputError("[bridge] {} = {}. It must be a whole number, such as {}.", parameter.name, value,
                     std::round(value));
  }
}

void check_choice(const Generator& generator, const Choice& choice, const GeneratorInput& input) {
  const auto found = input.choices.find(choice.name);
  const std::string word = found == input.choices.end() ? "" : found->second;
  if (choice.material) return;  // of check_named_materials()
  for (const std::string& known : choice.words) {
    if (word == known) return;
  }
  throw InputError("[bridge] {} = \"{}\". For generator \"{}\" it must be one of: {}", choice.name, word,
                   generator.name, joined(choice.words));
}

void check_names(const Generator& generator, const Keys& keys, const GeneratorInput& input) {
  std::vector<std::string> known;
  for (const Parameter& parameter : keys.parameters) known.push_back(parameter.name);
  for (const Choice& choice : keys.choices) known.push_back(choice.name);
  for (const Profile& profile : keys.profiles) known.push_back(profile.name);
  const auto check = [&](const std::string& name) {
    for (const std::string& k : known) {
      if (k == name) return;
    }
    throw InputError("[bridge] has the key \"{}\", which generator \"{}\" does not have. Its keys are: {}", name,
                     generator.name, joined(known));
  };
  for (const auto& [name, value] : input.values) check(name);
  for (const auto& [name, word] : input.choices) check(name);
  for (const auto& [name, line] : input.profiles) check(name);
}

void check_entries(const Generator& generator, const GeneratorInput& input) {
  for (const KeyTable& table : generator.tables) {
    if (!table.is_list()) continue;
    const auto found = input.entries.find(table.name);
    const std::size_t count = found == input.entries.end() ? 0 : found->second;
    if (count < table.least || count > table.most)
      throw InputError("[[bridge.{}]] is given {}. For generator \"{}\" it must be given {} to {} times.", table.name,
                       counted(count, "time"), generator.name, table.least, table.most);
  }
}

void check_material(const std::string& name, const Material& m) {
  const auto positive = [&](const char* key, double value) {
    if (!(value > 0.0)) {
      throw InputError("[materials.{}] {} = {}. It must be above 0.", name, key, value);
    }
  };
  positive("density", m.density);
  positive("youngs_modulus", m.youngs_modulus);
  positive("shear_modulus", m.shear_modulus);
  if (!(m.dilation_angle >= 0.0 && m.dilation_angle <= m.friction_angle)) {
    throw InputError(
        "[materials.{}] dilation_angle = {:g} degrees. It must be from 0 to the friction angle, {:g} degrees.", name,
        m.dilation_angle * 180.0 / pi, m.friction_angle * 180.0 / pi);
  }
}

void check_materials(const Generator& generator, const GeneratorInput& input) {
  for (const Material& material : generator.materials) {
    const auto found = input.materials.find(material.name);
    if (found == input.materials.end()) {
      throw InputError("generator \"{}\" needs the material \"{}\"; start from default_input()", generator.name,
                       material.name);
    }
    check_material(material.name, found->second);
  }
  check_named_materials(generator, input);
  for (const auto& [name, usual] : own_materials(generator, input)) check_material(name, input.materials.at(name));
}

}  // namespace

std::vector<Material> in_order(const std::vector<Material>& defaults, const GeneratorInput& input) {
  std::vector<Material> materials;
  for (const Material& material : defaults) {
    materials.push_back(input.materials.at(material.name));
    materials.back().name = material.name;
  }
  const auto is_default = [&](const std::string& name) {
    return std::any_of(defaults.begin(), defaults.end(), [&](const Material& m) { return m.name == name; });
  };
  for (const auto& [name, material] : input.materials) {
    if (is_default(name)) continue;
    materials.push_back(material);
    materials.back().name = name;
  }
  return materials;
}

const std::vector<Generator>& generators() {
  static const std::vector<Generator> all = {checked(cs1_generator()),        checked(cs2_generator()),
                                             checked(bridge_generator()),     checked(arch_generator()),
                                             checked(wall_generator()),       checked(column_generator()),
                                             checked(filled_arch_generator())};
  return all;
}

const Generator& find_generator(const std::string& name, const char* where) {
  std::vector<std::string> names;
  for (const Generator& generator : generators()) {
    if (generator.name == name) return generator;
    names.push_back(generator.name);
  }
  const std::string near = nearest_word(name, names);
  throw InputError("{} \"{}\": there is no generator of this name{}; the generators are: {}", where, name,
                   near.empty() ? near : fmt::format(", did you mean \"{}\"?", near), joined(names));
}

std::string KeyTable::heading() const {
  return is_list() ? "[[bridge." + name + "]]" : "[bridge." + name + "]";
}

std::string KeyTable::prefix(std::size_t entry) const {
  return is_list() ? fmt::format("{}.{}.", name, entry + 1) : name + ".";
}

Keys keys_of(const Generator& generator, const GeneratorInput& input) {
  Keys keys = {generator.parameters, generator.choices, {}};
  const auto add = [](auto& to, auto key, const std::string& prefix) {
    key.name = prefix + key.name;
    to.push_back(std::move(key));
  };
  for (const KeyTable& table : generator.tables) {
    const auto count = input.entries.find(table.name);
    const std::size_t entries = !table.is_list() ? 1 : count == input.entries.end() ? 0 : count->second;
    for (std::size_t i = 0; i < entries; ++i) {
      for (const Parameter& p : table.parameters) add(keys.parameters, p, table.prefix(i));
      for (const Choice& c : table.choices) add(keys.choices, c, table.prefix(i));
      for (const Profile& p : table.profiles) add(keys.profiles, p, table.prefix(i));
    }
  }
  return keys;
}

std::map<std::string, std::string> own_materials(const Generator& generator, const GeneratorInput& input) {
  std::map<std::string, std::string> own;
  for (const Choice& choice : keys_of(generator, input).choices) {
    const auto found = input.choices.find(choice.name);
    if (!choice.material || found == input.choices.end()) continue;
    const bool usual = std::any_of(generator.materials.begin(), generator.materials.end(),
                                   [&](const Material& m) { return m.name == found->second; });
    if (!usual) own.try_emplace(found->second, choice.words.front());
  }
  return own;
}

void check_named_materials(const Generator& generator, const GeneratorInput& input) {
  std::vector<std::string> known;
  for (const auto& [name, material] : input.materials) known.push_back(name);
  for (const Choice& choice : keys_of(generator, input).choices) {
    const auto found = input.choices.find(choice.name);
    if (!choice.material || found == input.choices.end() || input.materials.contains(found->second)) continue;
    throw InputError(
        "[bridge] {} = \"{}\": there is no material of this name; the materials are: {}. Name one of them, or give "
        "[materials.{}].",
        choice.name, found->second, joined(known), found->second);
  }
}

bool is_dimension(const Parameter& p) {
  static const std::vector<std::string> cuts = {"voussoir_",   "block_",    "fill_length", "fill_width",
                                                "fill_height", "fill_edge", "infill_",     "leaf_",
                                                "sliver_",     "base_",     "restraint_",  "strip_"};
  const std::string key = p.name.substr(p.name.rfind('.') + 1);
  const bool of_a_test = p.name.starts_with("beam.");
  return p.unit == "m" && !of_a_test &&
         std::none_of(cuts.begin(), cuts.end(), [&](auto& c) { return key.starts_with(c); });
}

GeneratorInput default_input(const Generator& generator) {
  GeneratorInput input;
  for (const KeyTable& table : generator.tables)
    if (table.is_list()) input.entries[table.name] = table.least;
  const Keys keys = keys_of(generator, input);
  for (const Parameter& parameter : keys.parameters) input.values[parameter.name] = parameter.value;
  for (const Choice& choice : keys.choices) input.choices[choice.name] = choice.words.front();
  for (const Material& material : generator.materials) input.materials[material.name] = material;
  return input;
}

void check_input(const Generator& generator, const GeneratorInput& input) {
  check_entries(generator, input);
  const Keys keys = keys_of(generator, input);
  check_names(generator, keys, input);
  for (const Parameter& parameter : keys.parameters) check_value(generator, parameter, input);
  for (const Choice& choice : keys.choices) check_choice(generator, choice, input);
  check_materials(generator, input);
  if (!(input.gap_tolerance > 0.0 && input.gap_tolerance < 0.01)) {
    throw InputError("gap_tolerance = {} m. It must be above 0 and below 0.01 m (default 1e-4).", input.gap_tolerance);
  }
}

namespace {

std::string key_rows(const std::vector<Parameter>& parameters, const std::vector<Choice>& choices,
                     const std::vector<Profile>& profiles) {
  std::string text = "| key | default | range | unit | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const Choice& choice : choices)
    text += fmt::format("| `{}` | \"{}\" | {} | | {} |\n", choice.name, choice.words.front(),
                        choice.material ? "the name of a material" : joined(choice.words), choice.help);
  for (const Parameter& p : parameters)
    text += fmt::format("| `{}` | {:g} | {:g} to {:g} | {} | {} |\n", p.name, p.value, p.low, p.high, p.unit, p.help);
  for (const Profile& p : profiles) text += fmt::format("| `{}` | none | [{}, …] | m | {} |\n", p.name, p.pair, p.help);
  return text;
}

}  // namespace

std::string describe(const Generator& generator) {
  std::string text = fmt::format("## {}\n\n{}\n\n", generator.name, generator.help) +
                     key_rows(generator.parameters, generator.choices, {});
  for (const KeyTable& table : generator.tables) {
    text += fmt::format("\n`{}`: {}\n\n", table.heading(), table.help) +
            key_rows(table.parameters, table.choices, table.profiles);
  }
  text +=
      "\n| material | density kg/m3 | E Pa | G Pa | ft Pa | c Pa | friction deg |\n| --- | --- | --- | --- | --- | --- "
      "| --- |\n";
  for (const Material& m : generator.materials) {
    text += fmt::format("| `{}` | {:g} | {:g} | {:g} | {:g} | {:g} | {:g} |\n", m.name, m.density, m.youngs_modulus,
                        m.shear_modulus, m.tensile_strength, m.cohesion, m.friction_angle * 180.0 / pi);
  }
  text +=
      "\nE and G are the moduli of a material. dc is the sum of the distances from the centroids of the two blocks to "
      "their joint, m. ft is the tensile strength and c the cohesion.\n";
  return text;
}

}  // namespace voussoir
