// voussoir check: runs cases that say what they should give, and compares.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/case/checks.h"
#include "io/hdf5/atomic_file.h"
#include "solver/base/error.h"
#include "tools/voussoir/run_directory.h"
#include "tools/voussoir/run_session.h"
#include "tools/voussoir/verb.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

struct Row {
  std::string name;  // of the rung
  Check check;
  double got = std::nan("");
  std::string trouble;  // why there is no value
  double error() const { return check.absolute ? got - check.expected : got / check.expected - 1.0; }
  bool pass() const { return trouble.empty() && std::abs(error()) <= check.tolerance; }
};

/// Where the rungs of the ladder are: beside the present folder, or in the source tree the program was built from.
std::string ladder_folder() {
  std::error_code ignored;
  const std::string here = "cases/validation";
  return fs::is_directory(here, ignored) ? here : VOUSSOIR_SOURCE_DIR "/" + here;
}

std::vector<std::string> rung_files(const std::vector<std::string>& names) {
  const std::string folder = ladder_folder();
  std::vector<std::string> files;
  std::error_code ignored;
  for (const std::string& name : names) {
    const std::string rung = folder + "/" + name + ".toml";
    if (fs::is_regular_file(name, ignored)) {
      files.push_back(name);
    } else if (fs::is_regular_file(rung, ignored)) {
      files.push_back(rung);
    } else {
      throw InputError("there is no case file {} and no rung {}; voussoir check --list names the rungs", name, rung);
    }
  }
  if (!names.empty()) return files;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  if (files.empty()) throw InputError("there is no validation case in {}; name a case file with [[check]]", folder);
  std::sort(files.begin(), files.end());
  return files;
}

/// The number at a place like "collapse.multiplier"; true counts as 1, false as 0.
double value_at(const nlohmann::json& summary, const std::string& place) {
  const nlohmann::json* node = &summary;
  std::size_t from = 0;
  while (from <= place.size()) {
    const std::size_t to = std::min(place.find('.', from), place.size());
    const std::string key = place.substr(from, to - from);
    if (!node->is_object() || !node->contains(key)) {
      std::string known;
      if (node->is_object())
        for (const auto& [name, value] : node->items()) known += (known.empty() ? "" : ", ") + name;
      throw InputError("summary.json has no '{}': '{}' is none of: {}", place, key, known);
    }
    node = &(*node)[key];
    from = to + 1;
  }
  if (node->is_boolean()) return node->get<bool>() ? 1.0 : 0.0;
  if (node->is_array()) return double(node->size());
  if (!node->is_number()) throw InputError("'{}' in summary.json is no number", place);
  return node->get<double>();
}

/// Runs a case in a folder; a run that fails has a summary too.
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
  std::ifstream in(directory + "/summary.json");
  if (!in) throw RunError("{}", failure.empty() ? "the run was stopped" : failure);
  return nlohmann::json::parse(in);
}

/// All checks of one file; those with the same case share a run.
std::vector<Row> climb(const std::string& file, const std::string& folder, int threads, bool slow_too) {
  const std::string name = fs::path(file).stem().string();
  std::vector<Row> rows;
  std::map<std::string, nlohmann::json> summaries;
  const std::vector<Check> checks = read_checks(file);
  if (checks.empty()) throw InputError("{} has no [[check]]: nothing to compare", file);
  for (const Check& check : checks) {
    if (check.slow && !slow_too) continue;
    Row row{name, check, std::nan(""), {}};
    try {
      auto found = summaries.find(check.text);
      if (found == summaries.end()) {
        const std::string directory = fmt::format("{}/{}_{}", folder, name, summaries.size() + 1);
        found = summaries.emplace(check.text, run_summary(check.text, file, directory, threads)).first;
      }
      row.got = value_at(found->second, check.value);
    } catch (const RunError& error) {
      row.trouble = error.what();
    }
    rows.push_back(row);
  }
  return rows;
}

std::string error_text(const Row& row) {
  if (!row.trouble.empty()) return "none";
  return row.check.absolute ? fmt::format("{:+.2g}", row.error()) : fmt::format("{:+.2f} %", 100.0 * row.error());
}

std::string tolerance_text(const Check& check) {
  return check.absolute ? fmt::format("{:.3g}", check.tolerance) : fmt::format("{:.3g} %", 100.0 * check.tolerance);
}

void print_row(const Row& row) {
  const Check& c = row.check;
  fmt::print("{:<22} {:<46} {:>11.5g} {:>11.5g} {:<6} {:>10} {:>8}  {}\n", row.name, c.quantity, c.expected, row.got,
             c.unit, error_text(row), tolerance_text(c), row.pass() ? "ok" : "MISS");
  if (!row.trouble.empty()) fmt::print("  {}\n", row.trouble);
  std::fflush(stdout);
}

nlohmann::json to_json(const std::vector<Row>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const Row& row : rows)
    list.push_back({{"name", row.name},
                    {"quantity", row.check.quantity},
                    {"unit", row.check.unit},
                    {"expected", row.check.expected},
                    {"got", row.trouble.empty() ? nlohmann::json(row.got) : nlohmann::json()},
                    {"error", row.trouble.empty() ? nlohmann::json(row.error()) : nlohmann::json(row.trouble)},
                    {"tolerance", row.check.tolerance},
                    {"absolute", row.check.absolute},
                    {"source", row.check.source},
                    {"pass", row.pass()}});
  return list;
}

/// A folder of its own that goes away, unless the user named one.
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
    if (path.empty() || failed) throw InputError("cannot make a folder for the runs; name one with -o DIR");
  }
  ~RunsFolder() {
    std::error_code ignored;
    if (!keep) fs::remove_all(path, ignored);
  }
};

void list_rungs(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    for (const Check& c : read_checks(file))
      fmt::print("{:<22} {:<46} {:>11.5g} {:<6} {}{}\n", fs::path(file).stem().string(), c.quantity, c.expected, c.unit,
                 c.source, c.slow ? " (long)" : "");
}

int check(const std::vector<std::string>& arguments) {
  CommandLine line("check", "check [NAME|CASE …] [--long] [-o DIR]", "voussoir check oppenheim semicircle");
  line.described.add_options()("long", "the slow rungs too")("list", "name the rungs, run nothing")(
      "output,o", options::value<std::string>()->value_name("DIR")->default_value(""),
      "keep the runs, and check.json, in this folder");
  line.rest = "NAME";
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const auto names = values.count("NAME") ? values["NAME"].as<std::vector<std::string>>() : std::vector<std::string>{};
  const std::vector<std::string> files = rung_files(names);
  if (values.count("list")) {
    list_rungs(files);
    return 0;
  }
  const bool quiet = values.count("quiet") > 0;
  const RunsFolder folder(values["output"].as<std::string>());
  if (!quiet)
    fmt::print("{:<22} {:<46} {:>11} {:>11} {:<6} {:>10} {:>8}\n", "rung", "quantity", "expected", "got", "unit",
               "error", "allowed");
  std::vector<Row> all;
  for (const std::string& file : files)
    for (const Row& row : climb(file, folder.path, threads_asked(values), values.count("long") > 0)) {
      all.push_back(row);
      if (!quiet) print_row(row);
    }
  if (folder.keep) write_atomically(folder.path + "/check.json", to_json(all).dump(2) + "\n");
  const auto missed = std::count_if(all.begin(), all.end(), [](const Row& row) { return !row.pass(); });
  if (!quiet) fmt::print("{} of {} quantities within their tolerance\n", std::int64_t(all.size()) - missed, all.size());
  return missed == 0 ? 0 : 1;
}

}  // namespace

Verb check_verb() {
  return {"check", "runs validation cases and compares them with what they should give", check};
}

}  // namespace voussoir
