// voussoir fragility.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>

#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/csv.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "solver/base/json_file.h"
#include "tools/fragility/fragility_charts.h"
#include "tools/fragility/fragility_page.h"
#include "tools/fragility/fragility_words.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

/// "spandrel_y" is short for edp.spandrel_y.
std::string demand_column(const std::string& word) {
  const bool whole = word == collapse_demand || word.find('.') != std::string::npos;
  return whole ? word : "edp." + word;
}

/// "NAME:DEMAND:THRESHOLD", or "NAME:collapse".
LimitState limit_from_words(const std::string& words) {
  const std::size_t first = words.find(':'), second = first == std::string::npos ? first : words.find(':', first + 1);
  LimitState limit;
  limit.name = words.substr(0, first);
  if (first != std::string::npos) limit.demand = words.substr(first + 1, second - first - 1);
  const bool falls = limit.demand == collapse_demand && second == std::string::npos;
  if (limit.demand.empty() || (second == std::string::npos && !falls))
    throw InputError(
        "--limit is {}. It must be NAME:DEMAND:THRESHOLD, such as damage:spandrel_y:0.02, or NAME:collapse", words);
  if (falls) return limit;
  const std::string number = words.substr(second + 1);
  if (parse_number(number, limit.threshold) != NumberTrouble::none)
    throw InputError("--limit {}: the threshold is '{}'. It must be a number in SI units", words, number);
  return limit;
}

LimitState limit_from_json(const nlohmann::json& json, const std::string& path) {
  LimitState limit;
  const auto text = [&](const char* key) {
    if (!json.is_object() || !json.contains(key) || json[key].is_null()) return std::string();
    if (!json[key].is_string()) throw InputError("{}: limit_states: '{}' must be a text", path, key);
    return json[key].get<std::string>();
  };
  limit.name = text("name"), limit.demand = text("demand"), limit.case_name = text("case");
  if (limit.name.empty() || limit.demand.empty())
    throw InputError("{}: each entry of limit_states needs 'name', 'demand' and 'threshold'", path);
  if (limit.demand == collapse_demand) return limit;
  if (!json.contains("threshold") || !json["threshold"].is_number())
    throw InputError("{}: the limit state '{}' needs a number 'threshold'", path, limit.name);
  limit.threshold = json["threshold"].get<double>();
  return limit;
}

/// The limit states of campaign.json; empty if there is no such file.
std::vector<LimitState> limits_in(const std::string& path, const CampaignTable& table) {
  std::vector<LimitState> limits;
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return limits;
  const nlohmann::json json = read_json(path);
  if (!json.is_object() || !json.contains("limit_states")) return limits;
  if (!json["limit_states"].is_array()) throw InputError("{}: 'limit_states' must be a list", path);
  for (const auto& one : json["limit_states"]) {
    LimitState limit = limit_from_json(one, path);
    limit.demand = demand_column(limit.demand);
    check_limit(table, limit, path);
    limits.push_back(limit);
  }
  return limits;
}

/// The limit states of campaign.json and of --limit, which replace those with the same name. Collapse is added if a run
/// collapsed.
std::vector<LimitState> all_limits(const CampaignTable& table, const std::string& directory,
                                   const std::vector<std::string>& asked) {
  std::vector<LimitState> limits = limits_in(directory + "/campaign.json", table), more;
  for (const std::string& words : asked) {
    LimitState limit = limit_from_words(words);
    limit.demand = demand_column(limit.demand);
    check_limit(table, limit, "--limit " + words);
    std::erase_if(limits, [&](const LimitState& l) { return l.name == limit.name; });
    more.push_back(limit);
  }
  limits.insert(limits.end(), more.begin(), more.end());
  const bool named = std::any_of(limits.begin(), limits.end(), [](const auto& l) {
    return l.demand == collapse_demand || l.name == collapse_demand;
  });
  const bool fell =
      std::any_of(table.runs.begin(), table.runs.end(), [](const auto& r) { return r.status == RunStatus::collapsed; });
  if (fell && !named) limits.push_back({std::string(collapse_demand), std::string(collapse_demand), 0.0, ""});
  return limits;
}

void count_runs(const CampaignTable& table, FragilityReport& report) {
  for (const CampaignRun& run : table.runs) {
    report.done += run.status == RunStatus::done;
    report.collapsed += run.status == RunStatus::collapsed;
    report.failed += run.status == RunStatus::failed;
    report.missing += run.status == RunStatus::missing;
  }
  if (report.done + report.collapsed == 0)
    throw InputError(
        "{}: none of {} is done ({} failed, {} not yet run), so there are no curves. Run the "
        "campaign first",
        table.path, counted(table.runs.size(), "run"), report.failed, report.missing);
}

/// A remark if the records were scaled to levels of another intensity than the one in use; otherwise empty.
std::string levels_remark(const CampaignTable& table, const std::string& im) {
  const auto has_levels = [&](const std::string& name) {
    std::vector<double> values = table.column(name).values;
    std::erase_if(values, [](double v) { return !(v > 0.0); });
    return !levels_of(values).empty();
  };
  if (has_levels(im)) return "";
  for (const std::string& name : intensities(table))
    if (has_levels(name))
      return fmt::format(
          "The records were scaled to levels of {0}. Over {1} they form a cloud of points. Give --im {0} to count at "
          "the levels.",
          name, im);
  return "";
}

/// A remark for each intensity that some of the runs with a result have and others do not.
void remark_on_coverage(const CampaignTable& table, FragilityReport& report) {
  for (const std::string& im : intensities(table))
    if (const Coverage c = coverage(table, table.cases(), im); c.with > 0 && !c.complete())
      report.remarks.push_back(
          fmt::format("{0} ({1}) is zero or missing in {2} of {3} runs with a result, so the program does not choose "
                      "it. Give --im {0} to use it.",
                      im, measure_name(im), c.runs - c.with, c.runs));
}

void add_curves(const CampaignTable& table, const std::vector<LimitState>& limits, const std::string& im,
                FragilityReport& report) {
  for (const LimitState& limit : limits) {
    const std::vector<std::string> cases =
        limit.case_name.empty() ? table.cases() : std::vector<std::string>{limit.case_name};
    const std::string measure = im.empty() ? best_intensity(table, cases, limit.demand, limit.threshold) : im;
    for (const std::string& name : cases) report.curves.push_back(assess(table, name, limit, measure, report.settings));
    const std::string remark = levels_remark(table, measure);
    if (!remark.empty() && std::find(report.remarks.begin(), report.remarks.end(), remark) == report.remarks.end())
      report.remarks.push_back(remark);
  }
  if (im.empty()) remark_on_coverage(table, report);
  if (limits.empty())
    report.remarks.push_back(
        "No limit state is given, so there are no curves. Give --limit NAME:DEMAND:THRESHOLD, such as "
        "damage:spandrel_y:0.02.");
}

void add_rankings(const CampaignTable& table, const std::vector<LimitState>& limits, FragilityReport& report) {
  std::vector<std::string> demands = main_demands(table);
  for (const LimitState& limit : limits)
    if (limit.demand != collapse_demand && std::find(demands.begin(), demands.end(), limit.demand) == demands.end())
      demands.push_back(limit.demand);
  for (const std::string& name : table.cases()) {
    for (const std::string& demand : demands)
      report.intensities.push_back({name, demand, rank_intensities(table, name, demand)});
    report.damage.push_back({name, rank_demands(table, name, report.settings.replicates, report.settings.seed)});
  }
}

/// A name in which all characters but letters, digits and '-' are replaced, for use in a file name.
std::string plain(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return name;
}

void write_report(const std::string& out, const std::string& title, const FragilityReport& report) {
  make_folder_of(out + "/fragility.json");
  write_json(out + "/fragility.json", report_json(report));
  write_atomically(out + "/fragility.csv", report_csv(report));
  write_atomically(out + "/fragility.html", fragility_page(title, report));
  std::map<std::string, int> written;  // the same name may have different thresholds for different bridges
  for (const auto& group : by_limit(report.curves)) {
    const std::string svg = curves_chart(group);
    if (svg.empty()) continue;
    const std::string name = plain(group.front()->limit.name);
    const int number = ++written[name];
    const std::string file =
        fmt::format("{}/images/fragility_{}{}.svg", out, name, number > 1 ? fmt::format("_{}", number) : std::string());
    make_folder_of(file);
    write_atomically(file, svg);
  }
}

int fragility(const std::vector<std::string>& arguments) {
  CommandLine line("fragility", "fragility DIR [-o OUT] [--limit NAME:DEMAND:THRESHOLD …]",
                   "voussoir fragility campaign --limit damage:spandrel_y:0.02 --im im.pga");
  line.described.add_options()("output,o", options::value<std::string>()->value_name("OUT"),
                               "folder to write to (default: DIR)")(
      "limit", options::value<std::vector<std::string>>()->value_name("N:D:T"),
      "limit state NAME:DEMAND:THRESHOLD in SI units, or NAME:collapse; may be repeated; added to those of "
      "campaign.json, replaces one with the same name")(
      "im", options::value<std::string>()->value_name("NAME"),
      "intensity measure: a column im.NAME of the table (default: the most proficient that all runs have)")(
      "bootstrap", whole_option("bootstrap", 0, 1'000'000)->value_name("N")->default_value(1000),
      "number of resamples of the records for the bands; 0: no bands")(
      "seed", options::value<std::uint64_t>()->value_name("S")->default_value(1), "seed of the resamples");
  line.positional = line.required = {"DIR"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string directory = values["DIR"].as<std::string>();
  FragilityReport report;
  report.settings = {values["bootstrap"].as<int>(), values["seed"].as<std::uint64_t>()};
  const CampaignTable table = read_table(directory + "/table.csv");
  report.table = table.path;
  count_runs(table, report);
  std::string im = values.count("im") ? values["im"].as<std::string>() : std::string();
  if (!im.empty() && !im.starts_with("im.")) im = "im." + im;
  if (!im.empty()) table.column(im);
  const std::vector<LimitState> limits =
      all_limits(table, directory,
                 values.count("limit") ? values["limit"].as<std::vector<std::string>>() : std::vector<std::string>());
  add_curves(table, limits, im, report);
  add_rankings(table, limits, report);
  const std::string out = values.count("output") ? values["output"].as<std::string>() : directory;
  write_report(out, "Fragility: " + fs::weakly_canonical(directory).filename().string(), report);
  if (!values.count("quiet"))
    fmt::print("{}\n{}/fragility.html, fragility.json, fragility.csv{}\n", report_text(report), out,
               report.curves.empty() ? "" : ", images/fragility_NAME.svg");
  return 0;
}

}  // namespace

Verb fragility_verb() {
  return {"fragility", "compute fragility curves from the table of a campaign", fragility};
}

}  // namespace voussoir
