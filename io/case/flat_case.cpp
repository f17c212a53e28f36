#include "io/case/flat_case.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "io/toml/table_reader.h"

namespace voussoir {

namespace {

using Flat = std::map<std::string, std::string>;

void add_flat(const toml::node& node, const std::string& key, Flat& flat) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [name, inner] : *table)
      add_flat(inner, key.empty() ? std::string(name.str()) : key + "." + std::string(name.str()), flat);
  } else if (const toml::array* list = node.as_array(); list && list->is_array_of_tables()) {
    for (std::size_t i = 0; i < list->size(); ++i) add_flat((*list)[i], fmt::format("{}[{}]", key, i + 1), flat);
  } else {
    std::ostringstream text;
    node.visit([&](const auto& value) { text << value; });
    flat[key] = text.str();
  }
}

}  // namespace

Flat flat_case(const std::string& text, const std::string& path) {
  Flat flat;
  add_flat(parse_toml(text, path), "", flat);
  return flat;
}

}  // namespace voussoir
