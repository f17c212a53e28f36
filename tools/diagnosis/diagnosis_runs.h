// Response to the recorded ground motion by the explicit solver: the case as it is and the corrected case, compared
// with the recording.
#pragma once
#include "solver/diagnosis/diagnose.h"
#include "solver/identify/transfer.h"
#include "tools/diagnosis/diagnosis_input.h"

namespace voussoir {

struct ChannelMatch {
  std::string channel;
  double size = 0.0;                             // m/s2, root mean square, measured
  double error_before = 0.0, error_after = 0.0;  // root mean square of the difference, relative to `size`
};

/// Measured and computed accelerations on the same samples, below `highest_frequency`, and their transfer functions
/// from the ground motion.
struct RecordedMatch {
  std::string record;                                // "records/earthquake.csv"
  double from = 0.0, duration = 0.0;                 // s, part of the recording
  double highest_frequency = 0.0;                    // Hz, upper end of the comparison
  Recording measured, before, after;                 // channels: sensors and base_…
  TransferFunctions measured_h, before_h, after_h;   // no lines if the part is too short
  std::vector<ChannelMatch> channels;                // in the order of the sensors
  double error_before = 0.0, error_after = 0.0;      // as in ChannelMatch, over all channels
  double transfer_before = 0.0, transfer_after = 0;  // root mean square of |H| differences in standard deviations
  double seconds = 0.0;                              // s, computing time of both runs
};

/// Runs both cases on the mesh of the search, from rest under gravity, over at most `seconds` of the first recording
/// with the ground motion, from the beginning of its strong part. Returns nothing if there is no such recording.
/// Throws RunError if a run fails.
std::optional<RecordedMatch> run_recorded(const DiagnosisInput& input, const Fit& best, double seconds, int threads,
                                          const std::function<void(const std::string&)>& say);

}  // namespace voussoir
