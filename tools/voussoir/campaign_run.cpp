// One run of a campaign. The engines of a campaign start this verb. It is not listed among the verbs.
#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <limits>
#include <new>
#include <optional>

#include "solver/base/child.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "tools/campaign/json.h"
#include "tools/campaign/outcome.h"
#include "tools/run/run_directory.h"
#include "tools/run/run_session.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace fs = std::filesystem;
using namespace campaign;

namespace {

constexpr int patience = 600;  // 0.1 s, longest wait for another process to leave the run's folder

/// Makes this process end, with a checkpoint, when the campaign that started it ends for any reason.
void end_with(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) throw RunError("the campaign that started this run has ended");
}

/// Locks a folder. Waits without limit until no other process holds it.
DirectoryLock locked(const std::string& folder) {
  while (true) try {
      return DirectoryLock(folder);
    } catch (const InputError&) {
      pause_milliseconds(100);
    }
}

/// Waits until no other process is in the run's folder.
void wait_for(const std::string& folder) {
  for (int i = 0;; ++i) try {
      DirectoryLock free(folder);
      return;
    } catch (const InputError&) {
      if (i >= patience) throw;
      pause_milliseconds(100);
    }
}

struct Job {
  const Plan& plan;
  const PlannedRun& run;
  std::string directory, folder;  // of the campaign, of the run
  int threads = 1;
};

RunRequest request_of(const Job& job) {
  RunRequest r;
  r.directory = job.folder;
  r.threads = job.threads;
  r.pictures = job.plan.run.pictures;
  r.time_limit = job.plan.engine.time_limit;
  r.fall_displacement = job.plan.run.fall.displacement;
  r.fall_share = job.plan.run.fall.share;
  return r;
}

/// Thrown if a signal stops the run. The run can be continued later.
struct Stopped {};

/// The stages before the first motion give the same state for all runs of one case and sample. The first run computes
/// them in DIR/gravity/…, and the others wait for it. Returns the folder of that computation; empty if the case does
/// not begin with such stages or has no others. Throws RunError if the computation fails.
std::string gravity_of(const Job& job, const Case& c) {
  const std::optional<Case> before = before_motion(c);
  if (!before) return "";
  const std::uint64_t of_case = job.plan.cases[job.run.case_number].hash;  // and of an assembly that it reads
  const std::string shared = fmt::format("{}/gravity/{:016x}", job.directory,
                                         hash_text(fmt::format("{} {}", of_case, resolved_text(*before))));
  const std::string run = shared + "/run";
  fs::create_directories(shared);
  const DirectoryLock lock = locked(shared);
  if (const json done = json_if_any(run + "/summary.json"); done.is_object() && done.value("finished", false))
    return run;
  const DirectoryLock own = prepare_directory(*before, run, true);
  RunRequest request = request_of(job);
  request.directory = run, request.pictures = false;
  RunSession session(request);
  session.run();
  if (session.end() == SessionEnd::stopped) throw Stopped();
  if (session.end() == SessionEnd::late)
    throw RunError("the time limit of {:g} s was reached before equilibrium under gravity was found",
                   job.plan.engine.time_limit);
  return run;
}

/// Continues the run in the folder, or starts it. A run that cannot be continued starts again from its beginning.
struct Held {
  std::optional<DirectoryLock> lock;
  std::optional<RunSession> session;
};
void begin(const Job& job, Held& held) {
  if (fs::exists(job.folder + "/case.toml")) try {
      held.lock.emplace(job.folder);
      held.session.emplace(request_of(job));
      held.session->resume();
      return;
    } catch (const InputError& error) {
      fmt::print(stderr, "{} The run starts again from its beginning.\n", error.what());
      held.session.reset();
      held.lock.reset();
    }
  const Case c = case_of(job.plan, job.run, job.directory);
  const std::string gravity = gravity_of(job, c);
  held.lock.emplace(prepare_directory(c, job.folder, true));
  held.session.emplace(request_of(job));
  if (!gravity.empty()) held.session->begin_where(gravity);
}

/// Removes all checkpoints except that of the end state, which modes and pictures need.
void drop_checkpoints(const std::string& folder) {
  std::vector<fs::path> ends;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder + "/checkpoints", ignored))
    if (entry.path().filename().string().starts_with("stage_"))
      ends.push_back(entry.path());
    else
      fs::remove(entry.path(), ignored);
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) fs::remove(ends[i], ignored);
}

double seconds_of(const std::string& folder) {
  const json summary = json_if_any(folder + "/summary.json");
  return summary.is_object() ? summary.value("wall_seconds", 0.0) : 0.0;
}

Outcome outcome_of(const Job& job, const RunSession& session) {
  Outcome o;
  switch (session.end()) {
    case SessionEnd::done:
      o.status = Status::done;
      o.seconds = seconds_of(job.folder);
      break;
    case SessionEnd::fallen:
      o.status = Status::collapsed;
      o.reason = fmt::format("at t = {:.2f} s {:.0f} % of the mass had moved more than {:g} m", session.time(),
                             100.0 * session.fallen_share(), job.plan.run.fall.displacement);
      o.seconds = seconds_of(job.folder);
      break;
    case SessionEnd::late:
      o.status = Status::failed;
      o.reason =
          fmt::format("the time limit was reached at t = {:.2f} s (limit {:g} s). --retry-failed continues from there",
                      session.time(), job.plan.engine.time_limit);
      o.seconds = job.plan.engine.time_limit;
      o.goes_on = true;
      break;
    default:
      break;  // stopped: the run can be continued
  }
  return o;
}

/// Computes the run and returns the exit status. Every error is stored as the reason of the failure.
int work(const Job& job) {
  const auto started = std::chrono::steady_clock::now();
  Held held;
  Outcome o;
  const auto fail = [&](const std::string& why) {
    fmt::print(stderr, "failed: {}\n", why);
    o = {};
    o.status = Status::failed;
    o.reason = why;
    o.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    // A failure of the solver would occur again. Other failures, such as a full disk, may not.
    o.goes_on = held.session && held.session->end() != SessionEnd::failed;
  };
  try {
    begin(job, held);
    held.session->run();
    o = outcome_of(job, *held.session);
  } catch (const Stopped&) {
    return 1;
  } catch (const std::bad_alloc&) {
    fail("out of memory. Run fewer runs at once, or use fewer blocks.");
  } catch (const std::exception& error) {
    fail(error.what());
  }
  if (o.status == Status::missing) return 1;
  write_outcome(job.directory, job.run, o);
  if (o.status == Status::done && !job.plan.run.keep_checkpoints) drop_checkpoints(job.folder);
  return o.status == Status::failed ? 1 : 0;
}

/// The identifier of a run in a list that was given to Slurm.
std::string run_of_batch(const std::string& directory, const std::string& batch, int task) {
  const std::string file = directory + "/slurm/" + fs::path(batch).filename().string();
  const auto runs = need<std::vector<std::string>>(read_json(file), "runs", file);
  if (task < 0 || std::size_t(task) >= runs.size())
    throw InputError("{} has {}, counted from 0, but no run {}", file, counted(runs.size(), "run"), task);
  return runs[std::size_t(task)];
}

int campaign_run(const std::vector<std::string>& arguments) {
  CommandLine line("campaign-run", "campaign-run DIR RUN", "voussoir campaign-run campaign cs1-f__aquila__x1");
  line.described.add_options()("batch", options::value<std::string>()->value_name("FILE"), "list of runs in DIR/slurm")(
      "task", whole_option("task", 0, 1'000'000'000)->value_name("N"), "position in that list, from 0")(
      "parent", whole_option("parent", 1, std::numeric_limits<int>::max())->value_name("PID"),
      "process that started this run; the run ends when that process ends");
  line.positional = {"DIR", "RUN"};
  line.required = {"DIR"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  if (values.count("parent")) end_with(values["parent"].as<int>());
  const std::string directory = values["DIR"].as<std::string>();
  if (values.count("RUN") == values.count("batch") || values.count("batch") != values.count("task"))
    throw InputError("give a run, or --batch and --task. Usage: voussoir {}", line.usage);
  const std::string id = values.count("RUN")
                             ? values["RUN"].as<std::string>()
                             : run_of_batch(directory, values["batch"].as<std::string>(), values["task"].as<int>());
  const Plan plan = read_plan(directory);
  const PlannedRun& run = find_run(plan, id);
  const Job job{plan, run, directory, folder_of(directory, run), threads_asked(values)};
  fs::create_directories(job.folder);
  wait_for(job.folder);
  if (read_outcome(directory, run).status != Status::missing) return 0;  // nothing is run twice
  return work(job);
}

}  // namespace

Verb campaign_run_verb() {
  return {"campaign-run", "", campaign_run};
}

}  // namespace voussoir
