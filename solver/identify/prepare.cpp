#include "solver/identify/prepare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/identify/spectra.h"

namespace voussoir {

namespace {

constexpr double usual_highest = 20.0;  // Hz: bridges of stone have their first modes well below
constexpr double least_rate = 2.5;      // sampling frequency kept, over the highest frequency
constexpr Eigen::Index least_samples = 64;
constexpr double least_coherence = 0.25;
constexpr double rings_alone = 30.0;  // highest line of a spectrum over its median: noise has no such peak

void check_recording(const Recording& r) {
  if (!(r.dt > 0.0) || !std::isfinite(r.dt))
    throw InputError("recording '{}': the time step is {} s. It must be above 0. Check the header of the file.", r.name,
                     r.dt);
  if (r.values.rows() < 2 || r.values.cols() < 1)
    throw InputError("recording '{}' has {} of {}. At least 2 samples of 1 channel are needed.", r.name,
                     counted(r.values.rows(), "sample"), counted(r.values.cols(), "channel"));
  if (Eigen::Index(r.channels.size()) != r.values.cols())
    throw InputError("recording '{}' has {} but {}. Give one name for each column.", r.name,
                     counted(r.values.cols(), "column"), counted(r.channels.size(), "channel name"));
  for (std::size_t c = 0; c < r.channels.size(); ++c) {
    if (std::count(r.channels.begin(), r.channels.end(), r.channels[c]) > 1)
      throw InputError("recording '{}': two channels have the name '{}'. Give each channel a different name.", r.name,
                       r.channels[c]);
    for (Eigen::Index i = 0; i < r.values.rows(); ++i)
      if (!std::isfinite(r.values(i, Eigen::Index(c))))
        throw InputError(
            "recording '{}', channel '{}': sample {} is {}. It must be a finite number. Cut out or fill the gap.",
            r.name, r.channels[c], i + 1, r.values(i, Eigen::Index(c)));
  }
}

std::vector<std::string> common_channels(const std::vector<Recording>& recordings) {
  std::vector<std::string> common;
  for (const std::string& name : recordings.front().channels) {
    const bool everywhere = std::all_of(recordings.begin(), recordings.end(), [&](const Recording& r) {
      return std::find(r.channels.begin(), r.channels.end(), name) != r.channels.end();
    });
    if (everywhere) common.push_back(name);
  }
  if (common.empty())
    throw InputError(
        "the recordings have no channel in common. Give recordings of the same sensors, with the same channel names.");
  return common;
}

/// The columns of a recording that have the given names, in their order.
Eigen::MatrixXd columns(const Recording& recording, const std::vector<std::string>& names) {
  Eigen::MatrixXd x(recording.values.rows(), Eigen::Index(names.size()));
  for (std::size_t c = 0; c < names.size(); ++c) {
    const auto at = std::find(recording.channels.begin(), recording.channels.end(), names[c]);
    x.col(Eigen::Index(c)) = recording.values.col(at - recording.channels.begin());
  }
  return x;
}

/// Half of a symmetric low-pass, its middle first: windowed sinc with a cut-off half-way (Kaiser 1974).
Eigen::VectorXd low_pass(double dt, double pass, double stop) {
  constexpr double attenuation = 60.0;  // dB
  constexpr double beta = 0.1102 * (attenuation - 8.7);
  const int half = int(std::ceil((attenuation - 8.0) / (2.285 * two_pi * (stop - pass) * dt) / 2.0));
  const double cut = two_pi * 0.5 * (pass + stop) * dt;
  Eigen::VectorXd h(half + 1);
  h[0] = cut / pi;
  for (int i = 1; i <= half; ++i) {
    const double r = double(i) / half, taper = std::cyl_bessel_i(0.0, beta * std::sqrt(1.0 - r * r));
    h[i] = std::sin(cut * i) / (pi * i) * taper / std::cyl_bessel_i(0.0, beta);
  }
  return h / (h[0] + 2.0 * h.tail(half).sum());
}

Eigen::VectorXd standard_deviations(const std::vector<Eigen::MatrixXd>& signals) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(signals.front().cols());
  double samples = 0.0;
  for (const Eigen::MatrixXd& x : signals) {
    sum += x.colwise().squaredNorm().transpose();
    samples += double(x.rows());
  }
  return (sum / samples).cwiseSqrt();
}

/// The largest coherence (Bendat & Piersol 2010, chapter 6) of each channel with any other at any line.
Eigen::VectorXd largest_coherence(const CrossSpectra& spectra) {
  const Eigen::Index n = spectra.density.front().rows();
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(n);
  for (std::size_t k = 2; k < spectra.density.size(); ++k) {
    const Eigen::MatrixXcd& g = spectra.density[k];
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        const double both = g(i, i).real() * g(j, j).real();
        if (i != j && both > 0.0) largest[i] = std::max(largest[i], std::norm(g(i, j)) / both);
      }
  }
  return largest;
}

/// The highest line of a channel's spectrum over the median of its lines.
double peak_over_median(const CrossSpectra& spectra, Eigen::Index channel) {
  std::vector<double> lines;
  for (std::size_t k = 2; k < spectra.density.size(); ++k) lines.push_back(spectra.density[k](channel, channel).real());
  std::sort(lines.begin(), lines.end());
  return lines.empty() ? 0.0 : lines.back() / lines[lines.size() / 2];
}

/// What coherence of noise with noise exceeds once in a thousand recordings (Carter, Knapp & Nuttall 1973).
double coherence_by_chance(const CrossSpectra& spectra) {
  const double tries = double(spectra.density.size()) * double(spectra.density.front().rows());
  return 1.0 - std::pow(1e-3 / tries, 1.0 / (spectra.averages - 1.0));
}

/// Why a column of the signals is not to be used, empty where it is; `names` are those of the columns.
std::vector<std::string> channel_faults(const Prepared& p) {
  const auto n = p.channels.size();
  std::vector<std::string> fault(n);
  const Eigen::VectorXd size = standard_deviations(p.signals);
  for (std::size_t c = 0; c < n; ++c) {
    if (is_base_channel(p.channels[c]))
      fault[c] = "it is the motion of the ground, not a response";
    else if (!(size[Eigen::Index(c)] > 1e-6 * size.maxCoeff()))
      fault[c] = "it does not move";
  }
  if (n < 2) return fault;
  const int window = std::min(512, power_of_two_below(double(p.samples()) / 30.0));
  if (window < 16) return fault;
  const CrossSpectra spectra = cross_spectra(p.signals, p.dt, window, p.highest_frequency);
  if (spectra.averages < 16.0) return fault;
  const Eigen::VectorXd coherence = largest_coherence(spectra);
  const double limit = std::max(least_coherence, coherence_by_chance(spectra));
  for (std::size_t c = 0; c < n; ++c)
    if (fault[c].empty() && coherence[Eigen::Index(c)] < limit &&
        peak_over_median(spectra, Eigen::Index(c)) < rings_alone)
      fault[c] =
          fmt::format("it is noise: its coherence with the other channels is nowhere above {:.2f} ({:.2f} expected)",
                      coherence[Eigen::Index(c)], limit);
  return fault;
}

void leave_out_poor(Prepared& p) {
  const std::vector<std::string> fault = channel_faults(p);
  p.used.clear();
  for (std::size_t c = 0; c < fault.size(); ++c) {
    if (fault[c].empty())
      p.used.push_back(int(c));
    else
      p.poor.push_back({int(c), fault[c]});
  }
  if (p.used.empty())
    throw InputError("no channel is usable ('{}': {}). Give recordings in which the structure moves.",
                     p.channels.front(), fault.front());
  for (Eigen::MatrixXd& x : p.signals) x = Eigen::MatrixXd(x(Eigen::all, p.used));
}

double checked_highest(const std::vector<Recording>& recordings, double highest) {
  const double rate = 1.0 / recordings.front().dt;
  if (highest == 0.0) return std::min(usual_highest, 0.4 * rate);
  if (!(highest > 0.0) || highest > 0.45 * rate)
    throw InputError(
        "identification: the highest frequency is {} Hz. With {} samples per second it must be above 0 and at most {} "
        "Hz.",
        highest, rate, 0.45 * rate);
  return highest;
}

}  // namespace

Eigen::Index Prepared::samples() const {
  Eigen::Index n = 0;
  for (const Eigen::MatrixXd& x : signals) n += x.rows();
  return n;
}

namespace {

/// Of each channel the recordings without it.
std::vector<std::pair<std::string, std::vector<std::string>>> absences(const std::vector<Recording>& recordings) {
  std::vector<std::pair<std::string, std::vector<std::string>>> all;
  for (const Recording& r : recordings)
    for (const std::string& channel : r.channels)
      if (std::none_of(all.begin(), all.end(), [&](const auto& known) { return known.first == channel; }))
        all.push_back({channel, {}});
  for (auto& [channel, absent] : all)
    for (const Recording& r : recordings)
      if (std::find(r.channels.begin(), r.channels.end(), channel) == r.channels.end()) absent.push_back(r.name);
  return all;
}

}  // namespace

ChannelCounts count_channels(const std::vector<Recording>& recordings) {
  ChannelCounts counts;
  for (const auto& [channel, absent] : absences(recordings)) {
    if (is_base_channel(channel)) continue;
    ++counts.all;
    counts.common += absent.empty();
  }
  return counts;
}

std::vector<DroppedChannel> dropped_channels(const std::vector<Recording>& recordings) {
  std::vector<DroppedChannel> dropped;
  for (const auto& [channel, absent] : absences(recordings))
    if (!absent.empty())
      dropped.push_back(
          {channel, fmt::format("it is not in {}{}", absent.front(),
                                absent.size() > 1 ? fmt::format(" and {} more", absent.size() - 1) : "")});
  return dropped;
}

void check_in_common(const std::vector<Recording>& recordings) {
  const ChannelCounts counts = count_channels(recordings);
  if (2 * counts.common >= counts.all) return;
  const DroppedChannel first = dropped_channels(recordings).front();
  throw InputError(
      "only {} of {} channels are in all recordings ('{}': {}). With the motion of the ground, all recordings are "
      "evaluated together. Give recordings of the same sensors, or diagnose each setup separately.",
      counts.common, counts.all, first.name, first.reason);
}

bool is_base_channel(const std::string& name) {
  return name == "base_x" || name == "base_y" || name == "base_z";
}

void check_recordings(const std::vector<Recording>& recordings) {
  if (recordings.empty()) throw InputError("identification: there is no recording. Give at least one.");
  for (const Recording& r : recordings) {
    check_recording(r);
    if (std::abs(r.dt - recordings.front().dt) > 1e-6 * r.dt)
      throw InputError("recording '{}' has a time step of {} s, but '{}' has {} s. Resample one of them.", r.name, r.dt,
                       recordings.front().name, recordings.front().dt);
  }
}

Eigen::MatrixXd detrended(const Eigen::MatrixXd& x) {
  const Eigen::Index n = x.rows();
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(n, -1.0, 1.0);
  const Eigen::RowVectorXd mean = x.colwise().mean(), slope = t.transpose() * x / t.squaredNorm();
  return x.rowwise() - mean - t * slope;
}

Eigen::MatrixXd decimated(const Eigen::MatrixXd& x, double dt, int factor, double highest) {
  if (factor == 1) return x;
  const Eigen::VectorXd h = low_pass(dt, highest, 0.5 / (dt * factor));
  const Eigen::Index half = h.size() - 1;
  const Eigen::Index n = x.rows() > 2 * half ? (x.rows() - 2 * half - 1) / factor + 1 : 0;
  Eigen::VectorXd filter(2 * half + 1);
  filter << h.tail(half).reverse(), h;
  Eigen::MatrixXd y(n, x.cols());
  for (Eigen::Index c = 0; c < x.cols(); ++c)
    for (Eigen::Index i = 0; i < n; ++i) y(i, c) = filter.dot(x.col(c).segment(i * factor, filter.size()));
  return y;
}

Prepared gathered(const std::vector<Recording>& recordings, double highest_frequency) {
  check_recordings(recordings);
  Prepared p;
  p.highest_frequency = checked_highest(recordings, highest_frequency);
  p.channels = common_channels(recordings);
  const double dt = recordings.front().dt;
  const int factor = std::max(1, int(std::floor(1.0 / (dt * least_rate * p.highest_frequency) + 1e-9)));
  p.dt = dt * factor;
  for (const Recording& r : recordings) {
    p.signals.push_back(detrended(decimated(detrended(columns(r, p.channels)), dt, factor, p.highest_frequency)));
    if (p.signals.back().rows() < least_samples)
      throw InputError(
          "recording '{}' lasts {:.3g} s. At least {:.3g} s are needed to identify modes up to {} Hz. Record for "
          "longer.",
          r.name, r.duration(), p.dt * double(least_samples + 40), p.highest_frequency);
  }
  for (std::size_t c = 0; c < p.channels.size(); ++c) p.used.push_back(int(c));
  return p;
}

Prepared prepare(const std::vector<Recording>& recordings, double highest_frequency) {
  Prepared p = gathered(recordings, highest_frequency);
  leave_out_poor(p);
  return p;
}

Eigen::VectorXcd over_all_channels(const Prepared& prepared, const Eigen::VectorXcd& shape) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXcd all = Eigen::VectorXcd::Constant(Eigen::Index(prepared.channels.size()), {none, none});
  for (std::size_t i = 0; i < prepared.used.size(); ++i) all[prepared.used[i]] = shape[Eigen::Index(i)];
  return all;
}

int window_samples(const Prepared& p, double seconds, double parts, const char* what) {
  Eigen::Index longest = 0;
  for (const Eigen::MatrixXd& x : p.signals) longest = std::max(longest, x.rows());
  if (seconds == 0.0) return std::max(16, power_of_two_below(double(longest) / parts));
  if (!(seconds >= 8.0 * p.dt) || seconds > double(longest) * p.dt)
    throw InputError("{}: the window is {} s. It must be from {:.3g} s to {:.3g} s.", what, seconds, 8.0 * p.dt,
                     double(longest) * p.dt);
  return power_of_two_below(seconds / p.dt * (1.0 + 1e-9));
}

}  // namespace voussoir
