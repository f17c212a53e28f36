// Runs as processes of this machine.
#include <fmt/format.h>
#include <sys/types.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>

#include "solver/base/child.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "tools/campaign/engine.h"
#include "tools/campaign/sharing.h"

namespace voussoir::campaign {

namespace fs = std::filesystem;

namespace {

struct Child {
  pid_t process = -1;
  std::size_t run = 0;
};

/// Whether a signal means a fault of the program, and not an end from outside. Such a run is recorded as failed and
/// not repeated.
bool crash(int signal) {
  for (const int fault : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP})
    if (signal == fault) return true;
  return false;
}

class Local {
 public:
  explicit Local(const Work& work) : work_(work), plan_(*work.plan), tally_(tally(work.directory, plan_)) {
    sharing_ = share_cores(plan_.engine, work.cores, work.todo.size());
  }

  WorkEnd run() {
    work_.say(fmt::format("{} at a time with {} each, on {} of this machine", counted(sharing_.runs, "run"),
                          counted(sharing_.threads, "thread"), counted(work_.cores, "core")));
    std::size_t next = 0;
    bool stopping = false;
    while (!children_.empty() || (next < work_.todo.size() && !stopping)) {
      if (stop_signal() != 0 && !stopping) {
        stopping = true;
        work_.say(fmt::format("stopping: the program waits until {} have written their checkpoints",
                              counted(children_.size(), "run")));
        for (const Child& child : children_) ::kill(child.process, SIGTERM);
      }
      while (!stopping && next < work_.todo.size() && children_.size() < std::size_t(sharing_.runs))
        begin(work_.todo[next++]);
      take_ended();
      tally_.running = children_.size();
      work_.progress(tally_, ended_);
      pause_milliseconds(20);
    }
    return stopping ? WorkEnd::stopped : WorkEnd::ended;
  }

 private:
  void begin(std::size_t number) {
    const PlannedRun& run = plan_.runs[number];
    const std::string folder = folder_of(work_.directory, run);
    std::error_code failed;
    if (fs::create_directories(folder, failed); failed)
      throw RunError("the folder {} cannot be made: {}", folder, failed.message());
    const LogFile output(folder + "/" + output_name);
    // Each run has its own process group: Ctrl-C in a terminal reaches only the campaign, which passes it on once.
    const pid_t child = start({.words = {work_.program, "campaign-run", work_.directory, run.id, "--threads",
                                         std::to_string(sharing_.threads), "--parent", std::to_string(::getpid())},
                               .out = output.descriptor,
                               .err = output.descriptor,
                               .group = Launch::Group::own});
    children_.push_back({child, number});
  }

  void take_ended() {
    for (std::size_t i = 0; i < children_.size();) {
      Finished how;
      if (!has_ended(children_[i].process, how)) {
        ++i;
        continue;
      }
      settle(plan_.runs[children_[i].run], how);
      children_.erase(children_.begin() + std::ptrdiff_t(i));
    }
  }

  void settle(const PlannedRun& run, const Finished& how) {
    Outcome outcome = read_outcome(work_.directory, run);
    if (outcome.status == Status::missing && crash(how.signal)) {
      outcome.status = Status::failed;
      outcome.reason =
          fmt::format("the program crashed (signal {}, {}). This is a fault of the program: please report it",
                      how.signal, ::strsignal(how.signal));
      outcome.goes_on = false;
      write_outcome(work_.directory, run, outcome);
    }
    --tally_.missing;
    count(tally_, outcome.status);
    ++ended_;
    if (outcome.status == Status::failed) work_.say(fmt::format("FAILED {}: {}", run.id, outcome.reason));
    if (outcome.status == Status::collapsed) work_.say(fmt::format("collapsed {}: {}", run.id, outcome.reason));
    if (outcome.status != Status::missing || stop_signal() != 0) return;
    const std::string why = how.signal == SIGKILL ? "the system killed it, perhaps because memory ran out"
                            : how.signal > 0      ? fmt::format("signal {} ended it", how.signal)
                                                  : fmt::format("exit status {}", how.status);
    work_.say(
        fmt::format("{} has not ended: {}; see {}/{}", run.id, why, folder_of(work_.directory, run), output_name));
  }

  const Work& work_;
  const Plan& plan_;
  Sharing sharing_;
  Tally tally_;
  std::vector<Child> children_;
  std::size_t ended_ = 0;
};

}  // namespace

Engine local_engine() {
  return {"local", [](const Work& work) {
            if (!work.wait)
              throw InputError(
                  "--no-wait works only with Slurm, which continues without this program. On this machine the runs end "
                  "when the campaign ends: leave out --no-wait");
            return Local(work).run();
          }};
}

}  // namespace voussoir::campaign
