#include "tools/campaign/template.h"

#include <algorithm>
#include <sstream>

#include "geometry/generator.h"
#include "io/case/sections.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir::campaign {

namespace {

std::vector<std::string> parts_of(const std::string& key) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// Place in a list that counts from 1; −1: none.
std::ptrdiff_t place_in(const toml::array& list, const std::string& part) {
  if (part.empty() || part.size() > 6 || !std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; }))
    return -1;
  const long place = std::stol(part);
  return place >= 1 && std::size_t(place) <= list.size() ? place - 1 : -1;
}

const toml::node* child(const toml::node& node, const std::string& part) {
  if (const toml::table* table = node.as_table()) return table->get(part);
  if (const toml::array* list = node.as_array())
    if (const std::ptrdiff_t place = place_in(*list, part); place >= 0) return list->get(std::size_t(place));
  return nullptr;
}

void collect_numbers(const toml::node& node, const std::string& key, std::vector<std::string>& found) {
  if (node.is_floating_point()) found.push_back(key);
  const std::string prefix = key.empty() ? "" : key + ".";
  if (const toml::table* table = node.as_table())
    for (const auto& [name, member] : *table) collect_numbers(member, prefix + std::string(name.str()), found);
  if (const toml::array* list = node.as_array())
    for (std::size_t i = 0; i < list->size(); ++i)
      collect_numbers(*list->get(i), prefix + std::to_string(i + 1), found);
}

}  // namespace

toml::table written_out(const Case& c) {
  toml::table table = parse_toml(c.text, c.path);
  if (!c.generator.empty() && !find_generator(c.generator).tables.empty())
    table.insert_or_assign("bridge", *parse_toml(resolved_text(c), c.path)["bridge"].as_table());
  return table;
}

toml::table portable(const Case& c) {
  toml::table table = written_out(c);
  table.erase("check");
  if (!c.assembly_file.empty()) table["bridge"].as_table()->insert_or_assign("assembly", "assembly.h5");
  for (std::size_t i = 0; i < c.motions.size(); ++i) {
    if (c.motions[i].kind != MotionSource::Kind::record) continue;
    toml::array names;
    for (int axis = 0; axis < 3; ++axis)
      names.push_back(c.motions[i].files[std::size_t(axis)].empty() ? std::string() : motion_file_name(i, axis));
    table["stage"][i].as_table()->insert_or_assign("record", names);
  }
  for (std::size_t i = 0; i < c.plots.size(); ++i)
    for (std::size_t k = 0; k < c.plots[i].measured.size(); ++k)
      if (!c.plots[i].measured[k].text.empty())
        table["plot"][i]["measured"][k].as_table()->insert_or_assign("file", measured_file_name(i, k));
  return table;
}

double number_at(const Case& c, const std::string& key) {
  const toml::table resolved = parse_toml(resolved_text(c), c.path);
  const toml::node* node = &resolved;
  for (const std::string& part : parts_of(key))
    if (node) node = child(*node, part);
  if (!node || !node->is_number()) {
    std::vector<std::string> known;
    collect_numbers(resolved, "", known);
    const std::string near = nearest_word(key, known);
    throw InputError(
        "'{}' is not a number of {}{}", key, c.path,
        near.empty() ? ". Give a key with its tables, such as damping.ratio" : ": did you mean '" + near + "'?");
  }
  if (node->is_integer())
    throw InputError("'{}' of {} is a whole number. A campaign cannot change whole numbers", key, c.path);
  return *node->value<double>();
}

void set_number(toml::table& table, const std::string& key, double value) {
  const std::vector<std::string> parts = parts_of(key);
  toml::node* node = &table;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    if (toml::table* here = node->as_table(); here && !here->contains(parts[i])) here->insert(parts[i], toml::table{});
    node = const_cast<toml::node*>(child(*node, parts[i]));
    if (!node) throw InputError("'{}' does not exist: '{}' is not a table", key, parts[i]);
  }
  if (toml::table* here = node->as_table()) {
    here->insert_or_assign(parts.back(), value);
  } else if (toml::array* list = node->as_array()) {
    const std::ptrdiff_t place = place_in(*list, parts.back());
    if (place < 0)
      throw InputError("'{}' does not exist: the list has {}, counted from 1", key,
                       counted(list->size(), "entry", "entries"));
    list->replace(list->begin() + place, value);
  } else {
    throw InputError("'{}' does not exist", key);
  }
}

std::string text_of(const toml::table& table) {
  std::ostringstream text;
  text << table << "\n";
  return text.str();
}

std::size_t motion_stage(const Case& c) {
  std::size_t found = c.settings.stages.size();
  int count = 0;
  for (std::size_t i = 0; i < c.settings.stages.size(); ++i)
    if (c.settings.stages[i].kind == StageSettings::Kind::motion) found = i, ++count;
  if (count != 1)
    throw InputError("{} has {}. A campaign needs exactly one: it receives the records, and its own motion is ignored",
                     c.path, counted(count, "motion stage"));
  return found;
}

}  // namespace voussoir::campaign
