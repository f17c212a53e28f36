#include "io/toml/table_reader.h"

#include <algorithm>
#include <cmath>

#include "geometry/extent.h"
#include "solver/base/counted.h"
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
    return fmt::format("must be {} {} {} {}{}", limits.above ? "above" : "from", limits.low,
                       limits.above ? "and at most" : "to", limits.high, unit);
  if (low)
    return fmt::format("must be {}{}{}", limits.above ? "above " : "", limits.low,
                       limits.above ? unit : unit + " or more");
  return fmt::format("must be at most {}{}", limits.high, unit);
}

/// The same for a list of keys: "above 0 and at most 1e+10 Pa".
std::string number_words(const Limits& limits) {
  const std::string words = range(limits).substr(std::string_view("must be ").size());
  return std::isfinite(limits.low) || std::isfinite(limits.high) ? words : "a number";
}

}  // namespace

TableReader::TableReader(const toml::table& table, std::string file, std::string place)
    : TableReader(table, std::move(file), std::move(place), std::make_shared<Shared>()) {
  outermost_ = true;
}

TableReader::TableReader(const toml::table& table, std::string file, std::string place, std::shared_ptr<Shared> shared)
    : table_(&table), file_(std::move(file)), place_(std::move(place)), shared_(std::move(shared)) {}

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

std::string TableReader::misspelt(const std::string& key) const {
  std::vector<std::string> strange;
  for (const auto& [name, node] : *table_)
    if (!known_.contains(std::string(name.str()))) strange.emplace_back(name.str());
  return nearest_word(key, strange);
}

void TableReader::note_wrong(const std::string& key, const std::vector<KnownKey>& known) const {
  const toml::source_region& source = table_->find(key)->first.source();
  shared_->wrong.add(at(source), int(source.begin.line), key, place_, known);
}

void TableReader::missing(const std::string& key, const std::string& what) const {
  const std::string near = misspelt(key);
  if (near.empty()) fail(fmt::format("needs '{}' ({})", key, what));
  note_wrong(near, {{key, "", what}});
  throw InputError("{}", shared_->wrong.last());
}

void TableReader::need(const std::string& key, const std::string& what) {
  if (find(key, what)) return;
  const std::string near = misspelt(key);
  if (near.empty()) missing(key, what);
  note_wrong(near, {{key, "", what}});
  known_[near] = {};
  misspelt_[key] = near;
}

const toml::node* TableReader::find(const std::string& key) {
  known_.try_emplace(key);
  const auto other = misspelt_.find(key);
  return table_->get(other == misspelt_.end() ? key : other->second);
}

const toml::node* TableReader::find(const std::string& key, const std::string& expected, const std::string& fallback) {
  Expected& e = known_[key];
  if (e.expected.empty()) e = {fallback, expected};
  return find(key);
}

bool TableReader::has(const std::string& key) {
  return find(key) != nullptr;
}

double TableReader::checked(const std::string& key, const toml::node& node, const Limits& limits) const {
  if (!node.is_number())
    fail(key, fmt::format("is {}. It must be a number{}.", kind_of(node),
                          limits.unit.empty() || limits.unit == "-" ? "" : " in " + limits.unit));
  const double value = *node.value<double>();
  if (!std::isfinite(value)) fail(key, fmt::format("is {}. It must be a finite number.", value));
  if (value < limits.low || value > limits.high || (limits.above && value == limits.low))
    fail(key, fmt::format("is {}. It {}.", value, range(limits)));
  return value;
}

double TableReader::number(const std::string& key, double fallback, const Limits& limits) {
  const toml::node* node =
      find(key, number_words(limits), std::isfinite(fallback) ? fmt::format("{:g}", fallback) : "");
  return node ? checked(key, *node, limits) : fallback;
}

double TableReader::required_number(const std::string& key, const Limits& limits) {
  need(key, "a number" + (limits.unit.empty() ? "" : " in " + limits.unit));
  return number(key, 0.0, limits);
}

std::int64_t TableReader::integer(const std::string& key, std::int64_t fallback, std::int64_t low, std::int64_t high) {
  const toml::node* node =
      find(key, fmt::format("a whole number from {} to {}", low, high), fmt::format("{}", fallback));
  if (!node) return fallback;
  if (!node->is_integer())
    fail(key,
         fmt::format("is {}. It must be a whole number.", node->is_floating_point() ? "a fraction" : kind_of(*node)));
  const std::int64_t value = *node->value<std::int64_t>();
  if (value < low || value > high) fail(key, fmt::format("is {}. It must be from {} to {}.", value, low, high));
  return value;
}

bool TableReader::flag(const std::string& key, bool fallback) {
  const toml::node* node = find(key, "true or false", fallback ? "true" : "false");
  if (!node) return fallback;
  if (!node->is_boolean()) fail(key, fmt::format("is {}. It must be true or false.", kind_of(*node)));
  return *node->value<bool>();
}

std::string TableReader::text(const std::string& key, const std::string& fallback) {
  const toml::node* node = find(key, "text in quotes", fallback.empty() ? "" : fmt::format("\"{}\"", fallback));
  if (!node) return fallback;
  if (!node->is_string()) fail(key, fmt::format("is {}. It must be text in quotes.", kind_of(*node)));
  return *node->value<std::string>();
}

std::string TableReader::required_text(const std::string& key) {
  need(key, "text in quotes");
  return text(key, "");
}

std::size_t TableReader::word(const std::string& key, const std::vector<std::string>& words, std::size_t fallback) {
  const std::string usual = fallback < words.size() ? fmt::format("\"{}\"", words[fallback]) : "";
  if (!find(key, fmt::format("one of: {}", fmt::join(words, ", ")), usual)) return fallback;
  const std::string value = text(key, "");
  const auto found = std::find(words.begin(), words.end(), value);
  if (found == words.end()) {
    const std::string near = nearest_word(value, words);
    fail(key, fmt::format("is \"{}\": {}expected one of: {}", shown(value),
                          near.empty() ? near : fmt::format("did you mean \"{}\"? ", near), fmt::join(words, ", ")));
  }
  return std::size_t(found - words.begin());
}

std::size_t TableReader::required_word(const std::string& key, const std::vector<std::string>& words) {
  need(key, fmt::format("one of: {}", fmt::join(words, ", ")));
  return word(key, words, 0);
}

std::vector<double> TableReader::list(const std::string& key, const Limits& limits) {
  const toml::array* array = find(key)->as_array();
  if (!array) fail(key, fmt::format("is {}. It must be a list of numbers.", kind_of(*find(key))));
  std::vector<double> values;
  for (const toml::node& node : *array) values.push_back(checked(key, node, limits));
  return values;
}

std::vector<double> TableReader::numbers(const std::string& key, std::size_t count, const Limits& limits) {
  need(key, fmt::format("a list of {}", counted(count, "number")));
  const std::vector<double> values = list(key, limits);
  if (values.size() != count)
    fail(key, fmt::format("has {}. It must have {}.", counted(values.size(), "number"), count));
  return values;
}

std::vector<double> TableReader::number_list(const std::string& key, const Limits& limits) {
  if (!is_list(key)) return {required_number(key, limits)};
  const std::vector<double> values = list(key, limits);
  if (values.empty()) fail(key, "is empty. Give at least one number.");
  return values;
}

std::vector<std::string> TableReader::texts(const std::string& key) {
  need(key, "text in quotes or a list of texts");
  const toml::node* node = find(key);
  if (!node->is_array()) return {text(key, "")};
  std::vector<std::string> values;
  for (const toml::node& item : *node->as_array()) {
    if (!item.is_string()) fail(key, fmt::format("has {} in its list. It must have texts in quotes.", kind_of(item)));
    values.push_back(*item.value<std::string>());
  }
  return values;
}

std::vector<Vec3> TableReader::pairs(const std::string& key, const std::string& pair, std::size_t least) {
  const toml::node* node = find(key, fmt::format("[{}, …]", pair));
  if (!node) return {};
  constexpr double largest = 1e4;  // m
  std::vector<Vec3> list;
  const auto number = [&](const toml::node* item) {
    const std::optional<double> x = item && item->is_number() ? item->value<double>() : std::nullopt;
    if (!x || !(std::abs(*x) <= largest))
      fail(key, fmt::format("has a wrong entry {}. It must be {} in m, each at most {:g} in size.", list.size() + 1,
                            pair, largest));
    return *x;
  };
  const toml::array* points = node->as_array();
  if (!points || points->size() < least)
    fail(key, fmt::format("must be a list of at least {} in m: [{}, …]", least == 1 ? "one pair" : "two points", pair));
  for (const toml::node& item : *points) {
    const toml::array* point = item.as_array();
    if (!point || point->size() != 2)
      fail(key, fmt::format("has a wrong entry {}: {}. It must be {} in m.", list.size() + 1, kind_of(item), pair));
    const double first = number(point->get(0)), second = number(point->get(1));
    list.emplace_back(first, 0.0, second);
  }
  return list;
}

std::vector<Vec3> TableReader::profile(const std::string& key) {
  const std::vector<Vec3> line = pairs(key, "[x, z]", 2);
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (line[i + 1].x() <= line[i].x())
      fail(key, fmt::format("goes back at x = {:g} m. Give its points from left to right.", line[i + 1].x()));
  return line;
}

Vec3 TableReader::vector(const std::string& key, const Vec3& fallback, const Limits& limits) {
  if (!find(key, "[x, y, z]")) return fallback;
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
  if (!node->is_table()) fail(key, fmt::format("is {}. It must be a table.", kind_of(*node)));
  return TableReader(*node->as_table(), file_, place, shared_);
}

std::optional<TableReader> TableReader::table(const std::string& key, const std::string& place) {
  if (!find(key, "a table")) return std::nullopt;
  return member(key, place);
}

std::vector<TableReader> TableReader::tables(const std::string& key) {
  std::vector<TableReader> readers;
  const toml::node* node = find(key, fmt::format("tables with the heading [[{}]]", key));
  if (!node) return readers;
  const toml::array* array = node->as_array();
  if (!array || std::any_of(array->begin(), array->end(), [](const toml::node& item) { return !item.is_table(); }))
    throw InputError("{}'{}' is {}. Give tables with the heading [[{}]], in double brackets.", at(node->source()), key,
                     kind_of(*node), key);
  for (const toml::node& item : *array)
    readers.push_back(
        TableReader(*item.as_table(), file_, fmt::format("[[{}]] number {}", key, readers.size() + 1), shared_));
  return readers;
}

std::vector<std::string> TableReader::keys() {
  std::vector<std::pair<std::uint32_t, std::string>> found;
  for (const auto& [key, node] : *table_) found.emplace_back(key.source().begin.line, std::string(key.str()));
  std::sort(found.begin(), found.end());
  std::vector<std::string> names;
  for (auto& [line, name] : found) {
    known_.try_emplace(name);
    names.push_back(std::move(name));
  }
  return names;
}

void TableReader::attempt(const std::function<void()>& read) {
  try {
    read();
  } catch (const InputError& error) {
    if (shared_->error.empty() && !shared_->wrong.said(error.what())) shared_->error = error.what();
  }
}

void TableReader::finish() {
  std::vector<KnownKey> known;
  for (const auto& [name, e] : known_)
    if (std::none_of(misspelt_.begin(), misspelt_.end(), [&name = name](const auto& m) { return m.second == name; }))
      known.push_back({name, e.fallback, e.expected});
  for (const auto& [key, node] : *table_)
    if (const std::string name(key.str()); !known_.contains(name)) note_wrong(name, known);
  if (!outermost_ || fine()) return;
  const std::string wrong = shared_->wrong.any() ? shared_->wrong.message(file_) : "";
  throw InputError("{}{}{}", shared_->error, shared_->error.empty() || wrong.empty() ? "" : "\n", wrong);
}

}  // namespace voussoir
