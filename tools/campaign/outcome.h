// What has come of a run. It is one small file in the run's folder, written as the last: it is there and whole, or the
// run has not ended.
#pragma once
#include "tools/campaign/plan.h"
#include "tools/campaign/table.h"

namespace voussoir::campaign {

using Status = RunStatus;

struct Outcome {
  Status status = Status::missing;
  std::string reason;    // one line; empty of what is done
  double seconds = 0.0;  // of wall time, all parts of the run
  bool begun = false;    // of a missing one: there is something to go on with
  bool goes_on = false;  // of a failed one: a retry goes on from its checkpoints; else it begins anew
};

/// Of a run in the campaign's folder. An outcome of another run (its hash says so) or a damaged one is none.
Outcome read_outcome(const std::string& directory, const PlannedRun& run);
/// Names of the campaign's folder in the reason become relative to it. Throws RunError.
void write_outcome(const std::string& directory, const PlannedRun& run, Outcome outcome);
/// Makes failed runs missing ones; what cannot go on is emptied. Returns how many.
std::size_t forget_failures(const std::string& directory, const Plan& plan);

/// Runs by status, over a whole plan.
struct Tally {
  std::size_t done = 0, collapsed = 0, failed = 0, missing = 0, running = 0;
  std::size_t all() const { return done + collapsed + failed + missing; }
};
Tally tally(const std::string& directory, const Plan& plan);
void count(Tally& tally, Status status);

/// Where the output of a run's process goes, in its folder.
inline constexpr const char* output_name = "output.txt";

}  // namespace voussoir::campaign
