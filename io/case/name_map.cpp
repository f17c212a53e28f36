#include "io/case/name_map.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "io/case/degrees.h"
#include "io/case/material_table.h"
#include "io/toml/table_reader.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"

namespace voussoir {

namespace {

/// The texts for which the stars of a pattern stand, each as short as possible from the left; nothing if the name does
/// not fit.
std::optional<std::vector<std::string>> stars_of(std::string_view name, std::string_view pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) {
    if (name != pattern) return std::nullopt;
    return std::vector<std::string>{};
  }
  if (!name.starts_with(pattern.substr(0, star))) return std::nullopt;
  // It is enough to look for the first occurrence of the text up to the next star (greedy matching of patterns without
  // alternatives), so no backtracking is needed.
  const std::string_view rest = pattern.substr(star + 1);
  if (rest.find('*') == std::string_view::npos) {
    if (name.size() < star + rest.size() || !name.ends_with(rest)) return std::nullopt;
    return std::vector<std::string>{std::string(name.substr(star, name.size() - rest.size() - star))};
  }
  const std::string_view piece = rest.substr(0, rest.find('*'));
  const std::size_t at = name.find(piece, star);
  if (at == std::string_view::npos) return std::nullopt;
  auto more = stars_of(name.substr(at), rest);
  if (more) more->insert(more->begin(), std::string(name.substr(star, at - star)));
  return more;
}

std::string filled_in(const std::string& text, const std::vector<std::string>& stars) {
  std::string out;
  std::size_t next = 0;
  for (const char c : text) {
    if (c == '*')
      out += stars[next++];
    else
      out += c;
  }
  return out;
}

void check_group_name(const TableReader& row, const std::string& name) {
  if (name.empty() || name.find('/') != std::string::npos)
    row.fail("group",
             fmt::format("is \"{}\". The name of a group must not be empty and must not contain '/'.", shown(name)));
}

NameRow read_row(TableReader row, const std::string& pattern, bool layer) {
  NameRow out;
  out.pattern = pattern;
  out.layer = layer;
  if (row.has("component")) out.component = Component(row.required_word("component", component_names()));
  if (row.has("part")) out.part = std::int32_t(row.integer("part", 0, 0, 1000000));
  if (row.has("material")) out.material = row.required_text("material");
  if (row.has("group")) out.groups = row.texts("group");
  for (const std::string& name : out.groups) check_group_name(row, name);
  if (row.has("fixed")) out.fixed = row.flag("fixed", false);
  if (row.has("block")) out.block = row.required_text("block");
  if (row.has("not_convex")) out.not_convex = NotConvex(row.required_word("not_convex", not_convex_words()));
  const auto stars = [](const std::string& text) { return std::count(text.begin(), text.end(), '*'); };
  if (out.block && (out.block->empty() || stars(*out.block) > stars(pattern)))
    row.fail("block", fmt::format("is \"{}\". Name the stone, with at most as many * as \"{}\" has.", shown(*out.block),
                                  shown(pattern)));
  row.finish();
  return out;
}

void read_rows(TableReader& root, const std::string& key, bool layer, NameMap& map) {
  auto table = root.table(key, "[" + key + "]");
  if (!table) return;
  for (const std::string& pattern : table->keys())
    map.rows.push_back(
        read_row(table->member(pattern, fmt::format("[{}] \"{}\"", key, shown(pattern))), pattern, layer));
}

void add_to(NameRow& whole, const NameRow& row) {
  const auto take = [](auto& to, const auto& from) {
    if (from) to = from;
  };
  take(whole.component, row.component);
  take(whole.part, row.part);
  take(whole.material, row.material);
  take(whole.fixed, row.fixed);
  take(whole.not_convex, row.not_convex);
  for (const std::string& group : row.groups)
    if (std::find(whole.groups.begin(), whole.groups.end(), group) == whole.groups.end()) whole.groups.push_back(group);
}

std::string row_text(const NameRow& row) {
  std::vector<std::string> entries;
  const auto add = [&](const char* key, const std::string& value) {
    entries.push_back(fmt::format("{} = {}", key, value));
  };
  if (row.component) add("component", quoted(component_names()[std::size_t(*row.component)]));
  if (row.part) add("part", fmt::format("{}", *row.part));
  if (row.material) add("material", quoted(*row.material));
  std::vector<std::string> groups;
  for (const std::string& group : row.groups) groups.push_back(quoted(group));
  if (groups.size() == 1) add("group", groups[0]);
  if (groups.size() > 1) add("group", fmt::format("[{}]", fmt::join(groups, ", ")));
  if (row.fixed) add("fixed", *row.fixed ? "true" : "false");
  if (row.block) add("block", quoted(*row.block));
  if (row.not_convex) add("not_convex", quoted(not_convex_words()[std::size_t(*row.not_convex)]));
  return fmt::format("{} = {{{}}}\n", quoted(row.pattern), fmt::join(entries, ", "));
}

}  // namespace

const std::vector<std::string>& not_convex_words() {
  static const std::vector<std::string> words = {"refuse", "hull", "cut"};
  return words;
}

bool fits_pattern(std::string_view name, std::string_view pattern) {
  return stars_of(name, pattern).has_value();
}

NameMap read_name_map(const std::string& path, const Material& usual) {
  const toml::table text = parse_toml(read_text(path), path);
  TableReader root(text, path, "the file");
  NameMap map;
  map.path = path;
  map.object_groups = root.flag("object_groups", true);
  read_rows(root, "layers", true, map);
  read_rows(root, "names", false, map);
  if (auto tables = root.table("materials", "[materials]"))
    for (const std::string& name : tables->keys()) {
      Material& own = map.materials.emplace_back(usual);
      own.name = name;
      TableReader table = tables->member(name, fmt::format("[materials.{}]", shown(name)));
      read_material(table, own);
    }
  root.finish();
  if (map.rows.empty())
    root.missing("names", "a table [names] with rows such as \"arch*\" = {component = \"arch\", part = 0}");
  return map;
}

std::string text_of(const NameMap& map) {
  std::string out = "# For voussoir import --map: the meaning of the objects of a drawing.\n";
  if (!map.object_groups) out += "object_groups = false\n";
  for (const bool layer : {true, false}) {
    const auto is_it = [&](const NameRow& row) { return row.layer == layer; };
    if (std::none_of(map.rows.begin(), map.rows.end(), is_it)) continue;
    out += layer ? "\n[layers]\n" : "\n[names]\n";
    for (const NameRow& row : map.rows)
      if (is_it(row)) out += row_text(row);
  }
  for (const Material& m : map.materials) {
    out += fmt::format("\n[materials.{}]\n", quoted(m.name));
    for (const auto& [key, value] : {std::pair{"density", m.density},
                                     {"youngs_modulus", m.youngs_modulus},
                                     {"shear_modulus", m.shear_modulus},
                                     {"tensile_strength", m.tensile_strength},
                                     {"cohesion", m.cohesion}})
      if (value > 0.0 || !std::string_view(key).ends_with("modulus"))  // which must be above 0 where it is given
        out += fmt::format("{} = {}\n", key, number_text(value));
    out += fmt::format("friction_angle = {}\n", degrees_text(m.friction_angle));
    out += fmt::format("dilation_angle = {}\n", degrees_text(m.dilation_angle));
  }
  return out;
}

NameRow meaning_of(const NameMap& map, const std::string& name, const std::string& layer, std::vector<bool>& used) {
  NameRow whole;
  for (std::size_t i = 0; i < map.rows.size(); ++i) {
    const NameRow& row = map.rows[i];
    const auto stars = stars_of(row.layer ? layer : name, row.pattern);
    if (!stars) continue;
    used[i] = true;
    whole.pattern = row.pattern;  // not empty: some row fits
    add_to(whole, row);
    if (row.block) whole.block = filled_in(*row.block, *stars);
  }
  return whole;
}

}  // namespace voussoir
