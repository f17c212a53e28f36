// The outcome of a run, in one small file of its folder. The program writes it last and atomically. If it exists, it is
// complete; otherwise the run has not ended.
#pragma once
#include "tools/campaign/plan.h"
#include "tools/campaign/table.h"

namespace voussoir::campaign {

using Status = RunStatus;

struct Outcome {
  Status status = Status::missing;
  std::string reason;    // one line; empty if the run is done
  double seconds = 0.0;  // s, wall-clock time of all parts of the run
  bool begun = false;    // of a missing run: it has been started
  bool goes_on = false;  // of a failed run: a retry continues from its checkpoints; otherwise it starts again
};

/// The outcome of a run in the folder of the campaign. Missing if it is damaged or belongs to another run (the hash
/// differs).
Outcome read_outcome(const std::string& directory, const PlannedRun& run);
/// Writes an outcome. Paths in the reason become relative to the folder of the campaign. Throws RunError.
void write_outcome(const std::string& directory, const PlannedRun& run, Outcome outcome);
/// Changes failed runs to missing ones, and empties the folders of those that cannot continue. Returns their number.
std::size_t forget_failures(const std::string& directory, const Plan& plan);

/// Number of runs of a plan by status.
struct Tally {
  std::size_t done = 0, collapsed = 0, failed = 0, missing = 0, running = 0;
  std::size_t all() const { return done + collapsed + failed + missing; }
};
Tally tally(const std::string& directory, const Plan& plan);
void count(Tally& tally, Status status);

/// File for the output of the process of a run, in its folder.
inline constexpr const char* output_name = "output.txt";

}  // namespace voussoir::campaign
