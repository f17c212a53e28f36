// Recordings made ready for identification: checked, detrended, decimated, poor channels left out
// (docs/theory/identification.md).
#pragma once
#include "solver/identify/recording.h"

namespace voussoir {

struct PoorChannel {
  int channel = 0;     // in Prepared::channels
  std::string reason;  // "does not move"
};

struct Prepared {
  double dt = 0.0;                       // s, after decimation
  double highest_frequency = 0.0;        // Hz
  std::vector<std::string> channels;     // those that all recordings have, in the order of the first
  std::vector<int> used;                 // of these: the columns of `signals`
  std::vector<PoorChannel> poor;         // the rest, ascending
  std::vector<Eigen::MatrixXd> signals;  // a recording each: samples × used, m/s2
  Eigen::Index samples() const;          // of all recordings
};

/// base_x, base_y, base_z: the ground's motion, an input and no response.
bool is_base_channel(const std::string& name);

/// Throws InputError for no recording, one without samples or channels, a name per channel missing or given twice,
/// dt not above zero or not the same in all, values that are not finite.
void check_recordings(const std::vector<Recording>& recordings);

/// Channels that any recording has, and that all have; the ground's motion is not counted.
struct ChannelCounts {
  std::size_t all = 0, common = 0;
};
ChannelCounts count_channels(const std::vector<Recording>& recordings);

/// A channel that some recordings have and others not, so that it is left out where they are taken together.
struct DroppedChannel {
  std::string name, reason;  // "it is not in records/b.csv"
};
std::vector<DroppedChannel> dropped_channels(const std::vector<Recording>& recordings);

/// Throws InputError when more than half of the channels are not in all recordings.
void check_in_common(const std::vector<Recording>& recordings);

/// Columns of `x` less their straight line of least squares.
Eigen::MatrixXd detrended(const Eigen::MatrixXd& x);

/// Every `factor`-th sample of the columns of x after a linear-phase low-pass (Kaiser 1974: 60 dB) that passes
/// `highest` and stops at half the new sampling frequency; the filter's run-in at both ends is dropped.
Eigen::MatrixXd decimated(const Eigen::MatrixXd& x, double dt, int factor, double highest);

/// All channels in common, detrended and decimated to between 2.5 and 5 times the highest frequency; none is called
/// poor. For zero, errors and `highest_frequency` as prepare().
Prepared gathered(const std::vector<Recording>& recordings, double highest_frequency);

/// The same, less the ground's motion and the channels that show nothing of the structure's.
///
/// Zero for `highest_frequency` (Hz): 20, or 0.4 of the sampling frequency where that is less. Throws InputError
/// (see check_recordings), for a frequency above 0.45 of the sampling frequency, for channels in common that number
/// none or are all poor, and for recordings with fewer than 64 samples after decimation.
Prepared prepare(const std::vector<Recording>& recordings, double highest_frequency);

/// Samples, a power of two, of windows of so many seconds; of 0 s: of a `parts`-th of the longest recording, at
/// least 16. Throws InputError that begins with `what` for less than 8 samples or more than the longest recording.
int window_samples(const Prepared& prepared, double seconds, double parts, const char* what);

/// A vector over `used` channels as one over all, NaN where a channel was left out.
Eigen::VectorXcd over_all_channels(const Prepared& prepared, const Eigen::VectorXcd& shape);

}  // namespace voussoir
