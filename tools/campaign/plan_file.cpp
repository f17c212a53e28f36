// The plan in the campaign's folder: campaign.json, and the cases and records that it is made of.
#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "io/case/motion_source.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/json_file.h"
#include "tools/campaign/json.h"
#include "tools/campaign/measures.h"
#include "tools/campaign/plan.h"
#include "tools/campaign/template.h"

namespace voussoir::campaign {

namespace fs = std::filesystem;

namespace {

constexpr const char* format = "voussoir-campaign";
constexpr int format_version = 1;

std::string hex(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

std::uint64_t unhex(const std::string& text, const std::string& place) {
  std::size_t end = 0;
  std::uint64_t value = 0;
  try {
    value = std::stoull(text, &end, 16);
  } catch (const std::exception&) {
  }
  if (text.empty() || end != text.size()) throw InputError("{}: '{}' is not a hash", place, text);
  return value;
}

std::string file_of(const std::string& directory) {
  return directory + "/campaign.json";
}

json run_settings_json(const RunSettings& s) {
  return {{"block_scale", s.block_scale},
          {"set", s.set},
          {"free_after", s.free_after},
          {"fields_every", s.fields_every},
          {"pictures", s.pictures},
          {"keep_checkpoints", s.keep_checkpoints},
          {"fall_displacement", s.fall.displacement},
          {"fall_share", s.fall.share}};
}

RunSettings read_run_settings(const json& j, const std::string& place) {
  RunSettings s;
  s.block_scale = need<double>(j, "block_scale", place);
  s.set = need<std::vector<std::pair<std::string, double>>>(j, "set", place);
  s.free_after = need<double>(j, "free_after", place);
  s.fields_every = need<double>(j, "fields_every", place);
  s.pictures = need<bool>(j, "pictures", place);
  s.keep_checkpoints = need<bool>(j, "keep_checkpoints", place);
  s.fall.displacement = need<double>(j, "fall_displacement", place);
  s.fall.share = need<double>(j, "fall_share", place);
  return s;
}

json engine_json(const EngineSettings& e) {
  return {{"kind", e.kind},      {"runs_at_once", e.runs_at_once}, {"threads", e.threads}, {"time_limit", e.time_limit},
          {"memory", e.memory},  {"partition", e.partition},       {"account", e.account}, {"qos", e.qos},
          {"options", e.options}};
}

EngineSettings read_engine(const json& j, const std::string& place) {
  EngineSettings e;
  e.kind = need<std::string>(j, "kind", place);
  e.runs_at_once = need<int>(j, "runs_at_once", place);
  e.threads = need<int>(j, "threads", place);
  e.time_limit = need<double>(j, "time_limit", place);
  e.memory = need<double>(j, "memory", place);
  e.partition = need<std::string>(j, "partition", place);
  e.account = need<std::string>(j, "account", place);
  e.qos = need<std::string>(j, "qos", place);
  e.options = need<std::vector<std::string>>(j, "options", place);
  return e;
}

/// The measures of one run: those of its record, scaled.
json intensity_json(const Plan& plan, const PlannedRun& run) {
  const std::vector<Measure> list = measures(plan.periods);
  json intensity = json::object();
  for (std::size_t i = 0; i < list.size(); ++i)
    intensity[list[i].name] =
        number_json(plan.records[run.record].measures[i] * std::pow(run.scale, double(list[i].power)));
  return intensity;
}

json run_json(const Plan& plan, const PlannedRun& run) {
  json values = json::object();
  for (std::size_t k = 0; k < plan.keys.size(); ++k) values[plan.keys[k]] = run.values[k];
  return {{"id", run.id},
          {"case", plan.cases[run.case_number].name},
          {"record", plan.records[run.record].name},
          {"event", plan.records[run.record].event},
          {"scale", run.scale},
          {"sample", run.sample > 0 ? json(run.sample) : json()},
          {"values", values},
          {"folder", "runs/" + run.id},
          {"hash", hex(run.hash)},
          {"intensity", intensity_json(plan, run)}};
}

json plan_json(const Plan& plan) {
  json j = {{"format", format},
            {"format_version", format_version},
            {"program_version", VOUSSOIR_VERSION},
            {"file", plan.file},
            {"keys", plan.keys},
            {"periods", plan.periods},
            {"settings", run_settings_json(plan.run)},
            {"engine", engine_json(plan.engine)},
            {"cases", json::array()},
            {"records", json::array()},
            {"left_out", plan.left_out},
            {"limit_states", json::array()},
            {"runs", json::array()}};
  for (const PlannedCase& c : plan.cases)
    j["cases"].push_back({{"name", c.name}, {"folder", "cases/" + c.slug}, {"hash", hex(c.hash)}});
  for (const PlannedRecord& r : plan.records) {
    json values = json::array();
    for (const double value : r.measures) values.push_back(number_json(value));
    j["records"].push_back({{"name", r.name},
                            {"event", r.event},
                            {"folder", "records/" + r.slug},
                            {"hash", hex(r.hash)},
                            {"duration", r.duration},
                            {"measures", values}});
  }
  for (const PlannedLimit& limit : plan.limit_states)
    j["limit_states"].push_back({{"name", limit.name},
                                 {"demand", limit.demand},
                                 {"threshold", limit.threshold},
                                 {"case", limit.only.empty() ? json() : json(limit.only)}});
  for (const PlannedRun& run : plan.runs) j["runs"].push_back(run_json(plan, run));
  return j;
}

std::string slug_in(const json& j, const std::string& place) {
  return fs::path(need<std::string>(j, "folder", place)).filename().string();
}

void read_records(const json& j, const std::string& path, Plan& plan) {
  for (const json& r : j) {
    const std::string place = path + ": a record";
    PlannedRecord record{need<std::string>(r, "name", place),
                         need<std::string>(r, "event", place),
                         slug_in(r, place),
                         unhex(need<std::string>(r, "hash", place), place),
                         need<double>(r, "duration", place),
                         {}};
    for (const json& value : need<json>(r, "measures", place))
      record.measures.push_back(value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN());
    if (record.measures.size() != measures(plan.periods).size())
      throw InputError("{}: record \"{}\" has {}, expected {}", path, record.name,
                       counted(record.measures.size(), "measure"), measures(plan.periods).size());
    plan.records.push_back(record);
  }
}

template <class List>
std::size_t index_of(const List& list, const std::string& name, const std::string& place) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return i;
  throw InputError("{}: there is no \"{}\"", place, name);
}

void read_runs(const json& j, const std::string& path, Plan& plan) {
  for (const json& r : j) {
    const std::string place = fmt::format("{}: run number {}", path, plan.runs.size() + 1);
    PlannedRun run;
    run.id = need<std::string>(r, "id", place);
    if (run.id.empty() || run.id.find_first_of("/\\") != std::string::npos || run.id.starts_with('.'))
      throw InputError("{}: '{}' is not the name of a run", place, run.id);
    run.case_number = index_of(plan.cases, need<std::string>(r, "case", place), place);
    run.record = index_of(plan.records, need<std::string>(r, "record", place), place);
    run.scale = need<double>(r, "scale", place);
    run.sample = value_or<int>(r, "sample", 0, place);
    const json values = need<json>(r, "values", place);
    for (const std::string& key : plan.keys) run.values.push_back(need<double>(values, key.c_str(), place));
    run.hash = unhex(need<std::string>(r, "hash", place), place);
    plan.runs.push_back(run);
  }
}

void write_case(const Case& c, const PlannedCase& planned, const std::string& directory) {
  const std::string folder = directory + "/cases/" + planned.slug;
  fs::create_directories(folder);
  write_self_contained_case(c, folder);
  write_atomically(folder + "/case.toml", text_of(portable(c)));
}

void write_record(const Shaking& shaking, const PlannedRecord& planned, const std::string& directory) {
  const std::string folder = directory + "/records/" + planned.slug;
  fs::create_directories(folder);
  std::array<std::string, 3> names;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (shaking.source.files[axis].empty()) continue;
    names[axis] = std::string(1, "xyz"[axis]) + ".txt";
    write_atomically(folder + "/" + names[axis], shaking.source.texts[axis]);
  }
  write_atomically(folder + "/motion.toml", motion_source_text(shaking.source, names));
}

/// Throws InputError unless all runs of the plan in the folder are part of this one.
void check_extends(const Plan& plan, const std::string& directory) {
  const Plan old = read_plan(directory);
  std::map<std::string, std::uint64_t> hashes;
  for (const PlannedRun& run : plan.runs) hashes[run.id] = run.hash;
  const char* remedy = "put the campaign file back, or choose another folder with -o DIR";
  for (const PlannedRun& run : old.runs) {
    const auto found = hashes.find(run.id);
    if (found == hashes.end())
      throw InputError(
          "{} contains the run {}, which this campaign no longer has: {}. You may add runs, but not remove them",
          directory, run.id, remedy);
    if (found->second != run.hash)
      throw InputError("{} contains the run {}, but its case, record, sample or duration has changed: {}", directory,
                       run.id, remedy);
  }
}

void check_free(const std::string& directory) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored)) {
    const std::string name = entry.path().filename().string();
    const bool ours = name == "cases" || name == "records" || name == "campaign.toml" ||
                      (name == "runs" && fs::is_empty(entry.path(), ignored)) || name.ends_with(unfinished_suffix);
    if (!ours)
      throw InputError("{} contains files that are not part of a campaign ({}). Choose another folder with -o DIR",
                       directory, name);
  }
}

}  // namespace

bool holds_plan(const std::string& directory) {
  std::error_code ignored;
  return fs::is_regular_file(file_of(directory), ignored);
}

Plan read_plan(const std::string& directory) {
  const std::string path = file_of(directory);
  if (!holds_plan(directory)) throw InputError("{} contains no campaign: there is no campaign.json", directory);
  const json j = read_json(path);
  if (value_or<std::string>(j, "format", "", path) != format)
    throw InputError("{} is not the plan of a campaign. Its format must be \"{}\"", path, format);
  if (const int version = need<int>(j, "format_version", path); version > format_version)
    throw InputError("{} has format_version {}. This program reads versions up to {}: use a newer voussoir", path,
                     version, format_version);
  Plan plan;
  plan.file = need<std::string>(j, "file", path);
  plan.keys = need<std::vector<std::string>>(j, "keys", path);
  plan.periods = need<std::vector<double>>(j, "periods", path);
  plan.run = read_run_settings(need<json>(j, "settings", path), path);
  plan.engine = read_engine(need<json>(j, "engine", path), path);
  plan.left_out =
      value_or<std::vector<std::string>>(j, "left_out", {}, path);  // plans of earlier versions do not have this list
  for (const json& c : need<json>(j, "cases", path))
    plan.cases.push_back(
        {need<std::string>(c, "name", path), slug_in(c, path), unhex(need<std::string>(c, "hash", path), path)});
  read_records(need<json>(j, "records", path), path, plan);
  for (const json& l : need<json>(j, "limit_states", path))
    plan.limit_states.push_back(
        {{need<std::string>(l, "name", path), need<std::string>(l, "demand", path), need<double>(l, "threshold", path)},
         value_or<std::string>(l, "case", "", path)});
  read_runs(need<json>(j, "runs", path), path, plan);
  return plan;
}

void write_draft(const Draft& draft, const std::string& directory) {
  const std::string text = json_text(plan_json(draft.plan), 1);
  if (!holds_plan(directory))
    check_free(directory);
  else if (check_extends(draft.plan, directory); read_text(file_of(directory)) == text)
    return;
  std::error_code failed;
  fs::create_directories(directory + "/runs", failed);
  if (failed)
    throw InputError("the folder {} cannot be made: {}. Choose another with -o DIR", directory, failed.message());
  for (std::size_t i = 0; i < draft.cases.size(); ++i) write_case(draft.cases[i], draft.plan.cases[i], directory);
  for (std::size_t i = 0; i < draft.records.size(); ++i)
    write_record(draft.records[i], draft.plan.records[i], directory);
  write_atomically(directory + "/campaign.toml", draft.text);
  write_atomically(file_of(directory), text);  // written last, so that a reader finds all other files
}

}  // namespace voussoir::campaign
