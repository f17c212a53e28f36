// The explicit solver under the motion of the ground that was recorded: the case as it was and as corrected, against
// the recording.
#pragma once
#include "solver/diagnosis/diagnose.h"
#include "solver/identify/transfer.h"
#include "tools/diagnosis/diagnosis_input.h"

namespace voussoir {

struct ChannelMatch {
  std::string channel;
  double size = 0.0;                             // m/s2, root mean square, measured
  double error_before = 0.0, error_after = 0.0;  // root mean square of the difference, share of it
};

/// Measured and computed accelerations on the same samples, below `highest_frequency`, and what they are of the
/// ground's.
struct RecordedMatch {
  std::string record;                                // "records/earthquake.csv"
  double from = 0.0, duration = 0.0;                 // s, of the recording
  double highest_frequency = 0.0;                    // Hz, of what is compared
  Recording measured, before, after;                 // sensors and base_…
  TransferFunctions measured_h, before_h, after_h;   // lines are empty where the part is too short
  std::vector<ChannelMatch> channels;                // in the order of the sensors
  double error_before = 0.0, error_after = 0.0;      // of all channels together
  double transfer_before = 0.0, transfer_after = 0;  // root mean square of |H| differences in standard deviations
  double seconds = 0.0;                              // of computing, both runs
};

/// Runs both on the mesh that was searched, from rest under gravity, over at most `seconds` of the first recording that
/// has the ground's motion, from where it begins to be strong. Nothing where there is no such recording. Throws
/// RunError where a run fails.
std::optional<RecordedMatch> run_recorded(const DiagnosisInput& input, const Fit& best, double seconds, int threads,
                                          const std::function<void(const std::string&)>& say);

}  // namespace voussoir
