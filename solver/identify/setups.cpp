#include "solver/identify/setups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr double apart = 0.03;          // share of the frequency: weather between setups shifts modes by less
constexpr double least_likeness = 0.6;  // MAC at the references, which are few
constexpr double unsure_scale = 0.5;    // standard deviation of a scale over the scale: the references hardly move
constexpr double same_machine = 0.005;  // share of the frequency
constexpr double least_known = 0.5;     // share of the channels in use

bool known(const std::complex<double>& value) {
  return std::isfinite(value.real());
}

double variance_of(double deviation) {
  return std::isfinite(deviation) ? deviation * deviation : 0.0;
}

/// A setup's part in a shape.
struct Member {
  Eigen::VectorXcd shape;    // over all channels, NaN: not known
  Eigen::MatrixXcd changes;  // of the shape, as IdentifiedMode::shape_changes
  double weight = 0.0;       // of its components against those known before, from 0 to 1
};

/// A mode over all channels while setups are added.
struct Track {
  IdentifiedMode mode;          // shape over all channels, NaN: not known yet
  std::vector<Member> members;  // of the shape; frequency and damping may know of more setups
  std::vector<double> frequencies, frequency_stds, dampings, damping_stds;
  int setups = 0;
};

/// All channels in the order in which the setups name them.
std::vector<std::string> all_channels(const std::vector<SsiResult>& results) {
  std::vector<std::string> all;
  for (const SsiResult& r : results)
    for (const std::string& channel : r.channels)
      if (std::find(all.begin(), all.end(), channel) == all.end()) all.push_back(channel);
  return all;
}

/// A mode of a setup over all channels.
IdentifiedMode spread_out(const IdentifiedMode& mode, const std::vector<std::string>& channels,
                          const std::vector<std::string>& all) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  IdentifiedMode out = mode;
  out.shape = Eigen::VectorXcd::Constant(Eigen::Index(all.size()), {none, none});
  out.shape_std = Eigen::VectorXd::Constant(Eigen::Index(all.size()), none);
  out.shape_changes = Eigen::MatrixXcd::Zero(Eigen::Index(all.size()), mode.shape_changes.cols());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto at = Eigen::Index(std::find(all.begin(), all.end(), channels[c]) - all.begin());
    out.shape[at] = mode.shape[Eigen::Index(c)];
    out.shape_std[at] = mode.shape_std[Eigen::Index(c)];
    if (out.shape_changes.cols() > 0) out.shape_changes.row(at) = mode.shape_changes.row(Eigen::Index(c));
  }
  return out;
}

std::vector<Eigen::Index> shared(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  std::vector<Eigen::Index> both;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    if (known(a[i]) && known(b[i])) both.push_back(i);
  return both;
}

/// How unlike two modes are, as distance() of poles but for what only one of them knows; infinite where they cannot be
/// the same.
double unlike(const IdentifiedMode& a, const IdentifiedMode& b) {
  const double never = std::numeric_limits<double>::infinity();
  const std::vector<Eigen::Index> both = shared(a.shape, b.shape);
  const double difference = std::abs(a.frequency - b.frequency) / std::max(a.frequency, b.frequency);
  if (both.empty() || difference > apart) return never;
  const double likeness = assurance(Eigen::VectorXcd(a.shape(both)), Eigen::VectorXcd(b.shape(both)));
  return likeness < least_likeness ? never : difference + 1.0 - likeness;
}

/// A number that takes the shape of a setup's mode to that of a track, by least squares at what both know, and its
/// standard deviation.
struct Scale {
  std::complex<double> factor;
  double std = 0.0;
};

Scale scale_to(const IdentifiedMode& track, const IdentifiedMode& mode) {
  const std::vector<Eigen::Index> both = shared(track.shape, mode.shape);
  const Eigen::VectorXcd from = mode.shape(both), to = track.shape(both);
  const double square = from.squaredNorm();
  Scale scale{from.dot(to) / square, 0.0};
  for (const Eigen::Index i : both)
    scale.std += std::norm(mode.shape[i]) *
                 (variance_of(track.shape_std[i]) + std::norm(scale.factor) * variance_of(mode.shape_std[i]));
  scale.std = std::sqrt(scale.std) / square;
  return scale;
}

/// Mean variance of the components at some channels.
double mean_variance(const Eigen::VectorXd& deviations, const std::vector<Eigen::Index>& at) {
  double sum = 0.0;
  for (const Eigen::Index i : at) sum += variance_of(deviations[i]);
  return sum / double(at.size());
}

/// Adds a member's shape, scaled, to one that may know some of its channels: the mean by weights there.
void add_shape(Eigen::VectorXcd& shape, const Eigen::VectorXcd& own, double weight) {
  const std::vector<Eigen::Index> both = shared(shape, own);
  const std::complex<double> factor = own(both).dot(shape(both)) / own(both).squaredNorm();
  for (Eigen::Index i = 0; i < own.size(); ++i) {
    if (!known(own[i])) continue;
    if (known(shape[i]))
      shape[i] += weight * (factor * own[i] - shape[i]);
    else
      shape[i] = factor * own[i];
  }
}

/// The members' shapes put together, 1 at `unit`; −1: as it comes.
Eigen::VectorXcd put_together(const std::vector<Member>& members, Eigen::Index unit, std::size_t changed = 0,
                              const Eigen::VectorXcd& change = {}) {
  Eigen::VectorXcd shape;
  for (std::size_t m = 0; m < members.size(); ++m) {
    Eigen::VectorXcd own = members[m].shape;
    if (change.size() > 0 && m == changed) own += change;
    if (m == 0)
      shape = own;
    else
      add_shape(shape, own, members[m].weight);
  }
  if (unit >= 0) shape /= std::complex<double>(shape[unit]);
  return shape;
}

/// What the replicates of the members make of the shape: setups are independent, so their squares add up to its
/// variance.
Eigen::MatrixXcd changes_of(const std::vector<Member>& members, const Eigen::VectorXcd& shape, Eigen::Index unit) {
  Eigen::Index columns = 0, at = 0;
  for (const Member& member : members) columns += member.changes.cols();
  Eigen::MatrixXcd changes = Eigen::MatrixXcd::Zero(shape.size(), columns);
  for (std::size_t m = 0; m < members.size(); ++m)
    for (Eigen::Index b = 0; b < members[m].changes.cols(); ++b, ++at) {
      const Eigen::VectorXcd changed = put_together(members, unit, m, members[m].changes.col(b));
      for (Eigen::Index i = 0; i < shape.size(); ++i)
        if (known(shape[i])) changes(i, at) = changed[i] - shape[i];
    }
  return changes;
}

void add_numbers(Track& track, const IdentifiedMode& mode) {
  track.frequencies.push_back(mode.frequency);
  track.frequency_stds.push_back(mode.frequency_std);
  track.dampings.push_back(mode.damping);
  track.damping_stds.push_back(mode.damping_std);
  track.mode.hits = std::min(track.mode.hits, mode.hits);
  track.mode.kurtosis = std::min(track.mode.kurtosis, mode.kurtosis);
  ++track.setups;
}

Track begun(const IdentifiedMode& mode) {
  Track track;
  track.mode = mode;
  track.members.push_back({mode.shape, mode.shape_changes, 1.0});
  add_numbers(track, mode);
  return track;
}

void add(Track& track, const IdentifiedMode& mode) {
  const Scale scale = scale_to(track.mode, mode);
  add_numbers(track, mode);
  if (!(scale.std <= unsure_scale * std::abs(scale.factor))) return;  // its size against the others is not known
  const std::vector<Eigen::Index> both = shared(track.mode.shape, mode.shape);
  const double before = mean_variance(track.mode.shape_std, both),
               own = std::norm(scale.factor) * mean_variance(mode.shape_std, both), sum = before + own;
  track.members.push_back({mode.shape, mode.shape_changes, sum > 0.0 ? before / sum : 0.5});
  track.mode.shape = put_together(track.members, -1);
  // Near enough to weigh the next member and to tell whether its scale is known.
  for (const Eigen::Index i : both) track.mode.shape_std[i] = std::sqrt(sum > 0.0 ? before * own / sum : 0.0);
  for (Eigen::Index i = 0; i < mode.shape.size(); ++i)
    if (known(mode.shape[i]) && !std::isfinite(track.mode.shape_std[i]))
      track.mode.shape_std[i] = std::sqrt(std::norm(scale.factor) * variance_of(mode.shape_std[i]) +
                                          std::norm(mode.shape[i]) * scale.std * scale.std);
}

/// 1 over the variances; none if the standard deviation of one value is not known.
std::vector<double> weights_of(const std::vector<double>& deviations) {
  std::vector<double> weights;
  for (const double deviation : deviations) {
    const double v = variance_of(deviation);
    if (!(v > 0.0)) return {};
    weights.push_back(1.0 / v);
  }
  return weights;
}

/// The weighted mean, and the sum of the weighted squares of the differences from it.
std::pair<double, double> mean_and_squares(const std::vector<double>& values, const std::vector<double>& weights) {
  double sum = 0.0, weight = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += weights[i] * values[i], weight += weights[i];
  const double mean = sum / weight;
  for (std::size_t i = 0; i < values.size(); ++i) squares += weights[i] * (values[i] - mean) * (values[i] - mean);
  return {mean, squares};
}

/// Squares of the differences between setups over their variances, and how many there are. None of either if a variance
/// is not known.
std::pair<double, int> differences(const Track& track) {
  const std::vector<double> weights = weights_of(track.frequency_stds);
  if (weights.empty()) return {0.0, 0};
  return {mean_and_squares(track.frequencies, weights).second, int(track.frequencies.size()) - 1};
}

/// The weighted mean, and a standard deviation that also contains how far the values differ. If the standard deviation
/// of a value is not known, all have the same weight, and that of the mean is not known either.
std::pair<double, double> mean_of(const std::vector<double>& values, const std::vector<double>& deviations) {
  const std::vector<double> weights = weights_of(deviations);
  if (weights.empty())
    return {mean_and_squares(values, std::vector<double>(values.size(), 1.0)).first,
            std::numeric_limits<double>::quiet_NaN()};
  const auto [mean, squares] = mean_and_squares(values, weights);
  const double weight = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double between = values.size() > 1 ? squares / weight / double(values.size() - 1) : 0.0;
  return {mean, std::sqrt(1.0 / weight + between)};
}

void finish(Track& track) {
  IdentifiedMode& mode = track.mode;
  std::tie(mode.frequency, mode.frequency_std) = mean_of(track.frequencies, track.frequency_stds);
  std::tie(mode.damping, mode.damping_std) = mean_of(track.dampings, track.damping_stds);
  Eigen::Index largest = -1;
  for (Eigen::Index i = 0; i < mode.shape.size(); ++i)
    if (known(mode.shape[i]) && (largest < 0 || std::abs(mode.shape[i]) > std::abs(mode.shape[largest]))) largest = i;
  mode.shape = put_together(track.members, largest);
  mode.shape_changes = changes_of(track.members, mode.shape, largest);
  for (Eigen::Index i = 0; i < mode.shape.size(); ++i)
    mode.shape_std[i] = known(mode.shape[i]) ? mode.shape_changes.row(i).norm() : mode.shape_std[i];
  mode.mean_phase = phase_collinearity(mode.shape);
}

/// Pairs a setup's modes with the tracks, the most alike first; what finds no partner begins a track.
void add_setup(std::vector<Track>& tracks, const std::vector<IdentifiedMode>& modes) {
  struct Pair {
    double unlike;
    std::size_t track, mode;
  };
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < tracks.size(); ++t)
    for (std::size_t m = 0; m < modes.size(); ++m)
      if (const double d = unlike(tracks[t].mode, modes[m]); std::isfinite(d)) pairs.push_back({d, t, m});
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.unlike < b.unlike; });
  std::vector<bool> track_taken(tracks.size()), mode_taken(modes.size());
  for (const Pair& pair : pairs) {
    if (track_taken[pair.track] || mode_taken[pair.mode]) continue;
    track_taken[pair.track] = mode_taken[pair.mode] = true;
    add(tracks[pair.track], modes[pair.mode]);
  }
  for (std::size_t m = 0; m < modes.size(); ++m)
    if (!mode_taken[m]) tracks.push_back(begun(modes[m]));
}

/// The setups in an order in which each shares a channel with those before, the one with most modes first.
std::vector<std::size_t> order_of(const std::vector<Setup>& setups, const std::vector<SsiResult>& results) {
  std::vector<std::size_t> order;
  std::vector<std::string> seen;
  const auto shares = [&](const SsiResult& r) {
    return seen.empty() || std::any_of(r.channels.begin(), r.channels.end(), [&](const std::string& channel) {
             return std::find(seen.begin(), seen.end(), channel) != seen.end();
           });
  };
  while (order.size() < results.size()) {
    std::size_t best = results.size();
    for (std::size_t s = 0; s < results.size(); ++s)
      if (std::find(order.begin(), order.end(), s) == order.end() && shares(results[s]) &&
          (best == results.size() || results[s].modes.size() > results[best].modes.size()))
        best = s;
    if (best == results.size()) {
      std::size_t lost = 0;
      while (std::find(order.begin(), order.end(), lost) != order.end()) ++lost;
      throw InputError(
          "recording '{}' has no channel in common with '{}'. The shapes of several setups are combined with reference "
          "sensors that stay in place. Give recordings with such sensors, or diagnose each setup separately.",
          setups[lost].name, setups[order.front()].name);
    }
    order.push_back(best);
    seen.insert(seen.end(), results[best].channels.begin(), results[best].channels.end());
  }
  return order;
}

/// Channels that no setup could use.
std::vector<PoorChannel> poor_channels(const std::vector<SsiResult>& results, const std::vector<std::string>& all) {
  std::vector<PoorChannel> poor;
  for (std::size_t c = 0; c < all.size(); ++c) {
    std::string reason;
    bool used = false;
    for (const SsiResult& r : results) {
      const auto at = std::find(r.channels.begin(), r.channels.end(), all[c]);
      if (at == r.channels.end()) continue;
      const auto fault = std::find_if(r.poor.begin(), r.poor.end(),
                                      [&](const PoorChannel& p) { return p.channel == at - r.channels.begin(); });
      if (fault == r.poor.end())
        used = true;
      else
        reason = fault->reason;
    }
    if (!used) poor.push_back({int(c), reason});
  }
  return poor;
}

/// Why a track is no mode of the whole; empty where it is.
std::string doubt(const Track& track, const std::vector<Setup>& setups, const std::vector<SsiResult>& results,
                  std::size_t usable) {
  for (std::size_t s = 0; s < results.size(); ++s)
    for (const RejectedMode& aside : results[s].set_aside)
      if (aside.mode.harmonic &&
          std::abs(aside.mode.frequency - track.mode.frequency) < same_machine * track.mode.frequency)
        return fmt::format("in {}: {}", setups[s].name, aside.reason);
  std::size_t components = 0;
  for (const std::complex<double>& value : track.mode.shape) components += known(value);
  if (double(components) < least_known * double(usable))
    return fmt::format("it is found in {} of {} setups, and only {} of {} measured it", track.setups, results.size(),
                       components, counted(usable, "channel"));
  return {};
}

}  // namespace

std::vector<Setup> setups_of(const std::vector<Recording>& recordings) {
  std::vector<Setup> setups;
  std::vector<std::vector<std::string>> channels;
  for (const Recording& recording : recordings) {
    std::vector<std::string> own = recording.channels;
    std::sort(own.begin(), own.end());
    const auto at = std::size_t(std::find(channels.begin(), channels.end(), own) - channels.begin());
    if (at == channels.size()) {
      channels.push_back(own);
      setups.emplace_back();
    }
    setups[at].name += (setups[at].name.empty() ? "" : ", ") + recording.name;
    setups[at].recordings.push_back(recording);
  }
  return setups;
}

SsiResult united(const std::vector<SsiResult>& results) {
  SsiResult all;
  all.settings = results.front().settings;
  all.dt = results.front().dt;
  all.channels = all_channels(results);
  all.poor = poor_channels(results, all.channels);
  all.setups = int(results.size());
  all.duration = results.front().duration;
  for (const SsiResult& r : results) {
    all.duration = std::min(all.duration, r.duration);
    all.too_short.insert(all.too_short.end(), r.too_short.begin(), r.too_short.end());
  }
  for (std::size_t c = 0; c < all.channels.size(); ++c)
    if (std::all_of(results.begin(), results.end(), [&](const SsiResult& r) {
          return std::find(r.channels.begin(), r.channels.end(), all.channels[c]) != r.channels.end();
        }))
      all.references.push_back(int(c));
  return all;
}

SsiResult merged(const std::vector<Setup>& setups, const std::vector<SsiResult>& results) {
  const std::vector<std::size_t> order = order_of(setups, results);
  SsiResult all = united(results);
  all.settings = results[order.front()].settings;
  std::vector<Track> tracks;
  for (const std::size_t s : order) {
    const SsiResult& r = results[s];
    all.poles.insert(all.poles.end(), r.poles.begin(), r.poles.end());
    std::vector<IdentifiedMode> modes;
    for (const IdentifiedMode& mode : r.modes) modes.push_back(spread_out(mode, r.channels, all.channels));
    add_setup(tracks, modes);
    for (const RejectedMode& aside : r.set_aside)
      all.set_aside.push_back(
          {spread_out(aside.mode, r.channels, all.channels), fmt::format("{} (in {})", aside.reason, setups[s].name)});
  }
  double squares = 0.0;
  int count = 0;
  for (Track& track : tracks) {
    const auto [square, more] = differences(track);
    squares += square, count += more;
    finish(track);
    const std::string reason = doubt(track, setups, results, all.channels.size() - all.poor.size());
    if (reason.empty())
      all.modes.push_back(track.mode);
    else
      all.set_aside.push_back({track.mode, reason});
  }
  if (count > 0) all.apart = std::sqrt(squares / count);
  const auto lower = [](double a, double b) { return a < b; };
  std::stable_sort(all.modes.begin(), all.modes.end(),
                   [&](const auto& a, const auto& b) { return lower(a.frequency, b.frequency); });
  std::stable_sort(all.set_aside.begin(), all.set_aside.end(),
                   [&](const auto& a, const auto& b) { return lower(a.mode.frequency, b.mode.frequency); });
  std::stable_sort(all.poles.begin(), all.poles.end(), [&](const Pole& a, const Pole& b) {
    return a.order != b.order ? a.order < b.order : a.frequency() < b.frequency();
  });
  return all;
}

}  // namespace voussoir
