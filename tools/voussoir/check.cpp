// voussoir check: runs the validation ladder and compares its results with the expected values. The rungs are elements
// of the method (tools/ladder) and cases with [[check]].
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "io/case/checks.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "solver/base/shipped.h"
#include "solver/base/suggestion.h"
#include "tools/ladder/rung.h"
#include "tools/run/run_directory.h"
#include "tools/run/run_session.h"
#include "tools/voussoir/check_table.h"
#include "tools/voussoir/verb.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

/// The folder of the rungs that are cases. Some bridges of the literature (cases/bridges) are rungs too.
std::string ladder_folder() {
  return shipped("cases/validation");
}
constexpr const char* bridges = "bridges";

/// The name of a rung: that of its file. case.toml has the name of its folder; a bridge of the literature begins with
/// "bridge-".
std::string rung_name(const std::string& file) {
  const fs::path path(file);
  std::error_code ignored;
  const std::string folder = fs::weakly_canonical(path, ignored).parent_path().filename().string();
  if (path.filename() == "case.toml") return folder;
  return (folder == bridges ? "bridge-" : "") + path.stem().string();
}

/// The rungs that are cases, in alphabetical order of their files.
std::vector<std::string> ladder_files() {
  std::vector<std::string> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(ladder_folder(), ignored))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  for (const auto& entry : fs::directory_iterator(fs::path(ladder_folder()).parent_path() / bridges, ignored))
    if (entry.path().extension() == ".toml" &&
        read_text(entry.path().string()).find("\n[[check]]") != std::string::npos)
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// One step of the ladder: an element of the method, or a case file with [[check]].
struct Step {
  const ladder::Rung* rung = nullptr;
  std::string file;  // used if `rung` is null
};

/// The whole ladder: elements of the method first, then cases.
std::vector<Step> all_steps() {
  std::vector<Step> steps;
  for (const ladder::Rung& rung : ladder::rungs()) steps.push_back({&rung, {}});
  const std::vector<std::string> files = ladder_files();
  if (files.empty())
    throw InputError("there is no validation case in {}. Name a case file with [[check]]", ladder_folder());
  for (const std::string& file : files) steps.push_back({nullptr, file});
  return steps;
}

Step find_step(const std::string& name) {
  std::vector<std::string> known;
  for (const ladder::Rung& rung : ladder::rungs()) {
    if (rung.name == name) return {&rung, {}};
    known.push_back(rung.name);
  }
  std::error_code ignored;
  if (fs::is_regular_file(name, ignored)) return {nullptr, name};
  for (const std::string& file : ladder_files()) {
    if (rung_name(file) == name) return {nullptr, file};
    known.push_back(rung_name(file));
  }
  throw InputError("there is no case file and no rung '{}' (voussoir check --list names all rungs){}", name,
                   suggestion(name, known));
}

std::vector<Step> steps_asked(const std::vector<std::string>& names) {
  if (names.empty()) return all_steps();
  std::vector<Step> steps;
  for (const std::string& name : names) steps.push_back(find_step(name));
  return steps;
}

/// Entry `key` of a list, counted from 0; null if there is none.
const nlohmann::json* entry_of(const nlohmann::json& list, const std::string& key) {
  constexpr std::size_t most_digits = 6;
  if (!list.is_array() || key.empty() || key.size() > most_digits) return nullptr;
  if (key.find_first_not_of("0123456789") != std::string::npos) return nullptr;
  const std::size_t index = std::stoul(key);
  return index < list.size() ? &list[index] : nullptr;
}

/// The number at a path such as "collapse.multiplier" or "quasi_static.0.share". True counts as 1, false as 0, a list
/// as its length.
double value_at(const nlohmann::json& summary, const std::string& place) {
  const nlohmann::json* node = &summary;
  std::size_t from = 0;
  while (from <= place.size()) {
    const std::size_t to = std::min(place.find('.', from), place.size());
    const std::string key = place.substr(from, to - from);
    from = to + 1;
    if (const nlohmann::json* entry = entry_of(*node, key)) {
      node = entry;
      continue;
    }
    if (!node->is_object() || !node->contains(key)) {
      std::string known;
      if (node->is_object())
        for (const auto& [name, value] : node->items()) known += (known.empty() ? "" : ", ") + name;
      throw InputError("summary.json has no '{}'. '{}' must be one of: {}", place, key, known);
    }
    node = &(*node)[key];
  }
  if (node->is_boolean()) return node->get<bool>() ? 1.0 : 0.0;
  if (node->is_array()) return double(node->size());
  if (!node->is_number()) throw InputError("'{}' in summary.json is not a number", place);
  return node->get<double>();
}

/// Runs a case in a folder and returns its summary. A run that fails writes a summary too.
nlohmann::json run_summary(const std::string& text, const std::string& file, const std::string& directory,
                           int threads) {
  const Case c = parse_case(text, file);
  const DirectoryLock lock = prepare_directory(c, directory, true);
  RunRequest request;
  request.directory = directory;
  request.threads = threads;
  request.quiet = true;
  request.pictures = false;
  std::string failure;
  try {
    RunSession(request).run();
  } catch (const RunError& error) {
    failure = error.what();
  }
  const nlohmann::json summary = json_if_any(directory + "/summary.json");
  if (!summary.is_object()) throw RunError("{}", failure.empty() ? "the run was stopped" : failure);
  return summary;
}

/// Settings for running the ladder.
struct Climb {
  std::string folder;  // for the runs
  int threads = 1;
  bool slow_too = false;
};

/// Runs all checks of one file. Checks with the same case text share a run.
std::vector<CheckRow> climb_case(const std::string& file, const Climb& how) {
  const std::string name = rung_name(file);
  std::vector<CheckRow> rows;
  std::map<std::string, nlohmann::json> summaries;
  const std::vector<Check> checks = read_checks(file);
  if (checks.empty()) throw InputError("{} has no [[check]], so there is nothing to compare. Add at least one", file);
  for (const Check& check : checks) {
    if (check.slow && !how.slow_too) continue;
    CheckRow row{name, {check}, {}};
    try {
      auto found = summaries.find(check.text);
      if (found == summaries.end()) {
        const std::string directory = fmt::format("{}/{}_{}", how.folder, name, summaries.size() + 1);
        found = summaries.emplace(check.text, run_summary(check.text, file, directory, how.threads)).first;
      }
      row.finding.got = value_at(found->second, check.value);
    } catch (const RunError& error) {
      row.trouble = error.what();
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<CheckRow> climb_rung(const ladder::Rung& rung, const Climb& how) {
  if (rung.slow && !how.slow_too) return {};
  std::vector<CheckRow> rows;
  try {
    for (ladder::Finding& finding : rung.climb(how.threads)) rows.push_back({rung.name, std::move(finding), {}});
  } catch (const RunError& error) {
    CheckRow row{rung.name, {}, error.what()};
    row.finding.check.quantity = rung.help;
    rows.push_back(row);
  }
  return rows;
}

/// A temporary folder that the destructor removes, or the folder of -o, which stays.
struct RunsFolder {
  std::string path;
  bool keep = false;
  explicit RunsFolder(const std::string& asked) : path(asked), keep(!asked.empty()) {
    std::error_code failed;
    if (keep) {
      fs::create_directories(path, failed);
    } else {
      std::string pattern = (fs::temp_directory_path(failed) / "voussoir-check-XXXXXX").string();
      if (mkdtemp(pattern.data())) path = pattern;
    }
    if (path.empty() || failed) throw InputError("cannot make a folder for the runs. Name one with -o DIR");
  }
  ~RunsFolder() {
    std::error_code ignored;
    if (!keep) fs::remove_all(path, ignored);
  }
};

void list_rung(const ladder::Rung& rung) {
  fmt::print("{:<18} {}{}\n", rung.name, rung.help, rung.slow ? " (long)" : "");
}

void list_case(const std::string& file) {
  for (const Check& c : read_checks(file))
    fmt::print("{:<18} {:<44} {:>10.5g} {:<6} {}{}\n", rung_name(file), c.quantity, c.expected, c.unit, c.source,
               c.slow ? " (long)" : "");
}

void list_steps(const std::vector<Step>& steps) {
  for (const Step& step : steps) step.rung ? list_rung(*step.rung) : list_case(step.file);
}

/// Prints each row as soon as it is known.
std::vector<CheckRow> climb_all(const std::vector<Step>& steps, const Climb& how, bool quiet) {
  std::vector<CheckRow> all;
  if (!quiet) print_check_heading();
  for (const Step& step : steps)
    for (const CheckRow& row : step.rung ? climb_rung(*step.rung, how) : climb_case(step.file, how)) {
      all.push_back(row);
      if (!quiet) print_check_row(row);
    }
  if (!quiet) fmt::print("{}\n", check_count(all));
  if (!quiet && all.empty()) fmt::print("All of these checks are slow. Give --long to run them\n");
  return all;
}

/// Reports a table that cannot be written before the runs, which may take an hour.
void expect_folder_of(const std::string& table) {
  std::error_code ignored;
  const fs::path folder = fs::path(table).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    throw InputError("--table {}: there is no folder {}. Make it first", table, folder.string());
}

int check(const std::vector<std::string>& arguments) {
  CommandLine line("check", "check [NAME|CASE …] [--long] [--table FILE] [-o DIR]",
                   "voussoir check joint-stiffness arch.toml");
  line.described.add_options()("long", "run the slow checks (rungs of the ladder), too")(
      "list", "list the rungs, and the quantities of the cases with their sources; run nothing")(
      "table", options::value<std::string>()->value_name("FILE")->default_value(""),
      "write the results as a Markdown table")("output,o",
                                               options::value<std::string>()->value_name("DIR")->default_value(""),
                                               "keep the run directories, and write check.json, in this folder");
  line.rest = "NAME";
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const auto names = values.count("NAME") ? values["NAME"].as<std::vector<std::string>>() : std::vector<std::string>{};
  const std::vector<Step> steps = steps_asked(names);
  if (values.count("list")) {
    list_steps(steps);
    return 0;
  }
  const std::string table = values["table"].as<std::string>();
  expect_folder_of(table);
  const RunsFolder folder(values["output"].as<std::string>());
  const Climb how = {folder.path, threads_asked(values), values.count("long") > 0};
  const std::vector<CheckRow> rows = climb_all(steps, how, values.count("quiet") > 0);
  if (folder.keep) write_json(folder.path + "/check.json", check_json(rows));
  if (!table.empty()) write_atomically(table, check_markdown(rows, ladder_folder()));
  const auto good = [](const CheckRow& row) { return row.pass() || row.known_miss(); };
  return std::all_of(rows.begin(), rows.end(), good) ? 0 : 1;
}

}  // namespace

Verb check_verb() {
  return {"check", "compare results with known values: the validation ladder, or the expectations of a case", check};
}

}  // namespace voussoir
