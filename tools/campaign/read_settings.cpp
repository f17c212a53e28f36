#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "io/case/limits.h"
#include "io/case/motion_source.h"
#include "io/case/sections.h"
#include "io/records/sets.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "tools/campaign/engine.h"
#include "tools/campaign/measures.h"
#include "tools/campaign/settings.h"

namespace voussoir::campaign {

namespace fs = std::filesystem;

const std::vector<std::string>& distributions() {
  static const std::vector<std::string> names = {"lognormal", "normal", "uniform"};
  return names;
}

namespace {

constexpr int most_samples = 10000;

void refuse_twice(const TableReader& table, const std::string& key, std::vector<double> values) {
  std::ranges::sort(values);
  if (const auto twice = std::ranges::adjacent_find(values); twice != values.end())
    table.fail(key, fmt::format("contains {} twice. Remove one: runs are identified by it", *twice));
}

Sampled read_sampled(TableReader& table) {
  Sampled s;
  if (!table.has("key")) table.missing("key", "such as \"materials.masonry.youngs_modulus\", or a list of such keys");
  s.keys = table.texts("key");
  if (s.keys.empty()) table.fail("key", "is empty. Name a number of the case");
  s.distribution = Sampled::Distribution(table.required_word("distribution", distributions()));
  s.own_mean = table.has("mean");
  s.mean = table.number("mean", 0.0);
  if (s.own_mean && s.keys.size() > 1)
    table.fail("mean",
               "is given for several keys. Leave it out (each key then has the value of the case as its mean), or use "
               "one table for each key");
  const bool uniform = s.distribution == Sampled::Distribution::uniform;
  if (uniform && (table.has("low") || table.has("high"))) {
    s.low = table.required_number("low");
    s.high = table.required_number("high");
    for (const char* key : {"mean", "cov", "deviation"})
      if (table.has(key))
        table.fail(key, "and 'low', 'high' both define the width of a uniform distribution. Remove one of the two");
  } else {
    if (table.has("cov") == table.has("deviation"))
      table.missing("cov", "standard deviation divided by mean, or 'deviation' in the unit of the key, not both");
    s.cov = table.number("cov", 0.0, {0.0, 10.0, "", true});
    s.deviation = table.number("deviation", 0.0, {0.0, 1e300, "", true});
    if (!uniform) s.low = table.number("low", s.low), s.high = table.number("high", s.high);
  }
  if (!uniform && s.keys.size() > 1 && (table.has("low") || table.has("high")))
    table.fail("low", "and 'high' cannot limit several keys that are drawn together. Leave them out");
  if (!(s.low < s.high)) table.fail("low", fmt::format("is {}. It must be below 'high', {}", s.low, s.high));
  table.finish();
  return s;
}

/// [[record]]: the keys of a motion stage, and a name.
Shaking read_shaking(TableReader& table, const std::string& path) {
  Shaking s;
  s.name = table.required_text("name");
  if (s.name.empty()) table.fail("name", "is empty. The table needs a name");
  s.event = table.text("event", s.name);
  if (table.has("scale"))
    table.fail("scale", "is not a key of a record. Use 'factor' for one record, or 'scales' of the campaign for all");
  s.source = read_motion_source(table, path, 10.0);
  s.source.scale = table.number("factor", 1.0, {-1e6, 1e6, ""});
  table.finish();
  return s;
}

/// axes = ["x", "y"]: the components that are used; the others are removed.
void keep_axes(TableReader& campaign, std::vector<Shaking>& records) {
  if (!campaign.has("axes")) return;
  const std::vector<std::string> names = {"x", "y", "z"};
  std::array<bool, 3> kept = {};
  for (const std::string& name : campaign.texts("axes")) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) campaign.fail("axes", fmt::format("contains \"{}\". Each axis must be x, y or z", name));
    kept[std::size_t(found - names.begin())] = true;
  }
  for (Shaking& record : records) {
    bool any = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!kept[axis]) record.source.files[axis].clear(), record.source.texts[axis].clear();
      any |= !record.source.files[axis].empty();
    }
    if (!any)
      campaign.fail("axes",
                    fmt::format("removes all components of record '{}'. Name an axis along which it has a component",
                                record.name));
  }
}

bool is_folder(const std::string& place) {
  std::error_code ignored;
  return fs::is_directory(place, ignored);
}

/// The recordings of selections and folders, one after the other.
void read_places(TableReader& campaign, Settings& s) {
  std::vector<std::string> places;
  for (const std::string& name : campaign.texts("records")) places.push_back(relative_to(s.path, name));
  if (places.empty()) campaign.fail("records", "is empty. Name a selection.json or a folder of record files");
  if (std::ranges::none_of(places, is_folder))
    for (const char* key : {"units", "dt"})
      if (campaign.has(key))
        campaign.fail(
            key,
            "applies only to record files with plain columns in a folder. A selection.json contains it: leave it out");
  const std::vector<std::string>& units = acceleration_units();
  const std::string unit = units[campaign.word("units", units, 0)];
  const double dt = campaign.number("dt", 0.005, {1e-5, 1.0, "s"});
  const bool correct = campaign.flag("correct", false);
  for (const std::string& place : places) {
    if (std::error_code ignored; !is_folder(place) && !fs::is_regular_file(place, ignored))
      campaign.fail("records", fmt::format("names \"{}\". This file or folder does not exist", place));
    std::vector<Shaking> records =
        is_folder(place) ? read_folder(place, unit, dt, correct, s.left_out) : read_selection(place, correct);
    std::ranges::move(records, std::back_inserter(s.records));
  }
}

void read_records(TableReader& root, TableReader& campaign, Settings& s) {
  std::vector<TableReader> tables = root.tables("record");
  const bool named = campaign.has("records");
  if (named == !tables.empty()) {
    if (named) campaign.fail("records", "and [[record]] are both given. Remove one of the two");
    campaign.missing("records", "a selection.json, a folder of record files, or [[record]] tables");
  }
  if (!named)
    for (const char* key : {"units", "dt", "correct", "axes"})
      if (campaign.has(key)) campaign.fail(key, "applies only to 'records'. Give it in each [[record]]");
  for (TableReader& table : tables) s.records.push_back(read_shaking(table, s.path));
  if (!named) return;
  read_places(campaign, s);
  keep_axes(campaign, s.records);
}

void check_names(const TableReader& root, const Settings& s) {
  std::vector<std::string> names;
  for (const Shaking& record : s.records) names.push_back(record.name);
  std::ranges::sort(names);
  if (const auto twice = std::ranges::adjacent_find(names); twice != names.end())
    root.fail(fmt::format("has two records with the name \"{}\". The table needs different names: rename one", *twice));
}

void read_cases(TableReader& campaign, Settings& s) {
  if (!campaign.has("cases")) campaign.missing("cases", "a list of case files");
  for (const std::string& name : campaign.texts("cases")) {
    s.cases.push_back(relative_to(s.path, name));
    if (std::error_code ignored; !fs::is_regular_file(s.cases.back(), ignored))
      campaign.fail("cases", fmt::format("names \"{}\": there is no such file", s.cases.back()));
  }
  if (s.cases.empty()) campaign.fail("cases", "is empty. Name at least one case file");
}

void read_samples(TableReader& campaign, Settings& s) {
  for (TableReader& table : campaign.tables("sample")) s.sampled.push_back(read_sampled(table));
  s.samples = int(campaign.integer("samples", 0, 1, most_samples));
  s.seed = std::uint64_t(campaign.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  if (s.samples > 0 && s.sampled.empty())
    campaign.fail("samples", "is given, but nothing is sampled. Add [[campaign.sample]] tables or remove it");
  if (s.samples == 0 && !s.sampled.empty())
    campaign.missing("samples", "the number of samples drawn from [[campaign.sample]]");
}

/// [campaign.set]: "damping.ratio" = 0.03.
void read_set(TableReader& campaign, Settings& s) {
  auto table = campaign.table("set", "[campaign.set]");
  if (!table) return;
  for (const std::string& key : table->keys()) {
    const auto holds = [&](const Sampled& sampled) { return std::ranges::count(sampled.keys, key) > 0; };
    if (std::ranges::any_of(s.sampled, holds)) table->fail(key, "is also sampled. Remove one of the two");
    s.run.set.emplace_back(key, table->required_number(key));
  }
  table->finish();
}

void read_output(TableReader& campaign, Settings& s) {
  s.run.fields_every = campaign.number("fields_every", -1.0, {0.0, 1e6, "s"});
  s.run.pictures = campaign.flag("pictures", false);
  s.run.keep_checkpoints = campaign.flag("keep_checkpoints", false);
  s.periods = {0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.75, 1.0, 1.5, 2.0};
  if (campaign.has("periods")) s.periods = campaign.number_list("periods", {0.01, 20.0, "s"});
  for (const double t : s.periods)
    if (std::abs(100.0 * t - std::round(100.0 * t)) > 1e-6)
      campaign.fail(
          "periods",
          fmt::format("contains {} s. Give periods in whole hundredths of a second, because they name the columns", t));
  refuse_twice(campaign, "periods", s.periods);
  if (auto fall = campaign.table("fall", "[campaign.fall]")) {
    s.run.fall.displacement = fall->number("displacement", s.run.fall.displacement, {0.0, 1e3, "m", true});
    s.run.fall.share = fall->number("share", s.run.fall.share, {0.0, 1.0, "(of the mass; 0: never)"});
    fall->finish();
  }
}

/// Removes the quiet part before the significant part of records. The plan removes the part after it.
void leave_out_quiet(Settings& s, bool significant) {
  s.significant = significant;
  for (Shaking& shaking : s.records)
    if (significant && shaking.source.kind == MotionSource::Kind::record && shaking.source.begin == 0.0)
      shaking.source.begin = significant_begin(ground_motion(shaking.source));
}

void read_campaign(TableReader& root, Settings& s) {
  auto campaign = root.table("campaign", "[campaign]");
  if (!campaign) root.missing("campaign", "a table with cases and records");
  read_cases(*campaign, s);
  read_records(root, *campaign, s);
  if (campaign->has("scales")) s.scales = campaign->number_list("scales", {0.0, 1e6, "", true});
  refuse_twice(*campaign, "scales", s.scales);
  s.run.block_scale = campaign->number("block_scale", 0.0, {0.0, 100.0, "", true});
  if (campaign->is_text("duration"))
    leave_out_quiet(s, campaign->word("duration", {"significant"}, 0) == 0);
  else
    s.duration = campaign->number("duration", 0.0, {0.0, 1e6, "s", true});
  s.run.free_after = campaign->number("free_after", 0.0, {0.0, 1e6, "s", true});
  read_samples(*campaign, s);
  read_set(*campaign, s);
  read_output(*campaign, s);
  campaign->finish();
}

void read_engine(TableReader& root, Settings& s) {
  auto table = root.table("engine", "[engine]");
  if (!table) return;
  EngineSettings& e = s.engine;
  std::vector<std::string> kinds;
  for (const Engine& engine : engines()) kinds.push_back(engine.name);
  e.kind = kinds[table->word("kind", kinds, 0)];
  e.runs_at_once = int(table->integer("runs_at_once", 0, 1, 100000));
  e.threads = int(table->integer("threads", 0, 1, 1024));
  e.time_limit = table->number("time_limit", 0.0, {0.0, 1e8, "s", true});
  e.memory = table->number("memory", 0.0, {0.0, 1e9, "MB", true});
  e.partition = table->text("partition", "");
  e.account = table->text("account", "");
  e.qos = table->text("qos", "");
  if (table->has("options")) e.options = table->texts("options");
  for (const std::string& option : e.options)
    if (!option.starts_with("--"))
      table->fail(
          "options",
          fmt::format("contains \"{}\". Each option must be one word for sbatch, such as \"--constraint=avx512\"",
                      option));
  table->finish();
}

void read_limit_states(TableReader& root, Settings& s) {
  for (TableReader& table : root.tables("limit_state")) {
    PlannedLimit limit;
    static_cast<DemandLimit&>(limit) = read_limit(table);
    limit.only = table.text("case", "");
    table.finish();
    s.limit_states.push_back(limit);
  }
}

}  // namespace

Settings read_settings(const std::string& path) {
  Settings s;
  s.path = path;
  s.text = read_text(path);
  const toml::table file = parse_toml(s.text, path);
  TableReader root(file, path, "the campaign");
  if (!root.has("campaign") && root.has("bridge"))
    throw InputError("{} is a case, not a campaign. Run it with voussoir run, or name it in 'cases' of a campaign file",
                     path);
  for (const auto read : {read_campaign, read_engine, read_limit_states}) root.attempt([&] { read(root, s); });
  root.finish();
  check_names(root, s);
  return s;
}

}  // namespace voussoir::campaign
