// voussoir campaign: many runs on this machine or a cluster, and one table of their results.
#include <fmt/format.h>

#include <filesystem>

#include "solver/base/child.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/suggestion.h"
#include "tools/campaign/campaign_page.h"
#include "tools/campaign/engine.h"
#include "tools/campaign/write_table.h"
#include "tools/run/directory_lock.h"
#include "tools/run/terminal.h"
#include "tools/voussoir/verb.h"

namespace voussoir {

namespace fs = std::filesystem;
using namespace campaign;

namespace {

constexpr std::size_t most_listed = 20;  // failures

struct Request {
  std::string file, directory;
  bool from_folder = false;  // continue the campaign of a folder; its file is not needed
  bool quiet = false, plan_only = false;
};

Request request_of(const options::variables_map& values) {
  Request r;
  r.file = values["FILE"].as<std::string>();
  r.quiet = values.count("quiet") > 0, r.plan_only = values.count("plan") > 0;
  std::error_code ignored;
  r.from_folder = fs::is_directory(r.file, ignored);
  r.directory = r.from_folder ? r.file : fs::path(r.file).stem().string();
  if (values.count("output") && r.from_folder)
    throw InputError("{} is the folder of a campaign. Leave out -o, or give the campaign file", r.file);
  if (values.count("output")) r.directory = values["output"].as<std::string>();
  if (r.from_folder && !holds_plan(r.directory))
    throw InputError(
        "{} is a folder that holds no campaign. Give a campaign file, or the folder of an earlier campaign", r.file);
  r.directory = fs::absolute(r.directory).lexically_normal().string();
  while (r.directory.size() > 1 && r.directory.back() == '/') r.directory.pop_back();
  return r;
}

Draft draft_of(const Request& wanted) {
  const Settings settings = read_settings(wanted.file);
  if (!wanted.quiet && !wanted.plan_only)  // print_plan prints these lines itself
    for (const std::string& record : settings.left_out) fmt::print(stderr, "left out: {}\n", record);
  return make_draft(settings);
}

std::string counts_text(const Tally& t) {
  std::string text = fmt::format("{} of {} done", t.done + t.collapsed, counted(t.all(), "run"));
  if (t.collapsed > 0) text += fmt::format(", {} of them collapsed", t.collapsed);
  if (t.running > 0) text += fmt::format(", {} running", t.running);
  if (t.failed > 0) text += fmt::format(", {} failed", t.failed);
  return text;
}

/// A line for each run.
void print_plan(const Plan& plan) {
  fmt::print("{:<60} {:>8} {:>8} {:>10}\n", "run", "scale", "time [s]", "PGA [m/s2]");
  for (const PlannedRun& run : plan.runs) {
    const PlannedRecord& record = plan.records[run.record];
    fmt::print("{:<60} {:>8g} {:>8.2f} {:>10.3g}\n", run.id, run.scale, record.duration,
               record.measures.empty() ? 0.0 : run.scale * record.measures[0]);
  }
  fmt::print("{}: {}, {}\n", counted(plan.runs.size(), "run"), counted(plan.cases.size(), "case"),
             counted(plan.records.size(), "record"));
  for (const std::string& text : plan.left_out) fmt::print("left out: {}\n", text);
}

void print_status(const Plan& plan, const std::string& directory) {
  for (const PlannedRun& run : plan.runs) {
    const Outcome o = read_outcome(directory, run);
    fmt::print("{:<10} {}{}{}\n", run_status_name(o.status), run.id, o.reason.empty() ? "" : ": ", o.reason);
  }
  fmt::print("{}\n", counts_text(tally(directory, plan)));
}

/// A word quoted for a shell, because the user may paste the printed command.
std::string for_shell(const std::string& word) {
  const std::string plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-/+,@:=";
  if (word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted;
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return fmt::format("'{}'", quoted);
}

/// Lists the failed runs, after all other output.
void list_failures(const Plan& plan, const std::string& directory) {
  std::size_t listed = 0;
  const Tally t = tally(directory, plan);
  for (const PlannedRun& run : plan.runs) {
    const Outcome o = read_outcome(directory, run);
    if (o.status != Status::failed) continue;
    if (++listed > most_listed) break;
    fmt::print(stderr, "failed: {}: {}\n", run.id, o.reason);
  }
  if (t.failed > most_listed) fmt::print(stderr, "… and {} more; --status lists all\n", t.failed - most_listed);
  if (t.failed > 0)
    fmt::print(stderr, "The files of the failed runs are in {}/runs/…. Give --retry-failed to run them once more.\n",
               directory);
}

const Engine& engine_named(const std::string& name) {
  std::vector<std::string> names;
  for (const Engine& engine : engines()) {
    if (engine.name == name) return engine;
    names.push_back(engine.name);
  }
  throw InputError("--engine is '{}'{}", name, suggestion(name, names));
}

/// The progress line with the time left, estimated from the runs that have ended since the start.
class Watch {
 public:
  Watch(std::size_t todo, bool quiet) : todo_(todo), quiet_(quiet), line_(quiet) {}
  void show(const Tally& t, std::size_t ended) {
    Progress p;
    p.stage = "campaign";
    p.timed = false;
    p.note = counts_text(t);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
    if (ended > 0 && ended < todo_)
      p.note += fmt::format(", {} left", duration_text(seconds / double(ended) * double(todo_ - ended)));
    line_.show(p);
  }
  void say(const std::string& text) {
    line_.end();
    if (!quiet_) fmt::print(stderr, "{}\n", text);
  }
  void end() { line_.end(); }

 private:
  std::size_t todo_;
  bool quiet_;
  ProgressLine line_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

WorkEnd compute(const Plan& plan, const Request& wanted, const options::variables_map& values) {
  const Engine& engine = engine_named(values.count("engine") ? values["engine"].as<std::string>() : plan.engine.kind);
  Work work;
  work.plan = &plan;
  work.directory = wanted.directory;
  work.program = own_program();
  work.cores = threads_asked(values);
  work.wait = values.count("no-wait") == 0;
  for (std::size_t i = 0; i < plan.runs.size(); ++i)
    if (read_outcome(wanted.directory, plan.runs[i]).status == Status::missing) work.todo.push_back(i);
  if (work.todo.empty()) return WorkEnd::ended;
  Watch watch(work.todo.size(), wanted.quiet);
  work.say = [&](const std::string& text) { watch.say(text); };
  work.progress = [&](const Tally& t, std::size_t ended) { watch.show(t, ended); };
  if (work.todo.size() < plan.runs.size())
    watch.say(fmt::format("{} of {} already ended", plan.runs.size() - work.todo.size(),
                          counted(plan.runs.size(), "run has", "runs have")));
  watch_signals();
  const WorkEnd end = engine.run(work);
  watch.end();
  return end;
}

/// The exit status.
int finish(const Plan& plan, const Request& wanted, WorkEnd end) {
  const std::string& directory = wanted.directory;
  write_table(plan, directory);
  const Tally t = tally(directory, plan);
  if (!wanted.quiet) fmt::print(stderr, "{}; table in {}/table.csv and table.h5\n", counts_text(t), directory);
  list_failures(plan, directory);
  if (t.done + t.collapsed > 0) try {
      write_campaign_page(directory);
      if (!wanted.quiet) fmt::print(stderr, "page in {}/report.html\n", directory);
    } catch (const std::exception& error) {  // the table has been written
      fmt::print(stderr, "no page was written: {}\n", error.what());
    }
  if (end == WorkEnd::left) return 0;
  if (end == WorkEnd::stopped || t.missing > 0)
    fmt::print(stderr, "{} not ended. Continue with: voussoir campaign {}\n",
               counted(t.missing, "run has", "runs have"), for_shell(directory));
  return t.failed + t.missing > 0 || end == WorkEnd::stopped ? 1 : 0;
}

void add_options(CommandLine& line) {
  line.described.add_options()("output,o", options::value<std::string>()->value_name("DIR"),
                               "folder of the campaign (default: the file's name)")(
      "plan", "list the runs and what the folder of records leaves out; write and run nothing")(
      "status", "say how far each run is, and why it failed")(
      "table", "write the table of the present results; run nothing")("retry-failed", "run failed runs once more")(
      "engine", options::value<std::string>()->value_name("NAME"), "local or slurm (default: the file's)")(
      "no-wait", "leave the runs to Slurm; the same command without this option gathers their results");
}

int run_campaign(const std::vector<std::string>& arguments) {
  CommandLine line("campaign", "campaign FILE [-o DIR]   (to continue: campaign DIR)",
                   "voussoir campaign cases/campaigns/walls.toml -o walls");
  add_options(line);
  line.positional = line.required = {"FILE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const Request wanted = request_of(values);
  const std::string& directory = wanted.directory;
  if (values.count("plan")) {
    print_plan(wanted.from_folder ? read_plan(directory) : draft_of(wanted).plan);
    return 0;
  }
  if (values.count("status") || values.count("table")) {
    const Plan plan = read_plan(directory);
    if (values.count("status")) print_status(plan, directory);
    if (values.count("table")) return finish(plan, wanted, WorkEnd::left);
    return 0;
  }
  if (!wanted.quiet) fmt::print(stderr, "reading {}\n", wanted.file);
  const Draft draft = wanted.from_folder ? Draft{read_plan(directory), {}, {}, ""} : draft_of(wanted);
  const Plan& plan = draft.plan;
  std::error_code failed;
  fs::create_directories(directory, failed);
  if (failed)
    throw InputError("cannot make the folder {}: {}. Choose another one with -o DIR", directory, failed.message());
  const DirectoryLock lock(directory);
  if (!wanted.from_folder) write_draft(draft, directory);
  if (values.count("retry-failed"))
    if (const std::size_t n = forget_failures(directory, plan); n > 0 && !wanted.quiet)
      fmt::print(stderr, "{} tried again\n", counted(n, "failed run is", "failed runs are"));
  return finish(plan, wanted, compute(plan, wanted, values));
}

}  // namespace

Verb campaign_verb() {
  return {"campaign", "make many runs: cases, records, scales, sampled materials; on this machine or a Slurm cluster",
          run_campaign};
}

}  // namespace voussoir
