// Engines that compute the runs of a campaign. A new engine is one file in this folder and one line in engines.cpp.
#pragma once
#include <functional>

#include "tools/campaign/outcome.h"

namespace voussoir::campaign {

/// The work of an engine, and its callbacks.
struct Work {
  const Plan* plan = nullptr;
  std::string directory;                        // folder of the campaign, absolute path
  std::string program;                          // path of the program voussoir, absolute
  std::vector<std::size_t> todo;                // runs without an outcome
  int cores = 1;                                // number of cores of this machine to use
  bool wait = true;                             // wait until all runs have ended; false works only with Slurm
  std::function<void(const std::string&)> say;  // prints a permanent line
  std::function<void(const Tally&, std::size_t)> progress;  // tally of the whole plan; number of `todo` runs that have
                                                            // ended
};

enum class WorkEnd { ended, stopped, left };  // stopped: by a signal; left: the runs continue without this program

struct Engine {
  std::string name;
  WorkEnd (*run)(const Work& work) = nullptr;  // throws InputError if it cannot work at all, and RunError
};
const std::vector<Engine>& engines();
Engine local_engine();
Engine slurm_engine();

/// The signal that asked the campaign to stop, or 0. `watch` starts to catch SIGINT and SIGTERM.
int stop_signal();
void watch_signals();

}  // namespace voussoir::campaign
