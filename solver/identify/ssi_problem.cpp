#include "solver/identify/ssi_problem.h"

#include <algorithm>
#include <cmath>

#include "solver/base/error.h"
#include "solver/identify/harmonic.h"
#include "solver/identify/references.h"

namespace voussoir {

namespace {

constexpr int most_columns = 640, most_rows = 2400;  // of a Hankel matrix whose size is not asked for
constexpr int least_block_rows = 20;
constexpr int lags_per_recording = 8;  // a recording shall be that many times as long as the lags

void check(const SsiSettings& s) {
  const auto within = [](double value, double low, double high, const char* name) {
    if (!(value >= low && value <= high))
      throw InputError("identification: '{}' is {}. It must be from {} to {}.", name, value, low, high);
  };
  within(s.lowest_frequency, 0.0, 1e6, "lowest_frequency");
  if (s.largest_order != 0) within(s.largest_order, 2, 400, "largest_order");
  within(s.block_rows, 0, 10000, "block_rows");
  within(s.references, 1, 1000, "references");
  within(s.segments, 2, 1000, "segments");
  within(s.frequency_tolerance, 0.0, 1.0, "frequency_tolerance");
  within(s.damping_tolerance, 0.0, 1.0, "damping_tolerance");
  within(s.shape_tolerance, 0.0, 1.0, "shape_tolerance");
  within(s.cluster_radius, 0.0, 1.0, "cluster_radius");
  within(s.least_hits, 0.0, 1.0, "least_hits");
  within(s.least_mean_phase, 0.0, 1.0, "least_mean_phase");
  within(s.least_damping, 0.0, 1.0, "least_damping");
  within(s.largest_damping, 0.0, 1.0, "largest_damping");
}

Eigen::Index longest_of(const Prepared& prepared) {
  Eigen::Index longest = 0;
  for (const Eigen::MatrixXd& x : prepared.signals) longest = std::max(longest, x.rows());
  return longest;
}

/// Puts numbers where the settings say "choose", and makes the model fit the length of the recordings.
void resolve(SsiProblem& p) {
  SsiSettings& s = p.settings;
  s.highest_frequency = p.prepared.highest_frequency;
  if (s.lowest_frequency == 0.0) s.lowest_frequency = s.highest_frequency / 40.0;
  if (s.lowest_frequency >= s.highest_frequency)
    throw InputError("identification: the lowest frequency is {} Hz. It must be below the highest frequency, {} Hz.",
                     s.lowest_frequency, s.highest_frequency);
  // Few channels cannot hold large models: their modes would split.
  if (s.largest_order == 0) s.largest_order = p.scale.size() < 4 ? 40 : 60;
  const Eigen::Index longest = longest_of(p.prepared);
  const int most = most_block_rows(p.prepared);
  if (s.block_rows > most)
    throw InputError(
        "identification: {} block rows need a recording of {:.3g} s, but the longest recording has {:.3g} s. Choose at "
        "most {} block rows.",
        s.block_rows, 2.0 * lags_per_recording * s.block_rows * p.prepared.dt, double(longest) * p.prepared.dt, most);
  if (double(most) * p.prepared.dt < 0.25 / s.lowest_frequency)
    throw InputError(
        "identification: the longest recording has {:.3g} s. Modes at {} Hz need at least {:.3g} s. Record for longer, "
        "or choose a higher lowest_frequency.",
        double(longest) * p.prepared.dt, s.lowest_frequency, 0.5 * lags_per_recording / s.lowest_frequency);
  const int channels = int(p.scale.size()), references = int(p.references.size());
  if (s.block_rows == 0)
    s.block_rows = std::min(usual_block_rows(s, p.prepared.dt, references, channels, references), most);
  const int space = std::min(channels * (s.block_rows - 1), references * s.block_rows);
  s.largest_order = std::min(s.largest_order, space) / 2 * 2;
}

}  // namespace

Subspace SsiProblem::subspace(const std::vector<bool>& left_out) const {
  return Subspace(covariances(products, left_out), weights, int(scale.size()), settings.block_rows,
                  settings.largest_order);
}

int usual_block_rows(const SsiSettings& settings, double dt, int references, int rows, int columns) {
  const int for_frequency = int(std::ceil(0.5 / (dt * settings.lowest_frequency)));
  const int for_order = 2 * (settings.largest_order + references - 1) / references;
  const int quick = std::max(least_block_rows, std::min(most_columns / columns, most_rows / rows));
  return std::min(std::max(for_frequency, for_order), quick);
}

int most_block_rows(const Prepared& prepared) {
  return int(longest_of(prepared) / (2 * lags_per_recording));
}

SsiProblem set_up(const std::vector<Recording>& recordings, const SsiSettings& settings) {
  check(settings);
  SsiProblem p;
  p.settings = settings;
  p.prepared = prepare(recordings, settings.highest_frequency);
  p.references = choose_references(p.prepared, settings.references);
  p.scale.setZero(Eigen::Index(p.prepared.used.size()));
  for (const Eigen::MatrixXd& x : p.prepared.signals) p.scale += x.colwise().squaredNorm().transpose();
  p.scale = (p.scale / double(p.prepared.samples())).cwiseSqrt();
  resolve(p);
  std::vector<Eigen::MatrixXd> scaled;
  for (const Eigen::MatrixXd& x : p.prepared.signals) scaled.emplace_back(x * p.scale.cwiseInverse().asDiagonal());
  p.products = lagged_products(scaled, p.references, 2 * p.settings.block_rows - 1, p.settings.segments);
  for (std::size_t r = 0; r < recordings.size(); ++r)
    if (p.prepared.signals[r].rows() <= p.products.lags)
      p.too_short.push_back(
          {recordings[r].name, fmt::format("it has {:.3g} s, but the correlations need more than {:.3g} s",
                                           recordings[r].duration(), p.prepared.dt * double(p.products.lags))});
  p.weights = canonical_weights(scaled, p.references, p.settings.block_rows);
  return p;
}

SsiResult described(const SsiProblem& p) {
  SsiResult result;
  result.channels = p.prepared.channels;
  result.poor = p.prepared.poor;
  result.too_short = p.too_short;
  for (const int r : p.references) result.references.push_back(p.prepared.used[std::size_t(r)]);
  result.settings = p.settings;
  result.dt = p.prepared.dt;
  result.duration = p.prepared.dt * double(p.prepared.samples());
  return result;
}

void listen(const Prepared& p, IdentifiedMode& mode) {
  const Narrowband band = narrowband_kurtosis(p.signals, p.dt, mode.frequency, mode.damping, mode.shape);
  mode.kurtosis = band.kurtosis;
  const Stops stops = fast_stops(p.signals, p.dt, mode.frequency, mode.damping, mode.shape);
  mode.stops = stops.count;
  mode.stopped = stops.share;
  mode.intermittent = is_intermittent(stops);
  mode.harmonic = mode.intermittent || is_harmonic(band, mode.damping);
}

}  // namespace voussoir
