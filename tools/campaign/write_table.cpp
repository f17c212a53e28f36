#include "tools/campaign/write_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "io/hdf5/h5.h"
#include "solver/base/csv.h"
#include "solver/base/json_file.h"
#include "tools/campaign/json.h"
#include "tools/campaign/measures.h"
#include "tools/campaign/outcome.h"

namespace voussoir::campaign {

namespace fs = std::filesystem;

namespace {

/// Numbers of one run by column. The columns are sorted by name.
using Numbers = std::map<std::string, double>;

/// Of a JSON object, where there is one.
void take(const json& object, const char* key, const std::string& column, Numbers& into) {
  if (object.is_object() && object.contains(key) && object[key].is_number()) into[column] = object[key].get<double>();
}

/// The edp.* and damage.* columns of a summary.
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

/// Order of columns: demands first, means before places; then damage.
int rank(const std::string& column) {
  int i = 0;
  for (const char* prefix : {"edp.keystone_x", "edp.spandrel_y", "edp.place.", "edp.sensor.", "edp."}) {
    if (column.starts_with(prefix)) return i;
    ++i;
  }
  return i;
}

Numbers numbers_in(const std::string& folder) {
  return numbers_of(json_if_any(folder + "/summary.json"));
}

void add_plan(const Plan& plan, CampaignTable& table) {
  for (std::size_t k = 0; k < plan.keys.size(); ++k) {
    NumberColumn column{"material." + plan.keys[k], {}};
    for (const PlannedRun& run : plan.runs) column.values.push_back(run.values[k]);
    table.columns.push_back(column);
  }
  const std::vector<Measure> list = measures(plan.periods);
  for (std::size_t i = 0; i < list.size(); ++i) {
    NumberColumn column{"im." + list[i].name, {}};
    for (const PlannedRun& run : plan.runs)
      column.values.push_back(plan.records[run.record].measures[i] * std::pow(run.scale, double(list[i].power)));
    table.columns.push_back(column);
  }
}

void add_results(const std::vector<Numbers>& results, CampaignTable& table) {
  std::set<std::pair<int, std::string>> names;
  for (const Numbers& numbers : results)
    for (const auto& [name, value] : numbers) names.insert({rank(name), name});
  for (const auto& [place, name] : names) {
    NumberColumn column{name, {}};
    for (const Numbers& numbers : results) {
      const auto found = numbers.find(name);
      column.values.push_back(found == numbers.end() ? no_number : found->second);
    }
    table.columns.push_back(column);
  }
}

/// The nine columns of every run, by name.
void write_runs(h5::File& file, const std::vector<CampaignRun>& runs) {
  const auto texts = [&](const char* name, const auto& of) {
    std::vector<std::string> cells;
    for (const CampaignRun& run : runs) cells.push_back(of(run));
    file.write_texts(std::string("columns/") + name, cells);
  };
  texts("run", [](const CampaignRun& r) { return r.run; });
  texts("case", [](const CampaignRun& r) { return r.case_name; });
  texts("record", [](const CampaignRun& r) { return r.record; });
  texts("event", [](const CampaignRun& r) { return r.event; });
  texts("sample", [](const CampaignRun& r) { return r.sample; });
  texts("status", [](const CampaignRun& r) { return std::string(run_status_name(r.status)); });
  texts("reason", [](const CampaignRun& r) { return r.reason; });
  std::vector<double> scales, seconds;
  for (const CampaignRun& run : runs) scales.push_back(run.scale), seconds.push_back(run.seconds);
  file.write("columns/scale", scales, {}, "1");
  file.write("columns/seconds", seconds, {}, "s");
}

void write_h5(const Plan& plan, const CampaignTable& table, const std::string& path) {
  h5::File file = h5::File::create(path);
  file.set_text("/", "format", "voussoir-campaign-table");
  file.set_integer("/", "format_version", 1);
  file.set_text("/", "units", "SI");
  file.set_text("/", "program_version", VOUSSOIR_VERSION);
  std::vector<std::string> order = fixed_columns();
  for (const NumberColumn& column : table.columns) order.push_back(column.name);
  file.set_texts("/", "columns", order);
  write_runs(file, table.runs);
  for (const NumberColumn& column : table.columns) {
    std::string name = column.name;
    std::ranges::replace(name, '/', ':');  // a slash would make a group
    file.write("columns/" + name, column.values, {}, unit_of(plan, column.name));
  }
  file.save();
}

}  // namespace

std::string unit_of(const Plan& plan, const std::string& column) {
  for (const Measure& measure : measures(plan.periods))
    if (column == "im." + measure.name) return measure.unit;
  if (column.starts_with("material.")) return "";
  return column.ends_with(".broken_share") ? "1" : "m";
}

CampaignTable gather(const Plan& plan, const std::string& directory) {
  CampaignTable table;
  std::vector<Numbers> results;
  for (const PlannedRun& planned : plan.runs) {
    const Outcome outcome = read_outcome(directory, planned);
    const PlannedRecord& record = plan.records[planned.record];
    CampaignRun run;
    run.run = planned.id;
    run.case_name = plan.cases[planned.case_number].name;
    run.record = record.name, run.event = record.event;
    run.sample = planned.sample > 0 ? std::to_string(planned.sample) : "";
    run.reason = outcome.reason, run.status = outcome.status;
    run.scale = planned.scale;
    run.seconds = outcome.status == Status::missing ? no_number : outcome.seconds;
    const bool ended = outcome.status == Status::done || outcome.status == Status::collapsed;
    results.push_back(ended ? numbers_in(folder_of(directory, planned)) : Numbers{});
    table.runs.push_back(run);
  }
  add_plan(plan, table);
  add_results(results, table);
  return table;
}

void write_table(const Plan& plan, const std::string& directory) {
  const CampaignTable table = gather(plan, directory);
  voussoir::write_table(directory + "/table.csv", table);
  write_h5(plan, table, directory + "/table.h5");
}

}  // namespace voussoir::campaign
