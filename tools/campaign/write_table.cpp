#include "tools/campaign/write_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "io/hdf5/atomic_file.h"
#include "io/hdf5/h5.h"
#include "tools/campaign/json.h"
#include "tools/campaign/measures.h"
#include "tools/campaign/outcome.h"

namespace voussoir::campaign {

namespace fs = std::filesystem;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Numbers of one run by column; columns come to be in the order of their names, not of their appearance.
using Numbers = std::map<std::string, double>;

/// Of a JSON object, where there is one.
void take(const json& object, const char* key, const std::string& column, Numbers& into) {
  if (object.is_object() && object.contains(key) && object[key].is_number()) into[column] = object[key].get<double>();
}

/// The edp.* and damage.* of a summary.
Numbers numbers_of(const json& summary) {
  Numbers n;
  if (!summary.is_object()) return n;
  const json demand = summary.value("demand", json::object()), damage = summary.value("damage", json::object());
  const json places = demand.value("places", json::object()), sensors = summary.value("sensors", json::object());
  for (const char* mean : {"keystone_x", "spandrel_y"}) {
    const json entry = demand.value(mean, json::object());
    take(entry, "largest_mean", fmt::format("edp.{}", mean), n);
    take(entry, "residual_mean", fmt::format("edp.{}.residual", mean), n);
  }
  for (const auto& [name, place] : places.items()) take(place, "largest", "edp.place." + name, n);
  for (const auto& [name, sensor] : sensors.items()) {
    take(sensor, "largest", "edp.sensor." + name, n);
    take(sensor, "residual", "edp.sensor." + name + ".residual", n);
  }
  for (const auto& [name, component] : damage.items())
    for (const char* kind : {"broken_share", "largest_opening", "largest_slip"})
      take(component, kind, fmt::format("damage.{}.{}", name, kind), n);
  return n;
}

/// Demands first, the means before the places; then damage.
int rank(const std::string& column) {
  int i = 0;
  for (const char* prefix : {"edp.keystone_x", "edp.spandrel_y", "edp.place.", "edp.sensor.", "edp."}) {
    if (column.starts_with(prefix)) return i;
    ++i;
  }
  return i;
}

std::string unit_of(const std::string& column) {
  return column.ends_with(".broken_share") ? "1" : "m";
}

Numbers numbers_in(const std::string& folder) {
  std::error_code ignored;
  const std::string file = folder + "/summary.json";
  return fs::exists(file, ignored) ? numbers_of(json::parse(read_text(file), nullptr, false)) : Numbers{};
}

void add_plan(const Plan& plan, Table& table) {
  for (std::size_t k = 0; k < plan.keys.size(); ++k) {
    ValueColumn column{"material." + plan.keys[k], "", {}};
    for (const PlannedRun& run : plan.runs) column.cells.push_back(run.values[k]);
    table.values.push_back(column);
  }
  const std::vector<Measure> list = measures(plan.periods);
  for (std::size_t i = 0; i < list.size(); ++i) {
    ValueColumn column{"im." + list[i].name, list[i].unit, {}};
    for (const PlannedRun& run : plan.runs)
      column.cells.push_back(plan.records[run.record].measures[i] * std::pow(run.scale, double(list[i].power)));
    table.values.push_back(column);
  }
}

void add_results(const std::vector<Numbers>& results, Table& table) {
  std::set<std::pair<int, std::string>> names;
  for (const Numbers& numbers : results)
    for (const auto& [name, value] : numbers) names.insert({rank(name), name});
  for (const auto& [place, name] : names) {
    ValueColumn column{name, unit_of(name), {}};
    for (const Numbers& numbers : results) {
      const auto found = numbers.find(name);
      column.cells.push_back(found == numbers.end() ? none : found->second);
    }
    table.values.push_back(column);
  }
}

/// As RFC 4180 has it: quoted where a comma, a quote or a line break asks for it.
std::string cell(const std::string& text) {
  if (text.find_first_of(",;\"\r\n") == std::string::npos && !text.starts_with('#') && !text.starts_with(' ') &&
      !text.ends_with(' '))
    return text;
  std::string quoted;
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return fmt::format("\"{}\"", quoted);
}

std::string cell(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

template <class List>
auto find_column(const List& list, const std::string& name) {
  return std::find_if(list.begin(), list.end(), [&](const auto& column) { return column.name == name; });
}

std::string cell(const Table& table, const std::string& name, std::size_t row) {
  if (const auto text = find_column(table.texts, name); text != table.texts.end()) return cell(text->cells[row]);
  return cell(find_column(table.values, name)->cells[row]);
}

void write_h5(const Table& table, const std::string& path) {
  h5::File file = h5::File::create(path);
  file.set_text("/", "format", "voussoir-campaign-table");
  file.set_integer("/", "format_version", 1);
  file.set_text("/", "units", "SI");
  file.set_text("/", "program_version", VOUSSOIR_VERSION);
  file.set_texts("/", "columns", table.order);
  const auto place = [](std::string name) {
    std::ranges::replace(name, '/', ':');  // which would be a group
    return "columns/" + name;
  };
  for (const TextColumn& column : table.texts) file.write_texts(place(column.name), column.cells);
  for (const ValueColumn& column : table.values) file.write(place(column.name), column.cells, {}, column.unit);
  file.save();
}

}  // namespace

Table gather(const Plan& plan, const std::string& directory) {
  Table table;
  for (const char* name : {"run", "case", "record", "event", "sample", "status", "reason"})
    table.texts.push_back({name, {}});
  ValueColumn scale{"scale", "1", {}}, seconds{"seconds", "s", {}};
  std::vector<Numbers> results;
  for (const PlannedRun& run : plan.runs) {
    const Outcome outcome = read_outcome(directory, run);
    const PlannedRecord& record = plan.records[run.record];
    const std::string cells[] = {run.id,
                                 plan.cases[run.case_number].name,
                                 record.name,
                                 record.event,
                                 run.sample > 0 ? std::to_string(run.sample) : "",
                                 status_name(outcome.status),
                                 outcome.reason};
    for (std::size_t i = 0; i < table.texts.size(); ++i) table.texts[i].cells.push_back(cells[i]);
    scale.cells.push_back(run.scale);
    const bool ended = outcome.status == Status::done || outcome.status == Status::collapsed;
    seconds.cells.push_back(outcome.status == Status::missing ? none : outcome.seconds);
    results.push_back(ended ? numbers_in(folder_of(directory, run)) : Numbers{});
  }
  table.values = {scale, seconds};
  add_plan(plan, table);
  add_results(results, table);
  table.order = {"run", "case", "record", "event", "scale", "sample", "status", "reason", "seconds"};
  for (std::size_t i = 2; i < table.values.size(); ++i) table.order.push_back(table.values[i].name);
  return table;
}

std::string csv_of(const Table& table) {
  const auto line = [&](const auto& cell_of) {
    std::vector<std::string> cells;
    for (const std::string& name : table.order) cells.push_back(cell_of(name));
    return fmt::format("{}\n", fmt::join(cells, ","));
  };
  std::string text = line([](const std::string& name) { return cell(name); });
  for (std::size_t row = 0; row < table.texts.front().cells.size(); ++row)
    text += line([&](const std::string& name) { return cell(table, name, row); });
  return text;
}

void write_table(const Plan& plan, const std::string& directory) {
  const Table table = gather(plan, directory);
  write_atomically(directory + "/table.csv", csv_of(table));
  write_h5(table, directory + "/table.h5");
}

}  // namespace voussoir::campaign
