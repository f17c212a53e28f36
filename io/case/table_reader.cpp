#include "io/case/table_reader.h"

#include <algorithm>
#include <cmath>

#include "geometry/extent.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"

namespace voussoir {

namespace {

const char* kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "text";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

std::string range(const Limits& limits) {
  const std::string unit = limits.unit.empty() || limits.unit == "-" ? "" : " " + limits.unit;
  const bool low = std::isfinite(limits.low), high = std::isfinite(limits.high);
  if (low && high)
    return fmt::format("must be {} {} to {}{}", limits.above ? "above" : "from", limits.low, limits.high, unit);
  if (low)
    return fmt::format("must be {}{}{}", limits.above ? "above " : "", limits.low,
                       limits.above ? unit : unit + " or more");
  return fmt::format("must be at most {}{}", limits.high, unit);
}

}  // namespace

TableReader::TableReader(const toml::table& table, std::string file, std::string place)
    : table_(&table), file_(std::move(file)), place_(std::move(place)) {}

std::string TableReader::at(const toml::source_region& source) const {
  return source.begin.line > 0 ? fmt::format("{}:{}: ", file_, source.begin.line) : file_ + ": ";
}

void TableReader::fail(const std::string& key, const std::string& message) const {
  const auto found = table_->find(key);
  const auto& source = found == table_->end() ? table_->source() : found->first.source();
  throw InputError("{}'{}' in {} {}", at(source), shown(key), place_, message);
}

void TableReader::fail(const std::string& message) const {
  throw InputError("{}{} {}", at(table_->source()), place_, message);
}

void TableReader::missing(const std::string& key, const std::string& what) const {
  std::vector<std::string> strange;
  for (const auto& [name, node] : *table_)
    if (!known_.contains(std::string(name.str()))) strange.emplace_back(name.str());
  const std::string near = nearest_word(key, strange);
  if (near.empty()) fail(fmt::format("needs '{}' ({})", key, what));
  throw InputError("{}unknown key '{}' in {}: did you mean '{}'?", at(table_->find(near)->first.source()), near, place_,
                   key);
}

const toml::node* TableReader::find(const std::string& key) {
  known_.insert(key);
  return table_->get(key);
}

bool TableReader::has(const std::string& key) {
  return find(key) != nullptr;
}

double TableReader::checked(const std::string& key, const toml::node& node, const Limits& limits) const {
  if (!node.is_number())
    fail(key, fmt::format("is {}, expected a number{}", kind_of(node),
                          limits.unit.empty() || limits.unit == "-" ? "" : " in " + limits.unit));
  const double value = *node.value<double>();
  if (!std::isfinite(value)) fail(key, fmt::format("is {}: must be a finite number", value));
  if (value < limits.low || value > limits.high || (limits.above && value == limits.low))
    fail(key, fmt::format("is {}: {}", value, range(limits)));
  return value;
}

double TableReader::number(const std::string& key, double fallback, const Limits& limits) {
  const toml::node* node = find(key);
  return node ? checked(key, *node, limits) : fallback;
}

double TableReader::required_number(const std::string& key, const Limits& limits) {
  if (!has(key)) missing(key, "a number" + (limits.unit.empty() ? "" : " in " + limits.unit));
  return number(key, 0.0, limits);
}

std::int64_t TableReader::integer(const std::string& key, std::int64_t fallback, std::int64_t low, std::int64_t high) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  if (!node->is_integer())
    fail(key, fmt::format("is {}, expected a whole number", node->is_floating_point() ? "a fraction" : kind_of(*node)));
  const std::int64_t value = *node->value<std::int64_t>();
  if (value < low || value > high) fail(key, fmt::format("is {}: must be from {} to {}", value, low, high));
  return value;
}

bool TableReader::flag(const std::string& key, bool fallback) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  if (!node->is_boolean()) fail(key, fmt::format("is {}, expected true or false", kind_of(*node)));
  return *node->value<bool>();
}

std::string TableReader::text(const std::string& key, const std::string& fallback) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  if (!node->is_string()) fail(key, fmt::format("is {}, expected text in quotes", kind_of(*node)));
  return *node->value<std::string>();
}

std::string TableReader::required_text(const std::string& key) {
  if (!has(key)) missing(key, "text in quotes");
  return text(key, "");
}

std::size_t TableReader::word(const std::string& key, const std::vector<std::string>& words, std::size_t fallback) {
  if (!has(key)) return fallback;
  const std::string value = text(key, "");
  const auto found = std::find(words.begin(), words.end(), value);
  if (found == words.end())
    fail(key, fmt::format("is \"{}\": expected one of: {}", shown(value), fmt::join(words, ", ")));
  return std::size_t(found - words.begin());
}

std::size_t TableReader::required_word(const std::string& key, const std::vector<std::string>& words) {
  if (!has(key)) missing(key, fmt::format("one of: {}", fmt::join(words, ", ")));
  return word(key, words, 0);
}

std::vector<double> TableReader::list(const std::string& key, const Limits& limits) {
  const toml::array* array = find(key)->as_array();
  if (!array) fail(key, fmt::format("is {}, expected a list of numbers", kind_of(*find(key))));
  std::vector<double> values;
  for (const toml::node& node : *array) values.push_back(checked(key, node, limits));
  return values;
}

std::vector<double> TableReader::numbers(const std::string& key, std::size_t count, const Limits& limits) {
  if (!has(key)) missing(key, fmt::format("a list of {} numbers", count));
  const std::vector<double> values = list(key, limits);
  if (values.size() != count) fail(key, fmt::format("has {} numbers, expected {}", values.size(), count));
  return values;
}

std::vector<double> TableReader::number_list(const std::string& key, const Limits& limits) {
  if (!is_list(key)) return {required_number(key, limits)};
  const std::vector<double> values = list(key, limits);
  if (values.empty()) fail(key, "is empty: give at least one number");
  return values;
}

std::vector<std::string> TableReader::texts(const std::string& key) {
  const toml::node* node = find(key);
  if (!node) missing(key, "text in quotes or a list of texts");
  if (!node->is_array()) return {text(key, "")};
  std::vector<std::string> values;
  for (const toml::node& item : *node->as_array()) {
    if (!item.is_string()) fail(key, fmt::format("holds {}, expected texts in quotes", kind_of(item)));
    values.push_back(*item.value<std::string>());
  }
  return values;
}

Vec3 TableReader::vector(const std::string& key, const Vec3& fallback, const Limits& limits) {
  if (!has(key)) return fallback;
  const std::vector<double> v = numbers(key, 3, limits);
  return {v[0], v[1], v[2]};
}

Vec3 TableReader::place_in_m(const std::string& key, const Vec3& fallback) {
  return vector(key, fallback, {-farthest, farthest, "m"});
}

bool TableReader::is_list(const std::string& key) {
  return has(key) && find(key)->is_array();
}
bool TableReader::is_text(const std::string& key) {
  return has(key) && find(key)->is_string();
}

TableReader TableReader::member(const std::string& key, const std::string& place) {
  const toml::node* node = find(key);
  if (!node->is_table()) fail(key, fmt::format("is {}, expected a table", kind_of(*node)));
  return TableReader(*node->as_table(), file_, place);
}

std::optional<TableReader> TableReader::table(const std::string& key, const std::string& place) {
  if (!has(key)) return std::nullopt;
  return member(key, place);
}

std::vector<TableReader> TableReader::tables(const std::string& key) {
  std::vector<TableReader> readers;
  const toml::node* node = find(key);
  if (!node) return readers;
  const toml::array* array = node->as_array();
  if (!array || std::any_of(array->begin(), array->end(), [](const toml::node& item) { return !item.is_table(); }))
    throw InputError("{}'{}' is {}: expected tables headed [[{}]], with double brackets", at(node->source()), key,
                     kind_of(*node), key);
  for (const toml::node& item : *array)
    readers.emplace_back(*item.as_table(), file_, fmt::format("[[{}]] number {}", key, readers.size() + 1));
  return readers;
}

std::vector<std::string> TableReader::keys() {
  std::vector<std::pair<std::uint32_t, std::string>> found;
  for (const auto& [key, node] : *table_) found.emplace_back(key.source().begin.line, std::string(key.str()));
  std::sort(found.begin(), found.end());
  std::vector<std::string> names;
  for (auto& [line, name] : found) {
    known_.insert(name);
    names.push_back(std::move(name));
  }
  return names;
}

void TableReader::finish() const {
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (known_.contains(name)) continue;
    throw InputError("{}unknown key '{}' in {}{}", at(key.source()), shown(name), place_,
                     suggestion(name, {known_.begin(), known_.end()}));
  }
}

}  // namespace voussoir
