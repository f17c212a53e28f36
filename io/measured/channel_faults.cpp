// Channels without a signal of a structure: an instrument that was off, lost its cable, reached its limits or is
// written twice.
#include <algorithm>
#include <cmath>

#include "io/measured/parts.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/identify/prepare.h"

namespace voussoir {

namespace {

constexpr double still_seconds = 1.0;  // s; no bridge has equal samples, to the last digit, for so long
constexpr Eigen::Index still_samples = 20;
constexpr double most_still = 0.05;        // share of the samples
constexpr Eigen::Index limit_run = 2;      // samples at a limit one after the other
constexpr Eigen::Index fewest_limits = 3;  // such runs
constexpr double most_at_limit = 0.01;     // share of the samples

/// Samples in runs of equal values.
struct Runs {
  Eigen::Index count = 0, samples = 0;
  Eigen::Index first = -1;  // sample
};

template <class Counts>
Runs runs_of(const Eigen::VectorXd& x, Eigen::Index least, Counts counts) {
  Runs runs;
  for (Eigen::Index begin = 0, end = 0; begin < x.size(); begin = end) {
    while (end < x.size() && x[end] == x[begin]) ++end;
    if (end - begin < least || !counts(x[begin])) continue;
    if (runs.first < 0) runs.first = begin;
    ++runs.count;
    runs.samples += end - begin;
  }
  return runs;
}

/// Whether a value, the largest or the smallest, is a limit of the instrument: it is far more frequent than the next.
bool is_limit(const Eigen::VectorXd& x, double value) {
  double next = value;
  Eigen::Index at = 0, beside = 0;
  for (const double v : x)
    if (v != value && (next == value || std::abs(v - value) < std::abs(next - value))) next = v;
  for (const double v : x) at += v == value, beside += v == next;
  return at > 3 * beside;
}

struct Fault {
  std::string what;        // empty: none
  bool set_aside = false;  // else it is a remark
};

Fault stillness(const Eigen::VectorXd& x, double dt, const std::vector<int>& rows) {
  const Eigen::Index least = std::max(still_samples, Eigen::Index(std::ceil(still_seconds / dt)));
  const Runs runs = runs_of(x, least, [](double) { return true; });
  if (runs.count == 0) return {};
  const double share = double(runs.samples) / double(x.size());
  return {fmt::format("is constant at {} from row {} on, in all for {:.3g} % of the recording: a lost cable, or a gap "
                      "that was filled",
                      x[runs.first], rows[std::size_t(runs.first)], 100.0 * share),
          share > most_still};
}

Fault limits(const Eigen::VectorXd& x, const std::vector<int>& rows) {
  const double high = x.maxCoeff(), low = x.minCoeff();
  const bool above = is_limit(x, high), below = is_limit(x, low);
  const Runs runs = runs_of(x, limit_run, [&](double v) { return (above && v == high) || (below && v == low); });
  if (runs.count < fewest_limits) return {};
  const auto at_limit =
      std::count_if(x.begin(), x.end(), [&](double v) { return (above && v == high) || (below && v == low); });
  const double share = double(at_limit) / double(x.size());
  return {fmt::format("is cut off at {} from row {} on, {}, for {:.2g} % of its samples: the limit of the instrument",
                      x[runs.first], rows[std::size_t(runs.first)], counted(runs.count, "time"), 100.0 * share),
          share > most_at_limit};
}

/// Another channel of the recording with the same values; −1: none.
Eigen::Index twin_of(const Recording& record, Eigen::Index c) {
  for (Eigen::Index other = 0; other < record.values.cols(); ++other)
    if (other != c && record.values(0, other) == record.values(0, c) &&
        record.values.col(other) == record.values.col(c))
      return other;
  return -1;
}

/// Whether there is a channel of the ground, which may be at rest before an earthquake, and the bridge with it.
bool knows_ground(const Recording& record) {
  return std::any_of(record.channels.begin(), record.channels.end(), is_base_channel);
}

Fault fault_of(const Recording& record, Eigen::Index c, const std::vector<int>& rows) {
  const Eigen::VectorXd x = record.values.col(c);
  if ((x.array() == x[0]).all()) return {fmt::format("is {} throughout", x[0]), true};
  if (is_base_channel(record.channels[std::size_t(c)])) return {};
  if (const Fault cut = limits(x, rows); !cut.what.empty()) return cut;
  if (knows_ground(record)) return {};
  if (const Eigen::Index twin = twin_of(record, c); twin >= 0)
    return {fmt::format("has the same samples as '{}'; the program cannot tell to which sensor they belong",
                        record.channels[std::size_t(twin)]),
            true};
  return stillness(x, record.dt, rows);
}

}  // namespace

void drop_faulty(Recording& record, const std::vector<int>& rows, const std::string& place, Measured& measured) {
  std::vector<Eigen::Index> kept;
  std::vector<std::string> channels;
  for (Eigen::Index c = 0; c < record.values.cols(); ++c) {
    const std::string& channel = record.channels[std::size_t(c)];
    const Fault fault = fault_of(record, c, rows);
    const std::string what = fmt::format("channel '{}' {}", channel, fault.what);
    if (fault.set_aside) {
      measured.set_aside.push_back({place, what});
      continue;
    }
    if (!fault.what.empty()) measured.remarks.push_back(fmt::format("{}: {}", record.name, what));
    kept.push_back(c);
    channels.push_back(channel);
  }
  if (channels.size() == record.channels.size()) return;
  record.values = record.values(Eigen::all, kept).eval();
  record.channels = channels;
}

}  // namespace voussoir
