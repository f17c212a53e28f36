// Prepares recordings for identification: checks, detrends and decimates them and leaves out poor channels
// (docs/theory/identification.md).
#pragma once
#include "solver/identify/recording.h"

namespace voussoir {

struct PoorChannel {
  int channel = 0;     // in Prepared::channels
  std::string reason;  // "it does not move"
};

struct Prepared {
  double dt = 0.0;                       // s, after decimation
  double highest_frequency = 0.0;        // Hz
  std::vector<std::string> channels;     // channels of all recordings, in the order of the first
  std::vector<int> used;                 // indices in `channels`: the columns of `signals`
  std::vector<PoorChannel> poor;         // the rest, ascending
  std::vector<Eigen::MatrixXd> signals;  // for each recording: samples × used, m/s2
  Eigen::Index samples() const;          // of all recordings
};

/// base_x, base_y, base_z: the motion of the ground, which is an input and not a response.
bool is_base_channel(const std::string& name);

/// Throws InputError if there is no recording, for a recording without samples or channels, for a missing or repeated
/// channel name, for a dt that is not above zero or differs between recordings, and for values that are not finite.
void check_recordings(const std::vector<Recording>& recordings);

/// Number of channels in any recording, and in all recordings, without the motion of the ground.
struct ChannelCounts {
  std::size_t all = 0, common = 0;
};
ChannelCounts count_channels(const std::vector<Recording>& recordings);

/// A channel that some recordings do not have. It is left out if the recordings are evaluated together.
struct DroppedChannel {
  std::string name, reason;  // "it is not in records/b.csv"
};
std::vector<DroppedChannel> dropped_channels(const std::vector<Recording>& recordings);

/// Throws InputError if more than half of the channels are not in all recordings.
void check_in_common(const std::vector<Recording>& recordings);

/// Columns of `x` minus their least-squares straight lines.
Eigen::MatrixXd detrended(const Eigen::MatrixXd& x);

/// Every `factor`-th sample of the columns of x after a linear-phase low-pass (Kaiser 1974: 60 dB) that passes
/// `highest` and stops at half the new sampling frequency. The transient of the filter at both ends is removed.
Eigen::MatrixXd decimated(const Eigen::MatrixXd& x, double dt, int factor, double highest);

/// All common channels, detrended and decimated to between 2.5 and 5 times the highest frequency, without a check for
/// poor channels. Errors and the meaning of `highest_frequency` = 0 are as in prepare().
Prepared gathered(const std::vector<Recording>& recordings, double highest_frequency);

/// The same without the motion of the ground and without channels that show no motion of the structure.
///
/// `highest_frequency` (Hz) = 0 means 20, or 0.4 of the sampling frequency if that is less. Throws InputError (see
/// check_recordings), for a frequency above 0.45 of the sampling frequency, if there is no common channel or all are
/// poor, and for recordings with fewer than 64 samples after decimation.
Prepared prepare(const std::vector<Recording>& recordings, double highest_frequency);

/// Number of samples, a power of two, of a window of this length (s). For 0 s the length is the longest recording over
/// `parts`, at least 16 samples. Throws an InputError that begins with `what` for fewer than 8 samples or more samples
/// than the longest recording has.
int window_samples(const Prepared& prepared, double seconds, double parts, const char* what);

/// Extends a vector over `used` channels to all channels, with NaN for channels that were left out.
Eigen::VectorXcd over_all_channels(const Prepared& prepared, const Eigen::VectorXcd& shape);

}  // namespace voussoir
