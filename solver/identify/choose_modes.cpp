// Modes picked from the stabilisation diagram; standard deviations by the jackknife over segments (Efron & Stein 1981).
#include "solver/identify/choose_modes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/random.h"
#include "solver/identify/picking.h"

namespace voussoir {

namespace {

constexpr int parts = 4;  // of the segments, one left out at a time
constexpr int replicates = 20;
constexpr double least_found = 0.75;     // share of the replicates that must show a mode
constexpr double least_seen = 0.8;       // of the hits of a mode: what appears less often is not worth a word
constexpr double sure_hits = 0.6;        // share of the orders
constexpr double sure_damping = 0.5;     // standard deviation of a damping over the damping
constexpr double same_shape = 0.9;       // MAC
constexpr double match_radius = 0.3;     // distance() of a replicate's pole
constexpr double largest_spread = 0.03;  // standard deviation of a frequency over the frequency

std::vector<Pole> diagram(const SsiSettings& s, const Models& models) {
  std::vector<Pole> all;
  for (int order = 2; order <= std::min(s.largest_order, models.largest_order); order += 2)
    for (Pole& pole : models.poles(order)) all.push_back(std::move(pole));
  mark_stable(all, s.frequency_tolerance, s.damping_tolerance, s.shape_tolerance);
  return all;
}

/// Sums for the variance of a mode over the replicates.
struct Spread {
  int found = 0;
  double f = 0.0, f2 = 0.0, z = 0.0, z2 = 0.0;  // deviations from the estimate
  Eigen::VectorXcd shape;
  Eigen::VectorXd shape2;
  std::vector<Eigen::VectorXcd> changes;  // of the shape
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
    changes.push_back(change);
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
    mode.shape_changes.resize(shape.size(), found);
    for (int b = 0; b < found; ++b)
      mode.shape_changes.col(b) = (changes[std::size_t(b)] - shape / found) * std::sqrt((parts - 1.0) / found);
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
void jackknife(const ModelSource& source, std::vector<Candidate>& candidates) {
  std::vector<Pole> alike;
  if (candidates.empty() || source.segments < parts) return;
  for (const std::vector<bool>& left_out : parts_to_leave_out(source.segments)) {
    const Models models = source.models(left_out);
    std::map<int, std::vector<Pole>> poles;  // by order
    for (int order = 2; order <= std::min(source.settings.largest_order, models.largest_order); order += 2)
      poles[order] = models.poles(order);
    for (Candidate& candidate : candidates) {
      const int i = find_again(poles, candidate, alike);
      if (i >= 0) candidate.spread.add(candidate.mode, alike[std::size_t(i)]);
    }
  }
}

IdentifiedMode mode_of(const ModelSource& source, const Pole& pole, int hits) {
  IdentifiedMode mode;
  mode.frequency = pole.frequency();
  mode.damping = pole.damping();
  mode.shape = pole.shape;
  mode.order = pole.order;
  mode.hits = hits;
  mode.mean_phase = phase_collinearity(pole.shape);
  source.listen(mode);
  return mode;
}

/// Why it is not a mode of the structure, empty where it is.
std::string doubt(const ModelSource& source, const IdentifiedMode& mode, const Spread& spread) {
  const SsiSettings& s = source.settings;
  const int orders = s.largest_order / 2;
  if (mode.intermittent)
    return fmt::format(
        "an intermittent machine: it stops {} times faster than free vibration with its damping ratio of {:.2f} % "
        "decays, and loses {:.0f} % of its energy in these stops",
        mode.stops, 100.0 * mode.damping, 100.0 * mode.stopped);
  if (mode.harmonic)
    return fmt::format("a harmonic: the kurtosis about its frequency is {:.2f} (noise: 3)", mode.kurtosis);
  if (mode.damping > 0.0 && mode.damping < s.least_damping)
    return fmt::format("its damping ratio of {:.3f} % is below {:g} %: a machine, because masonry has more damping",
                       100.0 * mode.damping, 100.0 * s.least_damping);
  if (!(mode.damping > 0.0 && mode.damping < s.largest_damping))
    return fmt::format("its damping ratio is {:.4f}", mode.damping);
  if (mode.hits < s.least_hits * orders)
    return fmt::format("it is stable at only {} of {}", mode.hits, counted(orders, "order"));
  if (mode.mean_phase < s.least_mean_phase)
    return fmt::format("its points do not move in phase: collinearity {:.2f}", mode.mean_phase);
  if (source.segments >= parts && spread.found < least_found * replicates)
    return fmt::format("it is found again without a part of the recording in only {} of {} tries", spread.found,
                       replicates);
  // What noise makes is never as stable as that, and never as sure of its frequency and damping.
  if (mode.hits >= sure_hits * orders) return {};
  if (mode.frequency_std > largest_spread * mode.frequency)
    return fmt::format("it is stable at only {} of {}, and its frequency is uncertain by {:.1f} %", mode.hits,
                       counted(orders, "order"), 100.0 * mode.frequency_std / mode.frequency);
  if (mode.damping_std > sure_damping * mode.damping)
    return fmt::format("it is stable at only {} of {}, and its damping ratio of {:.4f} is uncertain by {:.4f}",
                       mode.hits, counted(orders, "order"), mode.damping, mode.damping_std);
  return {};
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

void sort_out(const ModelSource& source, std::vector<Candidate>& candidates, SsiResult& result) {
  // The better of two that cannot be told apart comes first.
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.mode.hits > b.mode.hits; });
  for (Candidate& candidate : candidates) {
    IdentifiedMode& mode = candidate.mode;
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    mode.shape_std = Eigen::VectorXd::Constant(mode.shape.size(), unknown);
    mode.frequency_std = mode.damping_std = unknown;
    if (candidate.spread.found > 1) candidate.spread.give(mode);
    std::string reason = doubt(source, mode, candidate.spread);
    if (const IdentifiedMode* first = reason.empty() ? original(result.modes, mode) : nullptr)
      reason = fmt::format("it cannot be distinguished from the mode at {:.3f} Hz", first->frequency);
    if (reason.empty())
      result.modes.push_back(mode);
    else
      result.set_aside.push_back({mode, reason});
  }
  std::stable_sort(result.modes.begin(), result.modes.end(),
                   [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  std::stable_sort(result.set_aside.begin(), result.set_aside.end(),
                   [](const auto& a, const auto& b) { return a.mode.frequency < b.mode.frequency; });
}

}  // namespace

void choose_modes(const ModelSource& source, SsiResult& result) {
  const SsiSettings& s = source.settings;
  result.poles = diagram(s, source.models({}));
  const int orders = s.largest_order / 2;
  const int least_members = std::max(2, int(std::ceil(least_seen * s.least_hits * orders)));
  std::vector<Candidate> candidates;
  for (const Cluster& cluster :
       find_clusters(result.poles, s.lowest_frequency, s.largest_damping, s.cluster_radius, least_members)) {
    Candidate candidate;
    candidate.pole = result.poles[std::size_t(cluster.centre)];
    candidate.mode = mode_of(source, candidate.pole, cluster.hits);
    for (const int member : cluster.members) candidate.orders.push_back(result.poles[std::size_t(member)].order);
    candidates.push_back(std::move(candidate));
  }
  jackknife(source, candidates);
  sort_out(source, candidates, result);
}

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

}  // namespace voussoir
