// Reference-based covariance-driven stochastic subspace identification (Peeters & De Roeck 1999) at all even orders,
// modes picked from the stabilisation diagram, standard deviations by the jackknife over segments (Efron & Stein 1981).
#include "solver/identify/ssi.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "solver/base/error.h"
#include "solver/base/random.h"
#include "solver/identify/harmonic.h"
#include "solver/identify/picking.h"
#include "solver/identify/references.h"
#include "solver/identify/setups.h"

namespace voussoir {

namespace {

constexpr int most_columns = 640, most_rows = 2400;  // of a Hankel matrix whose size is not asked for
constexpr int least_block_rows = 20;
constexpr int lags_per_recording = 8;  // a recording shall be that many times as long as the lags
constexpr int parts = 4;               // of the segments, one left out at a time
constexpr int replicates = 20;
constexpr double least_found = 0.75;     // share of the replicates that must show a mode
constexpr double least_seen = 0.8;       // of the hits of a mode: what appears less often is not worth a word
constexpr double sure_hits = 0.6;        // share of the orders
constexpr double sure_damping = 0.5;     // standard deviation of a damping over the damping
constexpr double same_shape = 0.9;       // MAC
constexpr double match_radius = 0.3;     // distance() of a replicate's pole
constexpr double nearly_all = 0.75;      // share of the channels that recordings taken together have in common
constexpr double largest_spread = 0.03;  // standard deviation of a frequency over the frequency

/// All that the models of one set of recordings share.
struct Problem {
  Prepared prepared;
  std::vector<int> references;  // columns of the signals
  Eigen::VectorXd scale;        // m/s2 per channel in use: the signals are divided by it
  LaggedProducts products;
  CanonicalWeights weights;
  SsiSettings settings;
  std::vector<Pole> poles_of(const Subspace& space, int order) const {
    return space.poles(order, prepared.dt, prepared.highest_frequency, scale);
  }
  Subspace subspace(const std::vector<bool>& left_out = {}) const {
    return Subspace(covariances(products, left_out), weights, int(scale.size()), settings.block_rows,
                    settings.largest_order);
  }
};

void check(const SsiSettings& s) {
  const auto within = [](double value, double low, double high, const char* name) {
    if (!(value >= low && value <= high))
      throw InputError("identification: '{}' is {}: must be from {} to {}", name, value, low, high);
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

/// Half a period of the lowest frequency (Reynders & De Roeck 2008), enough for the order, and no more than is quick.
int usual_block_rows(const Problem& p) {
  const int references = int(p.references.size()), channels = int(p.scale.size());
  const int for_frequency = int(std::ceil(0.5 / (p.prepared.dt * p.settings.lowest_frequency)));
  const int for_order = 2 * (p.settings.largest_order + references - 1) / references;
  const int quick = std::max(least_block_rows, std::min(most_columns / references, most_rows / channels));
  return std::min(std::max(for_frequency, for_order), quick);
}

/// Puts numbers where the settings say "choose", and makes the model fit the length of the recordings.
void resolve(Problem& p) {
  SsiSettings& s = p.settings;
  s.highest_frequency = p.prepared.highest_frequency;
  if (s.lowest_frequency == 0.0) s.lowest_frequency = s.highest_frequency / 40.0;
  if (s.lowest_frequency >= s.highest_frequency)
    throw InputError("identification: the lowest frequency {} Hz is not below the highest, {} Hz; lower it",
                     s.lowest_frequency, s.highest_frequency);
  // Few channels cannot hold large models: their modes would split.
  if (s.largest_order == 0) s.largest_order = p.scale.size() < 4 ? 40 : 60;
  Eigen::Index longest = 0;
  for (const Eigen::MatrixXd& x : p.prepared.signals) longest = std::max(longest, x.rows());
  const auto most = int(longest / (2 * lags_per_recording));
  if (s.block_rows > most)
    throw InputError("identification: {} block rows need {:.3g} s of recording, the longest has {:.3g} s; ask for {}",
                     s.block_rows, 2.0 * lags_per_recording * s.block_rows * p.prepared.dt,
                     double(longest) * p.prepared.dt, most);
  if (double(most) * p.prepared.dt < 0.25 / s.lowest_frequency)
    throw InputError(
        "identification: the longest recording has {:.3g} s, too short for modes at {} Hz: at least {:.3g} "
        "s are needed; record for longer or ask for a higher lowest_frequency",
        double(longest) * p.prepared.dt, s.lowest_frequency, 0.5 * lags_per_recording / s.lowest_frequency);
  if (s.block_rows == 0) s.block_rows = std::min(usual_block_rows(p), most);
  const int space = std::min(int(p.scale.size()) * (s.block_rows - 1), int(p.references.size()) * s.block_rows);
  s.largest_order = std::min(s.largest_order, space) / 2 * 2;
}

Problem set_up(const std::vector<Recording>& recordings, const SsiSettings& settings) {
  check(settings);
  Problem p;
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
  p.weights = canonical_weights(scaled, p.references, p.settings.block_rows);
  return p;
}

std::vector<Pole> diagram(const Problem& p, const Subspace& space) {
  std::vector<Pole> all;
  for (int order = 2; order <= std::min(p.settings.largest_order, space.largest_order()); order += 2)
    for (Pole& pole : p.poles_of(space, order)) all.push_back(std::move(pole));
  mark_stable(all, p.settings.frequency_tolerance, p.settings.damping_tolerance, p.settings.shape_tolerance);
  return all;
}

/// Sums for the variance of a mode over the replicates.
struct Spread {
  int found = 0;
  double f = 0.0, f2 = 0.0, z = 0.0, z2 = 0.0;  // deviations from the estimate
  Eigen::VectorXcd shape;
  Eigen::VectorXd shape2;
  void add(const IdentifiedMode& mode, const Pole& pole) {
    const double df = pole.frequency() - mode.frequency, dz = pole.damping() - mode.damping;
    // The same component is 1 in both, else the normalisation would jump where two are alike.
    Eigen::Index largest = 0;
    mode.shape.cwiseAbs().maxCoeff(&largest);
    const Eigen::VectorXcd change = pole.shape / pole.shape[largest] - mode.shape;
    if (found++ == 0) {
      shape.setZero(change.size());
      shape2.setZero(change.size());
    }
    f += df;
    f2 += df * df;
    z += dz;
    z2 += dz * dz;
    shape += change;
    shape2 += change.cwiseAbs2();
  }
  /// With d of B segments left out the variance is (B − d) / d times that of the replicates (Shao & Wu 1989).
  static double deviation(double sum, double squares, int n) {
    return std::sqrt(std::max(0.0, squares - sum * sum / n) / n * (parts - 1.0));
  }
  void give(IdentifiedMode& mode) const {
    mode.frequency_std = deviation(f, f2, found);
    mode.damping_std = deviation(z, z2, found);
    mode.shape_std.resize(mode.shape.size());
    for (Eigen::Index i = 0; i < shape.size(); ++i) mode.shape_std[i] = deviation(std::abs(shape[i]), shape2[i], found);
  }
};

/// What is known of a mode before its spread.
struct Candidate {
  IdentifiedMode mode;
  Pole pole;
  std::vector<int> orders;  // at which it appears
  Spread spread;
};

/// A mode without a part of the recordings, by the same rule as with all: the pole nearest to all its like at the
/// other orders.
int find_again(const std::map<int, std::vector<Pole>>& poles, const Candidate& candidate, std::vector<Pole>& alike) {
  alike.clear();
  for (const int order : candidate.orders) {
    const auto at = poles.find(order);
    if (at == poles.end()) continue;
    const int i = nearest(at->second, candidate.pole);
    if (i >= 0 && distance(at->second[std::size_t(i)], candidate.pole) < match_radius)
      alike.push_back(at->second[std::size_t(i)]);
  }
  return medoid(alike);
}

/// The segments in `parts` parts drawn at random, and again until there are enough parts: each segment is left out
/// equally often. The stream is always the same.
std::vector<std::vector<bool>> parts_to_leave_out(int segments) {
  std::vector<std::vector<bool>> result;
  RandomStream random(1);
  while (int(result.size()) < replicates) {
    std::vector<int> order(static_cast<std::size_t>(segments));
    for (int i = 0; i < segments; ++i) {
      const std::size_t j = random.below(std::size_t(i) + 1);
      order[std::size_t(i)] = order[j];
      order[j] = i;
    }
    for (int part = 0; part < parts; ++part) {
      result.emplace_back(std::size_t(segments), false);
      for (int i = part; i < segments; i += parts) result.back()[std::size_t(order[std::size_t(i)])] = true;
    }
  }
  return result;
}

/// All candidates again without a part of the recordings, for each part.
void jackknife(const Problem& p, std::vector<Candidate>& candidates) {
  std::vector<Pole> alike;
  if (candidates.empty() || int(p.products.sums.size()) < parts) return;
  for (const std::vector<bool>& left_out : parts_to_leave_out(int(p.products.sums.size()))) {
    const Subspace space = p.subspace(left_out);
    std::map<int, std::vector<Pole>> poles;  // by order
    for (int order = 2; order <= std::min(p.settings.largest_order, space.largest_order()); order += 2)
      poles[order] = p.poles_of(space, order);
    for (Candidate& candidate : candidates) {
      const int i = find_again(poles, candidate, alike);
      if (i >= 0) candidate.spread.add(candidate.mode, alike[std::size_t(i)]);
    }
  }
}

IdentifiedMode mode_of(const Problem& p, const Pole& pole, int hits) {
  IdentifiedMode mode;
  mode.frequency = pole.frequency();
  mode.damping = pole.damping();
  mode.shape = pole.shape;
  mode.order = pole.order;
  mode.hits = hits;
  mode.mean_phase = phase_collinearity(pole.shape);
  const Narrowband band =
      narrowband_kurtosis(p.prepared.signals, p.prepared.dt, mode.frequency, mode.damping, pole.shape);
  mode.kurtosis = band.kurtosis;
  const Stops stops = fast_stops(p.prepared.signals, p.prepared.dt, mode.frequency, mode.damping, pole.shape);
  mode.stops = stops.count;
  mode.stopped = stops.share;
  mode.intermittent = is_intermittent(stops);
  mode.harmonic = mode.intermittent || is_harmonic(band, mode.damping);
  return mode;
}

/// Why it is not a mode of the structure, empty where it is.
std::string doubt(const Problem& p, const IdentifiedMode& mode, const Spread& spread) {
  const int orders = p.settings.largest_order / 2;
  if (mode.intermittent)
    return fmt::format(
        "a machine that runs now and then: it stops {} times faster than a structure with its damping of {:.2f} % "
        "rings down, and loses {:.0f} % of its energy so",
        mode.stops, 100.0 * mode.damping, 100.0 * mode.stopped);
  if (mode.harmonic)
    return fmt::format("a harmonic: the kurtosis about its frequency is {:.2f}, that of noise is 3", mode.kurtosis);
  if (mode.damping > 0.0 && mode.damping < p.settings.least_damping)
    return fmt::format("its damping of {:.3f} % is below {:g} %: a machine, for no masonry has so little",
                       100.0 * mode.damping, 100.0 * p.settings.least_damping);
  if (!(mode.damping > 0.0 && mode.damping < p.settings.largest_damping))
    return fmt::format("its damping ratio is {:.4f}", mode.damping);
  if (mode.hits < p.settings.least_hits * orders)
    return fmt::format("stable at {} of {} orders only", mode.hits, orders);
  if (mode.mean_phase < p.settings.least_mean_phase)
    return fmt::format("its points do not move in phase: collinearity {:.2f}", mode.mean_phase);
  if (int(p.products.sums.size()) >= parts && spread.found < least_found * replicates)
    return fmt::format("found again without a part of the recording in {} of {} tries only", spread.found, replicates);
  // What noise makes is never as stable as that, and never as sure of its frequency and damping.
  if (mode.hits >= sure_hits * orders) return {};
  if (mode.frequency_std > largest_spread * mode.frequency)
    return fmt::format("stable at {} of {} orders only, its frequency uncertain by {:.1f} %", mode.hits, orders,
                       100.0 * mode.frequency_std / mode.frequency);
  if (mode.damping_std > sure_damping * mode.damping)
    return fmt::format("stable at {} of {} orders only, its damping ratio of {:.4f} uncertain by {:.4f}", mode.hits,
                       orders, mode.damping, mode.damping_std);
  return {};
}

void expand(const Prepared& prepared, IdentifiedMode& mode) {
  mode.shape_std = over_all_channels(prepared, mode.shape_std.cast<std::complex<double>>()).real();
  mode.shape = over_all_channels(prepared, mode.shape);
}

/// The mode with more hits that a candidate cannot be told from, null when there is none: at orders too high a
/// mode splits in two.
const IdentifiedMode* original(const std::vector<IdentifiedMode>& modes, const IdentifiedMode& mode) {
  for (const IdentifiedMode& other : modes)
    if (std::abs(other.frequency - mode.frequency) < 2.0 * mode.frequency_std &&
        assurance(other.shape, mode.shape) > same_shape)
      return &other;
  return nullptr;
}

void sort_out(const Problem& p, std::vector<Candidate>& candidates, SsiResult& result) {
  // The better of two that cannot be told apart comes first.
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.mode.hits > b.mode.hits; });
  for (Candidate& candidate : candidates) {
    IdentifiedMode& mode = candidate.mode;
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    mode.shape_std = Eigen::VectorXd::Constant(mode.shape.size(), unknown);
    mode.frequency_std = mode.damping_std = unknown;
    if (candidate.spread.found > 1) candidate.spread.give(mode);
    std::string reason = doubt(p, mode, candidate.spread);
    if (const IdentifiedMode* first = reason.empty() ? original(result.modes, mode) : nullptr)
      reason = fmt::format("the mode at {:.3f} Hz again: they cannot be told apart", first->frequency);
    if (reason.empty())
      result.modes.push_back(mode);
    else
      result.set_aside.push_back({mode, reason});
  }
  for (IdentifiedMode& mode : result.modes) expand(p.prepared, mode);
  for (RejectedMode& aside : result.set_aside) expand(p.prepared, aside.mode);
  std::stable_sort(result.modes.begin(), result.modes.end(),
                   [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  std::stable_sort(result.set_aside.begin(), result.set_aside.end(),
                   [](const auto& a, const auto& b) { return a.mode.frequency < b.mode.frequency; });
}

SsiResult described(const Problem& p) {
  SsiResult result;
  result.channels = p.prepared.channels;
  result.poor = p.prepared.poor;
  for (const int r : p.references) result.references.push_back(p.prepared.used[std::size_t(r)]);
  result.settings = p.settings;
  result.dt = p.prepared.dt;
  result.duration = p.prepared.dt * double(p.prepared.samples());
  return result;
}

}  // namespace

double phase_collinearity(const Eigen::VectorXcd& shape) {
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (const std::complex<double>& c : shape) {
    if (std::isnan(c.real())) continue;
    xx += c.real() * c.real();
    yy += c.imag() * c.imag();
    xy += c.real() * c.imag();
  }
  const double sum = xx + yy;
  return sum > 0.0 ? ((xx - yy) * (xx - yy) + 4.0 * xy * xy) / (sum * sum) : 0.0;
}

namespace {

/// Of recordings taken together.
SsiResult identify_together(const std::vector<Recording>& recordings, const SsiSettings& settings) {
  const Problem p = set_up(recordings, settings);
  SsiResult result = described(p);
  result.poles = diagram(p, p.subspace());
  const int orders = p.settings.largest_order / 2;
  const int least_members = std::max(2, int(std::ceil(least_seen * p.settings.least_hits * orders)));
  std::vector<Candidate> candidates;
  for (const Cluster& cluster : find_clusters(result.poles, p.settings.lowest_frequency, p.settings.largest_damping,
                                              p.settings.cluster_radius, least_members)) {
    Candidate candidate;
    candidate.pole = result.poles[std::size_t(cluster.centre)];
    candidate.mode = mode_of(p, candidate.pole, cluster.hits);
    for (const int member : cluster.members) candidate.orders.push_back(result.poles[std::size_t(member)].order);
    candidates.push_back(std::move(candidate));
  }
  jackknife(p, candidates);
  sort_out(p, candidates, result);
  return result;
}

}  // namespace

SsiResult identify_modes(const std::vector<Recording>& recordings, const SsiSettings& settings) {
  check_recordings(recordings);
  const ChannelCounts counts = count_channels(recordings);
  if (double(counts.common) >= nearly_all * double(counts.all)) return identify_together(recordings, settings);
  const std::vector<Setup> setups = setups_of(recordings);
  std::vector<SsiResult> results;
  for (const Setup& setup : setups) results.push_back(identify_together(setup.recordings, settings));
  return merged(setups, results);
}

}  // namespace voussoir
