// Runs as tasks of Slurm job arrays. The script for Slurm is constant. Program, campaign and runs are arguments of it,
// so that no name can become a command.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "solver/base/atomic_file.h"
#include "solver/base/child.h"
#include "solver/base/counted.h"
#include "solver/base/json_file.h"
#include "tools/campaign/engine.h"
#include "tools/campaign/json.h"

namespace voussoir::campaign {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t longest_array = 1000;  // Slurm's default MaxArraySize is 1001
constexpr int poll_milliseconds = 2000;
constexpr double grace = 120.0;  // s between the limit at which a run ends itself and the one of its job

constexpr const char* script = R"(#!/bin/sh
# One run of a voussoir campaign. Arguments: program, campaign's folder, list of runs, threads.
exec >>"$2/slurm/output_${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID.txt" 2>&1
exec "$1" campaign-run "$2" --batch "$3" --task "$SLURM_ARRAY_TASK_ID" --threads "$4"
)";

/// Runs that were submitted together: slurm/batch_NNN.json.
struct Batch {
  std::string name, job;  // job: Slurm's number, empty when it never got one
  std::vector<std::string> runs;
};

std::vector<Batch> read_batches(const std::string& directory) {
  std::vector<Batch> batches;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory + "/slurm", ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("batch_") || !name.ends_with(".json")) continue;
    const json j = json_if_any(entry.path().string());
    if (!j.is_object()) continue;
    batches.push_back({name, j.value("job", ""), j.value("runs", std::vector<std::string>{})});
  }
  std::ranges::sort(batches, {}, &Batch::name);
  return batches;
}

void write_batch(const std::string& directory, const Batch& batch) {
  const json j = {{"job", batch.job}, {"runs", batch.runs}};
  write_json(directory + "/slurm/" + batch.name, j, 1);
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

class Slurm {
 public:
  explicit Slurm(const Work& work) : work_(work), plan_(*work.plan) {
    for (const char* program : {"sbatch", "squeue"})
      if (!in_path(program))
        throw InputError(
            "the command {} was not found: Slurm is not installed on this machine (Debian: slurm-client) or is not in "
            "PATH. Install it, or run the campaign here with --engine local",
            program);
  }

  WorkEnd run() {
    batches_ = read_batches(work_.directory);
    submit_missing();
    if (!work_.wait) return WorkEnd::left;
    std::string said;
    while (true) {
      const bool alive = look();
      work_.progress(tally_, tally_.all() - tally_.missing - settled_before());
      if (!alive) {
        if (tally_.missing > 0)
          work_.say(fmt::format(
              "{}. The output is in {}/slurm",
              counted(tally_.missing, "run left Slurm without a result. It was cancelled, or its node could not run it",
                      "runs left Slurm without a result. They were cancelled, or their node could not run them"),
              work_.directory));
        return WorkEnd::ended;
      }
      if (stop_signal() != 0) {
        work_.say(
            fmt::format("The jobs continue without this program. Start the campaign again to wait for them and to "
                        "write the table, or end them with: scancel {}",
                        fmt::join(jobs(), " ")));
        return WorkEnd::stopped;
      }
      for (int i = 0; i < poll_milliseconds && stop_signal() == 0; i += 50) pause_milliseconds(50);
    }
  }

 private:
  std::size_t settled_before() const { return plan_.runs.size() - work_.todo.size(); }

  std::vector<std::string> jobs() const {
    std::vector<std::string> list;
    for (const Batch& batch : batches_)
      if (live_.contains(batch.name)) list.push_back(batch.job);
    return list;
  }

  /// Asks Slurm for the runs of a batch that have not ended, and reports why runs wait.
  std::set<std::string> still_there(const Batch& batch) {
    std::set<std::string> runs;
    if (batch.job.empty()) return runs;
    const Answer answer = ask({"squeue", "--noheader", "--array", "--jobs=" + batch.job, "--format=%K|%T|%r"});
    if (answer.status != 0) {
      if (answer.err.find("Invalid job id") != std::string::npos)
        return runs;  // Slurm no longer knows the job: all runs have ended
      say_once("squeue does not answer: " + first_line(answer.err));
      return {batch.runs.begin(), batch.runs.end()};
    }
    for (std::size_t from = 0; from < answer.out.size();) {
      const std::size_t to = std::min(answer.out.find('\n', from), answer.out.size());
      const std::string line = answer.out.substr(from, to - from);
      from = to + 1;
      const std::size_t bar = line.find('|'), second = line.find('|', bar + 1);
      if (second == std::string::npos) continue;
      const std::size_t task = std::size_t(std::strtoul(line.c_str(), nullptr, 10));
      if (task < batch.runs.size()) runs.insert(batch.runs[task]);
      const std::string state = line.substr(bar + 1, second - bar - 1), reason = line.substr(second + 1);
      tally_.running += state == "RUNNING" || state == "COMPLETING";
      if (state == "PENDING" && reason != "None" && reason != "Resources" && reason != "Priority" &&
          reason != "JobArrayTaskLimit")
        say_once(fmt::format("Slurm keeps runs of job {} waiting: {}", batch.job, reason));
    }
    return runs;
  }

  void say_once(const std::string& text) {
    if (said_.insert(text).second) work_.say(text);
  }

  /// Whether Slurm still has runs of this campaign.
  bool look() {
    tally_ = {};
    std::set<std::string> live;
    for (const Batch& batch : batches_)
      if (live_.contains(batch.name) && !still_there(batch).empty()) live.insert(batch.name);
    live_ = live;
    Tally t = tally(work_.directory, plan_);  // counted after asking Slurm, so that runs that left Slurm have written
                                              // their outcome
    t.running = tally_.running;
    tally_ = t;
    return !live_.empty();
  }

  void submit_missing() {
    std::set<std::string> there;
    for (const Batch& batch : batches_)
      if (const std::set<std::string> runs = still_there(batch); !runs.empty()) {
        there.insert(runs.begin(), runs.end());
        live_.insert(batch.name);
      }
    if (!there.empty()) work_.say(fmt::format("Slurm still has {} of this campaign", counted(there.size(), "run")));
    std::vector<std::string> runs;
    for (const std::size_t i : work_.todo)
      if (!there.contains(plan_.runs[i].id)) runs.push_back(plan_.runs[i].id);
    for (std::size_t from = 0; from < runs.size(); from += longest_array)
      submit({runs.begin() + std::ptrdiff_t(from),
              runs.begin() + std::ptrdiff_t(std::min(from + longest_array, runs.size()))});
  }

  std::vector<std::string> words(const Batch& batch, const std::string& script_file) const {
    const EngineSettings& e = plan_.engine;
    const int threads = std::max(1, e.threads);
    std::string array = fmt::format("--array=0-{}", batch.runs.size() - 1);
    if (e.runs_at_once > 0) array += fmt::format("%{}", e.runs_at_once);
    // Slurm replaces % and backslashes in the names of output files. The script opens the file instead.
    std::vector<std::string> list = {"sbatch",    "--parsable",        "--job-name=voussoir",
                                     array,       "--ntasks=1",        fmt::format("--cpus-per-task={}", threads),
                                     "--chdir=/", "--output=/dev/null"};
    if (e.time_limit > 0.0) list.push_back(fmt::format("--time={}", int(std::ceil((e.time_limit + grace) / 60.0))));
    if (e.memory > 0.0) list.push_back(fmt::format("--mem={}M", int(std::ceil(e.memory))));
    for (const auto& [option, value] : {std::pair{"partition", e.partition}, {"account", e.account}, {"qos", e.qos}})
      if (!value.empty()) list.push_back(fmt::format("--{}={}", option, value));
    list.insert(list.end(), e.options.begin(), e.options.end());
    list.insert(list.end(), {script_file, work_.program, work_.directory, batch.name, std::to_string(threads)});
    return list;
  }

  void submit(std::vector<std::string> runs) {
    std::error_code failed;
    fs::create_directories(work_.directory + "/slurm", failed);
    const std::string script_file = work_.directory + "/slurm/job.sh";
    write_atomically(script_file, std::string(script));
    Batch batch{fmt::format("batch_{:03}.json", batches_.size() + 1), "", std::move(runs)};
    write_batch(work_.directory, batch);  // before the job, which may begin at once
    const Answer answer = ask(words(batch, script_file));
    if (answer.status != 0) {
      fs::remove(work_.directory + "/slurm/" + batch.name, failed);
      throw RunError("sbatch refuses the runs: {}. Check [engine] of the campaign, or run it here with --engine local",
                     first_line(answer.err));
    }
    batch.job = first_line(answer.out).substr(0, answer.out.find_first_of(";\n"));
    write_batch(work_.directory, batch);
    work_.say(fmt::format("{} submitted to Slurm as job {}", counted(batch.runs.size(), "run"), batch.job));
    live_.insert(batch.name);
    batches_.push_back(batch);
  }

  const Work& work_;
  const Plan& plan_;
  std::vector<Batch> batches_;
  std::set<std::string> live_;  // names of batches that Slurm still has runs of
  std::set<std::string> said_;
  Tally tally_;
};

}  // namespace

Engine slurm_engine() {
  return {"slurm", [](const Work& work) { return Slurm(work).run(); }};
}

}  // namespace voussoir::campaign
