// Where the runs of a campaign are computed. A new engine is one file here and one line in engines.cpp.
#pragma once
#include <functional>

#include "tools/campaign/outcome.h"

namespace voussoir::campaign {

/// What is to be done, and whom to tell.
struct Work {
  const Plan* plan = nullptr;
  std::string directory;                                    // of the campaign, absolute
  std::string program;                                      // voussoir's own file, absolute
  std::vector<std::size_t> todo;                            // runs that have no outcome yet
  int cores = 1;                                            // of this machine that may be used
  bool wait = true;                                         // until all have ended; false: only Slurm can
  std::function<void(const std::string&)> say;              // a line that stays
  std::function<void(const Tally&, std::size_t)> progress;  // whole plan; how many of `todo` have ended
};

enum class WorkEnd { ended, stopped, left };  // stopped by a signal; left to go on by itself

struct Engine {
  std::string name;
  WorkEnd (*run)(const Work& work) = nullptr;  // throws InputError where it cannot work at all, RunError
};
const std::vector<Engine>& engines();
Engine local_engine();
Engine slurm_engine();

/// The signal that asked the campaign to stop, or 0; `watch` begins to look for SIGINT and SIGTERM.
int stop_signal();
void watch_signals();

}  // namespace voussoir::campaign
