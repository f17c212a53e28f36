#include "tools/fragility/cloud.h"

#include <algorithm>
#include <cmath>

namespace voussoir {

namespace {

constexpr double same_level = 1e-3;  // of the intensity: records are scaled, and tables rounded, better than that
constexpr std::size_t most_levels = 40, least_at_level = 3;

/// Φ(ln(im/θ)/β), a step where there is no scatter.
double lognormal(double im, double theta, double beta) {
  if (beta > 0.0) return normal_cdf(std::log(im / theta) / beta);
  return im < theta ? 0.0 : 1.0;
}

LognormalFit collapse_fit(std::vector<CloudRun> trials, const std::vector<double>& levels) {
  for (CloudRun& t : trials) t.beyond = t.collapsed;
  LognormalFit fit = fit_counts(counts_of(trials, levels));
  // The likelihood then grows towards a step anywhere between.
  if (fit.identified == Identified::separated) fit.theta = std::sqrt(fit.below * fit.above), fit.beta = 0.0;
  return fit;
}

/// Standard errors of θ and β to first order: mean, slope and scatter of a line are independent of each other.
void set_errors(CloudFit& fit) {
  const Line& l = fit.line;
  const double n = double(l.count), off = std::log(fit.curve.theta) - l.mean_x;
  const double relative = l.slope_std / l.slope;
  fit.ln_theta_std = std::sqrt(l.scatter * l.scatter / n / (l.slope * l.slope) + off * off * relative * relative);
  fit.beta_std = fit.curve.beta * std::sqrt(0.5 / (n - 2.0) + relative * relative);
}

}  // namespace

double FragilityCurve::at(double im) const {
  const double stands = 1.0 - lognormal(im, theta, beta);
  return std::isnan(collapse_theta) ? 1.0 - stands
                                    : 1.0 - stands * (1.0 - lognormal(im, collapse_theta, collapse_beta));
}

double FragilityCurve::reaching(double probability) const {
  double low = std::log(theta) - 40.0 * beta, high = std::log(theta) + 40.0 * beta;  // ln im
  if (!std::isnan(collapse_theta)) low = std::min(low, std::log(collapse_theta) - 40.0 * collapse_beta);
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (at(std::exp(middle)) < probability ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

double FragilityCurve::dispersion() const {
  if (std::isnan(collapse_theta)) return beta;
  return 0.5 * std::log(reaching(normal_cdf(1.0)) / reaching(normal_cdf(-1.0)));
}

CloudFit fit_cloud(const std::vector<CloudRun>& trials, const std::vector<double>& levels, double threshold) {
  CloudFit fit;
  std::vector<double> x, y, xx;
  for (const CloudRun& t : trials)
    if (!t.collapsed && t.demand > 0.0) x.push_back(std::log(t.im)), y.push_back(std::log(t.demand));
  fit.line = fit_line(x, y);
  fit.collapse = collapse_fit(trials, levels);
  const bool any_collapsed = std::any_of(trials.begin(), trials.end(), [](const CloudRun& t) { return t.collapsed; });
  if (x.size() < least_demands)
    fit.identified = Identified::few_demands;
  else if (!fit.line.known())
    fit.identified = Identified::one_level;
  else if (!(fit.line.slope > 0.0))
    fit.identified = Identified::flat;
  else if (any_collapsed && std::isnan(fit.collapse.theta))
    fit.identified = Identified::collapses;
  else
    fit.identified = Identified::yes;
  if (fit.identified != Identified::yes) return fit;
  for (double v : x) xx.push_back((v - fit.line.mean_x) * (v - fit.line.mean_x));
  fit.curvature_p = added_p_value(x, y, xx);
  fit.curve.theta = std::exp((std::log(threshold) - fit.line.intercept) / fit.line.slope);
  fit.curve.beta = fit.line.scatter / fit.line.slope;
  if (any_collapsed) {
    fit.curve.collapse_theta = fit.collapse.theta;
    fit.curve.collapse_beta = fit.collapse.beta;
  } else {
    set_errors(fit);
  }
  return fit;
}

std::vector<double> levels_of(const std::vector<double>& im) {
  std::vector<double> sorted = im;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> levels;
  std::size_t at_levels = 0;
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i;
    double sum = 0.0;
    while (end < sorted.size() && sorted[end] <= sorted[i] * (1.0 + same_level)) sum += std::log(sorted[end++]);
    if (end - i >= least_at_level) at_levels += end - i;
    levels.push_back(std::exp(sum / double(end - i)));
    i = end;
  }
  if (levels.size() > most_levels || 5 * at_levels < 4 * sorted.size()) levels.clear();
  return levels;
}

std::vector<Count> counts_of(const std::vector<CloudRun>& trials, const std::vector<double>& levels) {
  std::vector<Count> counts;
  for (double level : levels) counts.push_back({level, 0.0, 0.0});
  for (const CloudRun& t : trials) {
    if (levels.empty()) {
      counts.push_back({t.im, 1.0, t.beyond ? 1.0 : 0.0});
      continue;
    }
    const auto nearest = std::min_element(counts.begin(), counts.end(), [&](const Count& a, const Count& b) {
      return std::abs(std::log(a.im / t.im)) < std::abs(std::log(b.im / t.im));
    });
    nearest->runs += 1.0;
    nearest->beyond += t.beyond ? 1.0 : 0.0;
  }
  std::erase_if(counts, [](const Count& c) { return c.runs == 0.0; });
  return counts;
}

}  // namespace voussoir
