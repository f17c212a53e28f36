#include "io/case/checks.h"

#include <sstream>

#include "io/toml/table_reader.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// Tables are merged key by key, lists of tables of the same length table by table; all else is replaced.
void merge(toml::table& into, const toml::table& other) {
  for (const auto& [key, node] : other) {
    toml::node* mine = into.get(key.str());
    const toml::array *list = node.as_array(), *mine_list = mine ? mine->as_array() : nullptr;
    if (mine && mine->is_table() && node.is_table()) {
      merge(*mine->as_table(), *node.as_table());
    } else if (list && mine_list && list->size() == mine_list->size() && list->is_array_of_tables()) {
      for (std::size_t i = 0; i < list->size(); ++i)
        merge(*mine->as_array()->get(i)->as_table(), *list->get(i)->as_table());
    } else {
      into.insert_or_assign(key.str(), node);
    }
  }
}

}  // namespace

std::vector<Check> read_checks(TableReader& root) {
  std::vector<Check> checks;
  for (TableReader& table : root.tables("check")) {
    Check c;
    c.quantity = table.required_text("quantity");
    c.value = table.required_text("value");
    c.unit = table.text("unit", c.unit);
    c.source = table.required_text("source");
    c.expected = table.required_number("expected");
    if (table.has("within") == table.has("tolerance"))
      table.missing("tolerance", "a share of the expected value; or 'within', in the unit of the value; not both");
    c.absolute = table.has("within");
    c.tolerance = table.required_number(c.absolute ? "within" : "tolerance", {0.0, 1e300, ""});
    if (!c.absolute && c.expected == 0.0)
      table.fail("tolerance", "is a share of the expected value, which is 0. Give 'within' instead.");
    c.slow = table.flag("slow", false);
    if (table.has("miss") && (c.miss = table.required_text("miss")).empty())
      table.fail("miss", "is empty. State why the case is known to miss the expected value.");
    table.table("set", "set");
    table.finish();
    checks.push_back(c);
  }
  return checks;
}

std::vector<Check> read_checks(const std::string& path) {
  const toml::table file = parse_toml(read_text(path), path);
  TableReader root(file, path, "the case");
  std::vector<Check> checks = read_checks(root);
  root.keys();  // the other keys are those of the case
  root.finish();
  for (std::size_t i = 0; i < checks.size(); ++i) {
    toml::table merged = file;
    merged.erase("check");
    if (const toml::table* set = file["check"][i]["set"].as_table()) merge(merged, *set);
    std::ostringstream text;
    text << merged;
    checks[i].text = text.str();
  }
  return checks;
}

}  // namespace voussoir
