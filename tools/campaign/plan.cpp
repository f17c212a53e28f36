#include "tools/campaign/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "io/case/motion_source.h"
#include "solver/base/arrays.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "tools/campaign/measures.h"
#include "tools/campaign/sample.h"
#include "tools/campaign/template.h"

namespace voussoir::campaign {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t longest_slug = 40, most_runs = 100000;

std::uint64_t more(std::uint64_t hash, const std::string& text) {
  hash = hash_bytes(text.data(), text.size(), hash);
  return hash_bytes("", 1, hash);  // the boundary between texts is part of the hash
}

std::uint64_t more(std::uint64_t hash, double value) {
  return hash_bytes(&value, sizeof value, hash);
}

std::uint64_t case_hash(const Case& c) {
  return c.assembly_file.empty() ? c.hash : more(c.hash, read_text(c.assembly_file));
}

std::uint64_t source_hash(const MotionSource& source) {
  std::uint64_t hash = hash_text(motion_source_text(source, {}));
  for (const std::string& text : source.texts) hash = more(hash, text);
  return hash;
}

/// The stem of the file name, with its folder if another file has the same stem.
std::vector<std::string> case_names(const std::vector<std::string>& files) {
  std::vector<std::string> stems, names;
  for (const std::string& file : files) stems.push_back(fs::path(file).stem().string());
  for (std::size_t i = 0; i < files.size(); ++i) {
    const bool alone = std::ranges::count(stems, stems[i]) == 1;
    const std::string folder = fs::absolute(files[i]).lexically_normal().parent_path().filename().string();
    names.push_back(alone ? stems[i] : folder + "/" + stems[i]);
    if (std::find(names.begin(), names.end() - 1, names.back()) != names.end() - 1)
      throw InputError("two cases have the name \"{}\". The table needs different names: rename a file", names.back());
  }
  return names;
}

void plan_cases(const Settings& s, Draft& draft) {
  const std::vector<std::string> names = case_names(s.cases);
  std::vector<std::string> taken;
  for (std::size_t i = 0; i < s.cases.size(); ++i) {
    const Case c = read_case(s.cases[i], CaseUse::geometry);  // its own motion is not needed
    motion_stage(c);
    draft.plan.cases.push_back({names[i], slug(names[i], "case", taken), case_hash(c)});
    for (const DemandLimit& limit : c.limits) draft.plan.limit_states.push_back({limit, names[i]});
    draft.cases.push_back(c);
  }
  for (const PlannedLimit& limit : s.limit_states)
    if (!limit.only.empty() && std::ranges::find(names, limit.only) == names.end())
      throw InputError("{}: limit state \"{}\" names the unknown case \"{}\"{}", s.path, limit.name, limit.only,
                       suggestion(limit.only, names));
}

PlannedRecord plan_record(const Settings& s, const Shaking& shaking, std::vector<std::string>& taken) {
  const GroundMotion motion = ground_motion(shaking.source);
  PlannedRecord r;
  r.name = shaking.name;
  r.event = shaking.event;
  r.slug = slug(shaking.name, "record", taken);
  r.hash = source_hash(shaking.source);
  r.duration = s.significant ? significant_end(motion) : motion.duration();
  if (s.duration > 0.0) r.duration = std::min(r.duration, s.duration);
  double peak = 0.0;
  for (const Vec3& a : motion.acceleration) peak = std::max(peak, a.cwiseAbs().maxCoeff());
  if (!(peak > 0.0) || !(r.duration > 0.0))
    throw InputError("{}: record \"{}\" does not move the ground. Check its files and its factor", s.path, r.name);
  if (const double most = peak * std::ranges::max(s.scales); !(most <= largest_peak))
    throw InputError(
        "{}: record \"{}\" has a peak of {:.3g} m/s2 at the largest scale. It must be at most {:g}. Check its unit, "
        "its factor and 'scales'",
        s.path, r.name, most, largest_peak);
  r.measures = measure(first_part(motion, r.duration), s.periods);
  return r;
}

/// The values of all keys of one case for each sample.
std::vector<std::vector<double>> draw_samples(const Settings& s, const Case& c) {
  std::vector<std::vector<double>> samples(std::size_t(std::max(1, s.samples)));
  for (const Sampled& sampled : s.sampled)
    for (const std::string& key : sampled.keys) {
      if (key.starts_with("stage."))
        throw InputError("{}: '{}' belongs to a stage. Keys of stages cannot be sampled", s.path, key);
      if (key == "bridge.block_scale" && s.run.block_scale > 0.0)
        throw InputError("{}: '{}' is sampled, but 'block_scale' of [campaign] also sets it. Remove one of the two",
                         s.path, key);
      const double mean = number_at(c, key);
      for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i].push_back(draw(sampled, key, mean, s.seed, int(i) + 1));
    }
  return samples;
}

/// Checks that the keys set in all runs are numbers of the case.
void check_set(const Settings& s, const Case& c) {
  for (const auto& [key, value] : s.run.set) try {
      if (key.starts_with("stage.")) throw InputError("'{}' belongs to a stage. Keys of stages cannot be set", key);
      number_at(c, key);
    } catch (const InputError& error) {
      throw InputError("{}: [campaign.set]: {}", s.path, error.what());
    }
}

/// The text of a case with the changes that all runs share.
toml::table changed(toml::table table, const Plan& plan, const std::vector<double>& values) {
  if (plan.run.block_scale > 0.0) set_number(table, "bridge.block_scale", plan.run.block_scale);
  for (const auto& [key, value] : plan.run.set) set_number(table, key, value);
  if (plan.run.fields_every >= 0.0) set_number(table, "output.fields_every", plan.run.fields_every);
  for (std::size_t k = 0; k < plan.keys.size(); ++k) set_number(table, plan.keys[k], values[k]);
  return table;
}

/// Checks that each case is valid for all samples.
void check_samples(const Settings& s, const Plan& plan, const Case& c,
                   const std::vector<std::vector<double>>& samples) {
  const toml::table file = written_out(c);
  for (std::size_t i = 0; i < samples.size(); ++i) try {
      parse_case(text_of(changed(file, plan, samples[i])), c.path, CaseUse::geometry);
    } catch (const InputError& error) {
      if (s.samples == 0) throw InputError("{}: with the changes by the campaign, {}", s.path, error.what());
      throw InputError(
          "{}: sample {} is not possible: {} Give its [[campaign.sample]] a narrower spread, or 'low' and 'high'",
          s.path, i + 1, error.what());
    }
}

std::uint64_t run_hash(const Plan& plan, const PlannedRun& run) {
  const PlannedRecord& record = plan.records[run.record];
  std::uint64_t hash = plan.cases[run.case_number].hash;
  hash = hash_bytes(&record.hash, sizeof record.hash, hash);
  for (const double value : {record.duration, run.scale, plan.run.block_scale, plan.run.free_after,
                             plan.run.fall.displacement, plan.run.fall.share})
    hash = more(hash, value);
  for (const auto& [key, value] : plan.run.set) hash = more(more(hash, key), value);
  for (std::size_t k = 0; k < plan.keys.size(); ++k) hash = more(more(hash, plan.keys[k]), run.values[k]);
  return hash;
}

std::string run_id(const Plan& plan, const PlannedRun& run) {
  std::string id =
      fmt::format("{}__{}__x{}", plan.cases[run.case_number].slug, plan.records[run.record].slug, run.scale);
  if (run.sample > 0) id += fmt::format("__s{}", run.sample);
  std::ranges::replace(id, '+', '-');  // of 1e+06
  return id;
}

void plan_runs(const Settings& s, Draft& draft) {
  Plan& plan = draft.plan;
  const std::size_t samples = std::size_t(std::max(1, s.samples));
  if (const std::size_t all = s.cases.size() * s.records.size() * s.scales.size() * samples; all > most_runs)
    throw InputError("{}: {} × {} × {} × {} are {} runs. At most {} are allowed: split the campaign", s.path,
                     counted(s.cases.size(), "case"), counted(s.records.size(), "record"),
                     counted(s.scales.size(), "scale"), counted(samples, "sample"), all, most_runs);
  for (std::size_t c = 0; c < s.cases.size(); ++c) {
    check_set(s, draft.cases[c]);
    const std::vector<std::vector<double>> values = draw_samples(s, draft.cases[c]);
    check_samples(s, plan, draft.cases[c], values);
    for (std::size_t r = 0; r < s.records.size(); ++r)
      for (const double scale : s.scales)
        for (std::size_t i = 0; i < samples; ++i) {
          PlannedRun run{"", c, r, scale, s.samples > 0 ? int(i) + 1 : 0, values[i], 0};
          run.id = run_id(plan, run);
          run.hash = run_hash(plan, run);
          plan.runs.push_back(run);
        }
  }
}

}  // namespace

std::string slug(const std::string& name, const std::string& fallback, std::vector<std::string>& taken) {
  std::string s;
  for (const char c : name) {
    const bool kept =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
    const char next = kept ? c : '-';
    if (s.empty() ? next == '.' || next == '-' || next == '_' : next == s.back() && (next == '-' || next == '_'))
      continue;
    s += next;
  }
  s.resize(std::min(s.size(), longest_slug));
  while (!s.empty() && (s.back() == '_' || s.back() == '-' || s.back() == '.')) s.pop_back();
  if (s.empty()) s = fallback;
  const std::string first = s;
  for (int n = 2; std::ranges::find(taken, s) != taken.end(); ++n) s = fmt::format("{}-{}", first, n);
  taken.push_back(s);
  return s;
}

Draft make_draft(const Settings& s) {
  Draft draft;
  Plan& plan = draft.plan;
  draft.text = s.text;
  draft.records = s.records;
  plan.file = fs::path(s.path).filename().string();
  plan.periods = s.periods;
  plan.run = s.run;
  plan.limit_states = s.limit_states;
  plan.engine = s.engine;
  plan.left_out = s.left_out;
  for (const Sampled& sampled : s.sampled) plan.keys.insert(plan.keys.end(), sampled.keys.begin(), sampled.keys.end());
  if (std::set<std::string>(plan.keys.begin(), plan.keys.end()).size() < plan.keys.size())
    throw InputError("{}: a key is in more than one [[campaign.sample]] table. Sample it once", s.path);
  plan_cases(s, draft);
  std::vector<std::string> taken;
  for (const Shaking& shaking : s.records) plan.records.push_back(plan_record(s, shaking, taken));
  plan_runs(s, draft);
  return draft;
}

Case case_of(const Plan& plan, const PlannedRun& run, const std::string& directory) {
  const PlannedRecord& record = plan.records[run.record];
  const std::string file = fmt::format("{}/cases/{}/case.toml", directory, plan.cases[run.case_number].slug);
  const std::string motion_file = fmt::format("{}/records/{}/motion.toml", directory, record.slug);
  const toml::table table = parse_toml(read_text(file), file), motion = parse_toml(read_text(motion_file), motion_file);
  Case c = parse_case(text_of(changed(table, plan, run.values)), file, CaseUse::geometry);
  const std::size_t at = motion_stage(c);
  StageSettings& stage = c.settings.stages[at];
  TableReader reader(motion, motion_file, "the motion");
  c.motions[at] = read_motion_source(reader, motion_file, record.duration);
  reader.finish();
  c.motions[at].scale *= run.scale;
  stage.motion = ground_motion(c.motions[at]);
  stage.duration = record.duration;
  if (!table["stage"][at].as_table()->contains("label"))
    stage.label = fmt::format("motion ({}, scale {})", record.name, run.scale);
  if (plan.run.free_after <= 0.0) return c;
  const bool has_free =
      at + 1 < c.settings.stages.size() && c.settings.stages[at + 1].kind == StageSettings::Kind::free;
  if (!has_free) {
    StageSettings free;
    free.kind = StageSettings::Kind::free;
    free.label = "free vibration";
    c.settings.stages.insert(c.settings.stages.begin() + std::ptrdiff_t(at) + 1, free);
    c.motions.insert(c.motions.begin() + std::ptrdiff_t(at) + 1, MotionSource{});
  }
  c.settings.stages[at + 1].duration = plan.run.free_after;
  return c;
}

std::optional<Case> before_motion(const Case& c) {
  const auto timed = std::ranges::find_if(c.settings.stages, &StageSettings::timed);
  const auto count = timed - c.settings.stages.begin();
  if (count == 0 || timed == c.settings.stages.end()) return {};
  Case before = c;
  before.settings.stages.resize(std::size_t(count));
  before.motions.resize(std::size_t(count));
  before.plots.clear();
  return before;
}

const PlannedRun& find_run(const Plan& plan, const std::string& id) {
  const auto found = std::ranges::find(plan.runs, id, &PlannedRun::id);
  if (found == plan.runs.end()) throw InputError("this campaign has no run '{}'. Its runs are listed by --status", id);
  return *found;
}

std::string folder_of(const std::string& directory, const PlannedRun& run) {
  return directory + "/runs/" + run.id;
}

}  // namespace voussoir::campaign
