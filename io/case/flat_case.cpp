#include "io/case/flat_case.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "io/toml/table_reader.h"

namespace voussoir {

namespace {

using Flat = std::map<std::string, std::string>;

/// Numbers with the fewest digits that give them back: 7.2, not 7.2000000000000002.
std::string value_text(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  std::string text;
  if (const toml::array* list = node.as_array()) {
    for (const toml::node& item : *list) text += (text.empty() ? "" : ", ") + value_text(item);
    return "[" + text + "]";
  }
  std::ostringstream stream;
  node.visit([&](const auto& value) { stream << value; });
  return stream.str();
}

void add_flat(const toml::node& node, const std::string& key, Flat& flat) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [name, inner] : *table)
      add_flat(inner, key.empty() ? std::string(name.str()) : key + "." + std::string(name.str()), flat);
  } else if (const toml::array* list = node.as_array(); list && list->is_array_of_tables()) {
    for (std::size_t i = 0; i < list->size(); ++i) add_flat((*list)[i], fmt::format("{}[{}]", key, i + 1), flat);
  } else {
    flat[key] = value_text(node);
  }
}

}  // namespace

Flat flat_case(const std::string& text, const std::string& path) {
  Flat flat;
  add_flat(parse_toml(text, path), "", flat);
  return flat;
}

}  // namespace voussoir
