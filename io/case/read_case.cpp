#include <algorithm>
#include <filesystem>

#include "geometry/rings.h"
#include "io/case/case.h"
#include "io/case/checks.h"
#include "io/case/degrees.h"
#include "io/case/material_table.h"
#include "io/case/sections.h"
#include "solver/base/arrays.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"
#include "solver/model/laws.h"

namespace voussoir {

std::string relative_to(const std::string& beside, const std::string& name) {
  const std::filesystem::path path(name);
  if (path.is_absolute()) return name;
  return (std::filesystem::path(beside).parent_path() / path).string();
}

namespace {

/// Reads the keys of one table; keys that are not given keep their defaults.
void read_keys(TableReader& table, const Keys& keys, const std::string& prefix, GeneratorInput& input) {
  for (const Parameter& p : keys.parameters) {
    const double value = table.number(p.name, p.value, {p.low, p.high, p.unit});
    if (p.integer && value != std::floor(value))
      table.fail(p.name, fmt::format("is {}. It must be a whole number.", value));
    input.values[prefix + p.name] = value;
  }
  for (const Choice& choice : keys.choices)
    input.choices[prefix + choice.name] = choice.material ? table.text(choice.name, choice.words.front())
                                                          : choice.words[table.word(choice.name, choice.words, 0)];
  for (const Profile& profile : keys.profiles) {
    const Polygon list = profile.is_line ? table.profile(profile.name) : table.pairs(profile.name, profile.pair, 1);
    if (list.empty()) continue;
    input.profiles[prefix + profile.name] = list;
    for (const std::string& other : profile.instead_of)
      if (table.has(other))
        table.fail(
            profile.name,
            fmt::format("and '{}' are both given, but the first replaces the second: leave out one of them", other));
  }
}

/// [[bridge.NAME]]: each entry counts `repeat` times.
void read_entries(TableReader& bridge, const KeyTable& table, GeneratorInput& input) {
  if (!bridge.has(table.name)) return;
  std::size_t entries = 0;
  for (TableReader& entry : bridge.tables(table.name)) {
    const std::int64_t repeat = entry.integer("repeat", 1, 1, std::int64_t(table.most));
    for (std::int64_t i = 0; i < repeat; ++i, ++entries)
      read_keys(entry, {table.parameters, table.choices, table.profiles}, table.prefix(entries), input);
    entry.finish();
  }
  if (entries < table.least || entries > table.most)
    bridge.fail(table.name, fmt::format("is given {}. It must be given {} to {} times.", counted(entries, "time"),
                                        table.least, table.most));
  input.entries[table.name] = entries;
}

/// Lists, and tables that may be nested: [bridge.abutment.left].
void read_key_tables(TableReader& bridge, const Generator& generator, GeneratorInput& input) {
  std::map<std::string, TableReader> parents;
  for (const KeyTable& table : generator.tables) {
    if (table.is_list()) {
      read_entries(bridge, table, input);
      continue;
    }
    const std::size_t dot = table.name.find('.');
    const std::string outer = table.name.substr(0, dot);
    auto parent = parents.find(outer);
    if (parent == parents.end()) {
      std::optional<TableReader> reader = bridge.table(outer, fmt::format("[bridge.{}]", outer));
      if (!reader) continue;
      parent = parents.emplace(outer, std::move(*reader)).first;
    }
    const Keys keys = {table.parameters, table.choices, table.profiles};
    if (dot == std::string::npos) {
      read_keys(parent->second, keys, table.prefix(0), input);
    } else if (auto inner = parent->second.table(table.name.substr(dot + 1), fmt::format("[bridge.{}]", table.name))) {
      read_keys(*inner, keys, table.prefix(0), input);
      inner->finish();
    }
  }
  for (auto& [name, parent] : parents) parent.finish();
}

void read_generator(TableReader& bridge, Case& c) {
  c.generator = bridge.text("generator", "");
  std::vector<std::string> known;
  for (const Generator& g : generators()) known.push_back(g.name);
  if (std::find(known.begin(), known.end(), c.generator) == known.end())
    bridge.fail("generator", fmt::format("is \"{}\"{}", shown(c.generator), suggestion(c.generator, known)));

  const Generator& generator = find_generator(c.generator);
  c.generator_input = default_input(generator);
  read_keys(bridge, {generator.parameters, generator.choices, {}}, "", c.generator_input);
  read_key_tables(bridge, generator, c.generator_input);
  for (auto& [name, material] : c.generator_input.materials) {
    material.friction_angle = writable_angle(material.friction_angle);
    material.dilation_angle = writable_angle(material.dilation_angle);
  }
}

}  // namespace

void read_material(TableReader& table, Material& m) {
  m.density = table.number("density", m.density, {0.0, 1e5, "kg/m3", true});
  m.youngs_modulus = table.number("youngs_modulus", m.youngs_modulus, {0.0, 1e13, "Pa", true});
  m.shear_modulus = table.number("shear_modulus", m.shear_modulus, {0.0, 1e13, "Pa", true});
  m.tensile_strength = table.number("tensile_strength", m.tensile_strength, {0.0, 1e10, "Pa"});
  m.cohesion = table.number("cohesion", m.cohesion, {0.0, 1e10, "Pa"});
  if (table.has("friction_angle"))
    m.friction_angle = to_radians(table.number("friction_angle", 0.0, {0.0, 89.0, "degrees"}));
  if (table.has("dilation_angle"))
    m.dilation_angle = to_radians(table.number("dilation_angle", 0.0, {0.0, 89.0, "degrees"}));
  if (m.dilation_angle > m.friction_angle)
    table.fail("dilation_angle",
               fmt::format("is {} degrees. It must not be larger than the friction angle, {} degrees.",
                           degrees_text(m.dilation_angle), degrees_text(m.friction_angle)));
  table.finish();
}

namespace {

/// Splits "masonry-infill" at the hyphen that gives two known materials (names may contain hyphens).
std::array<std::string, 2> split_pair(const TableReader& joints, const std::string& key,
                                      const std::vector<std::string>& known) {
  std::array<std::string, 2> any;
  for (std::size_t at = key.find('-'); at != std::string::npos; at = key.find('-', at + 1)) {
    const std::array<std::string, 2> pair = {key.substr(0, at), key.substr(at + 1)};
    const auto is_known = [&](const std::string& name) {
      return std::find(known.begin(), known.end(), name) != known.end();
    };
    if (!pair[0].empty() && !pair[1].empty()) any = pair;
    if (is_known(pair[0]) && is_known(pair[1])) return pair;
  }
  if (any[0].empty())
    joints.fail(key, "must be two names of materials with a hyphen between them, such as \"masonry-infill\"");
  if (!known.empty())
    joints.fail(key,
                fmt::format("must be two materials of this bridge with a hyphen between them. The materials are: {}",
                            fmt::join(known, ", ")));
  return any;
}

const std::vector<std::string> composite_keys = {"compressive_strength", "compressive_energy",
                                                 "compressive_peak",     "cap_shear",
                                                 "dilation_length",      "dilation_pressure"};

/// The keys that only composite joints have.
void read_composite(TableReader& table, JointLaw& law) {
  if (law.kind != JointLaw::Kind::composite) {
    for (const std::string& key : composite_keys)
      if (table.has(key))
        table.fail(key, "is only for joints with kind = \"composite\": set that kind, or leave the key out");
    return;
  }
  law.dilation_length = table.number("dilation_length", 0.0, {0.0, 1.0, "m"});
  law.dilation_pressure = table.number("dilation_pressure", 0.0, {0.0, 1e10, "Pa"});
  if (law.dilation_angle > law.friction_angle || law.dilation_angle > law.residual_friction_angle)
    table.fail(
        "dilation_angle",
        fmt::format(
            "is {} degrees. With kind = \"composite\" it must not be larger than the friction angle, {} degrees, "
            "or the residual friction angle, {} degrees.",
            degrees_text(law.dilation_angle), degrees_text(law.friction_angle),
            degrees_text(law.residual_friction_angle)));
  if (!table.has("compressive_strength")) {
    for (const char* key : {"compressive_energy", "compressive_peak", "cap_shear"})
      if (table.has(key)) table.fail(key, "needs 'compressive_strength' in Pa; without it these joints never crush");
    return;
  }
  law.compressive_strength = table.number("compressive_strength", 0.0, {0.0, 1e13, "Pa", true});
  law.compressive_energy = table.required_number("compressive_energy", {0.0, 1e12, "J/m2", true});
  law.compressive_peak = table.number("compressive_peak", 0.0, {0.0, 1.0, "m"});
  law.cap_shear = table.number("cap_shear", law.cap_shear, {0.0, 1e3, "-"});
  const double begin = CrushingCurve::begin * law.compressive_strength;
  if (law.tension > begin)
    table.fail("compressive_strength",
               fmt::format("is {:g} Pa. The cap begins at a third of it, {:g} Pa, which is below the tensile strength, "
                           "{:g} Pa. Raise it to at least {:g} Pa, or lower 'tensile_strength'.",
                           law.compressive_strength, begin, law.tension, law.tension / CrushingCurve::begin));
}

/// Strength of a joint table. Keys that are not given have the lowest value of the materials; the default law is
/// brittle without residual cohesion.
JointLaw read_law(TableReader& table, const std::vector<Material>& materials) {
  JointLaw law;
  const bool known = !materials.empty();
  const auto weakest = [&](double Material::*member) {
    double least = known ? materials.front().*member : 0.0;
    for (const Material& m : materials) least = std::min(least, m.*member);
    return least;
  };
  const auto strength = [&](const char* key, double Material::*member) {
    if (!known && !table.has(key)) table.missing(key, "Pa; the assembly file does not state it");
    return table.number(key, weakest(member), {0.0, 1e10, "Pa"});
  };
  const auto angle = [&](const char* key, double fallback) {
    return table.has(key) ? to_radians(table.number(key, 0.0, {0.0, 89.0, "degrees"})) : fallback;
  };
  law.tension = strength("tensile_strength", &Material::tensile_strength);
  law.cohesion = strength("cohesion", &Material::cohesion);
  if (!known && !table.has("friction_angle"))
    table.missing("friction_angle", "degrees; the assembly file does not state it");
  law.friction_angle = angle("friction_angle", weakest(&Material::friction_angle));
  law.residual_cohesion = table.number("residual_cohesion", 0.0, {0.0, 1e10, "Pa"});
  law.residual_friction_angle = angle("residual_friction_angle", law.friction_angle);
  law.dilation_angle = angle("dilation_angle", 0.0);
  const bool softens = table.has("fracture_energy");
  std::vector<std::string> kinds = joint_law_kinds();
  constexpr auto tie = std::size_t(JointLaw::Kind::tie);
  kinds.erase(kinds.begin() + tie);  // it is no joint
  const std::size_t kind =
      table.word("kind", kinds, std::size_t(softens ? JointLaw::Kind::softening : JointLaw::Kind::brittle));
  law.kind = JointLaw::Kind(kind < tie ? kind : kind + 1);
  if (softens) {
    const auto energy = table.numbers("fracture_energy", 2, {0.0, 1e9, "J/m2"});
    law.fracture_energy = {energy[0], energy[1]};
  }
  const bool softening = law.kind == JointLaw::Kind::softening;
  if (softening && !(law.fracture_energy[0] > 0.0 && law.fracture_energy[1] > 0.0))
    table.fail("needs 'fracture_energy' = [GI, GII] in J/m2, both above 0, because kind is \"softening\"");
  const bool bonded = law.tension > 0.0 || law.cohesion > law.residual_cohesion;
  if (law.kind == JointLaw::Kind::composite && bonded &&
      !(law.fracture_energy[0] > 0.0 && law.fracture_energy[1] > 0.0))
    table.fail(
        "needs 'fracture_energy' = [GI, GII] in J/m2, both above 0, because kind is \"composite\" and its joints have "
        "a bond (tensile_strength, cohesion)");
  read_composite(table, law);
  return law;
}

/// The materials of the stones on both sides of the joints of a key: two, or those of the spans for the joints between
/// rings; empty for an assembly file.
std::vector<Material> materials_of(const Case& c, const std::string& key, const std::array<std::string, 2>& pair) {
  std::vector<std::string> names(pair.begin(), pair.end());
  if (key == ring_pair) {
    names.clear();
    for (const auto& [name, word] : c.generator_input.choices)
      if (name.starts_with("span.") && name.ends_with(".material")) names.push_back(word);
    if (names.empty()) names = {"vault"};
  }
  std::vector<Material> materials;
  for (const std::string& name : names) {
    const auto found = c.generator_input.materials.find(name);
    if (found == c.generator_input.materials.end()) return {};
    materials.push_back(found->second);
  }
  return materials;
}

void read_joint(TableReader& table, const std::vector<Material>& materials, GeneratorInput::JointOverride& joint) {
  joint.kn = table.number("kn", -1.0, {0.0, 1e15, "Pa/m", true});
  joint.ks = table.number("ks", -1.0, {0.0, 1e15, "Pa/m", true});
  for (const char* key : {"tensile_strength", "cohesion", "friction_angle", "residual_cohesion",
                          "residual_friction_angle", "dilation_angle", "kind", "fracture_energy"})
    joint.has_law = table.has(key) || joint.has_law;
  for (const std::string& key : composite_keys) joint.has_law = table.has(key) || joint.has_law;
  table.finish();
  if (joint.has_law) joint.law = read_law(table, materials);
}

}  // namespace

void read_bridge(TableReader& root, Case& c) {
  auto bridge = root.table("bridge", "[bridge]");
  if (!bridge) root.missing("bridge", "a table with the name of a generator or of an assembly file");
  const bool generated = bridge->has("generator"), read = bridge->has("assembly");
  if (generated && read) bridge->fail("has both 'generator' and 'assembly': keep one of them");
  if (!generated && !read) bridge->missing("generator", "the name of a generator, or 'assembly' = \"file.h5\"");
  if (generated) {
    read_generator(*bridge, c);
  } else {
    c.assembly_file = relative_to(c.path, bridge->text("assembly", ""));
    std::error_code ignored;  // a name that cannot be looked up names no file
    if (!std::filesystem::exists(c.assembly_file, ignored))
      bridge->fail("assembly", fmt::format("is {}, but there is no such file", shown(c.assembly_file, 300)));
  }
  bridge->finish();
}

namespace {

/// Reads the materials of the generator first, because the other materials take their missing values from them.
void read_material_tables(TableReader& materials, Case& c) {
  auto& known = c.generator_input.materials;
  std::vector<std::string> names;
  for (const auto& [name, material] : known) names.push_back(name);
  const auto own = own_materials(find_generator(c.generator), c.generator_input);
  for (const auto& [name, usual] : own) names.push_back(name);
  for (const std::string& name : materials.keys())
    if (!known.contains(name) && !own.contains(name))
      materials.fail(name, fmt::format("is not a material of \"{}\"{}", c.generator, suggestion(name, names)));
  const auto read = [&](const std::string& name, Material& material) {
    TableReader table = materials.member(name, fmt::format("[materials.{}]", shown(name)));
    read_material(table, material);
  };
  for (const std::string& name : materials.keys())
    if (!own.contains(name)) read(name, known.at(name));
  for (const std::string& name : materials.keys()) {
    if (!own.contains(name)) continue;
    Material material = known.at(own.at(name));
    material.name = name;
    read(name, material);
    known[name] = material;
  }
}

}  // namespace

void read_materials(TableReader& root, Case& c) {
  auto materials = root.table("materials", "[materials]");
  if (materials && c.generator.empty())
    materials->fail(
        "cannot change an assembly file, which has its own materials. Use [joints.A-B], or generate the assembly "
        "again.");
  if (materials) read_material_tables(*materials, c);
  if (c.generator.empty()) return;
  try {
    check_named_materials(find_generator(c.generator), c.generator_input);
  } catch (const InputError& error) {
    throw InputError("{}: {}", c.path, error.what());
  }
}

void read_joints(TableReader& root, Case& c) {
  auto joints = root.table("joints", "[joints]");
  if (!joints) return;
  std::vector<std::string> known;
  for (const auto& [name, material] : c.generator_input.materials) known.push_back(name);
  for (const std::string& key : joints->keys()) {
    TableReader table = joints->member(key, fmt::format("[joints.{}]", shown(key)));
    const auto pair = key == ring_pair ? std::array<std::string, 2>{} : split_pair(*joints, key, known);
    if (pair[0] != pair[1] && c.generator_input.joints.contains(pair[1] + "-" + pair[0]))
      joints->fail(key, fmt::format("repeats [joints.{}-{}]. Give each pair once.", pair[1], pair[0]));
    read_joint(table, materials_of(c, key, pair), c.generator_input.joints[key]);
  }
}

Case parse_case(const std::string& text, const std::string& path, CaseUse use) {
  Case c;
  c.path = path;
  c.text = text;
  const toml::table table = parse_toml(text, path);
  TableReader root(table, path, "the case");
  for (const auto read : {read_bridge, read_materials, read_joints, read_settings})
    root.attempt([&] { read(root, c); });
  root.attempt([&] { read_stages(root, c, use); });
  root.attempt([&] { check_amounts(root, c); });
  for (const auto read : {read_sensors, read_effects}) root.attempt([&] { read(root, c); });
  root.attempt([&] { read_checks(root); });  // a run does not use them, but errors are reported
  // Before modes, plots and limits, which change nothing in a run.
  if (root.fine()) root.attempt([&] { c.hash = hash_text(resolved_text(c)); });
  for (const auto read : {read_modal, read_plots, read_limits}) root.attempt([&] { read(root, c); });
  root.finish();
  for (const MotionSource& motion : c.motions)
    for (const std::string& record : motion.texts) c.hash = hash_bytes(record.data(), record.size(), c.hash);
  return c;
}

Case read_case(const std::string& path, CaseUse use) {
  return parse_case(read_text(path), path, use);
}

}  // namespace voussoir
