#include "tools/fragility/fragility.h"

#include <algorithm>
#include <cmath>

#include "solver/base/error.h"
#include "solver/base/suggestion.h"
#include "tools/fragility/bootstrap.h"

namespace voussoir {

namespace {

constexpr std::size_t curve_points = 81;
constexpr double farthest_beyond = 3.0;  // the curve is drawn so far beyond the intensities of the runs, as a factor

/// The number of a record among the records so far. Each run without a record counts as its own record.
std::size_t record_number(SelectedRuns& s, const CampaignRun& run) {
  const std::string& name = run.record.empty() ? run.run : run.record;
  const auto at = std::find(s.records.begin(), s.records.end(), name);
  if (at == s.records.end()) s.records.push_back(name);
  return std::size_t(std::find(s.records.begin(), s.records.end(), name) - s.records.begin());
}

Estimate estimate(Method method, const std::vector<CloudRun>& trials, const std::vector<double>& levels,
                  double threshold) {
  return method == Method::counts ? estimate_counts(trials, levels) : estimate_cloud(trials, levels, threshold);
}

void choose(Fragility& f) {
  const Estimate counts = estimate_counts(f.selection.trials, f.levels);
  if (f.limit.demand == collapse_demand) {  // collapse has no size
    f.chosen = counts;
    return;
  }
  f.cloud = fit_cloud(f.selection.trials, f.levels, f.limit.threshold);
  const Estimate cloud = estimate_cloud(f.selection.trials, f.levels, f.limit.threshold);
  const bool other_way = !f.levels.empty() ? counts.identified != Identified::yes && cloud.identified == Identified::yes
                                           : cloud.identified == Identified::yes;
  f.chosen = other_way ? cloud : counts;
  f.other = other_way ? counts : cloud;
}

/// Intensities evenly spaced in the logarithm, over the runs and the rise of the curve, but not far beyond the runs.
std::vector<CurvePoint> empty_curve(const Fragility& f) {
  double low = INFINITY, high = 0.0;
  for (const CloudRun& t : f.selection.trials) low = std::min(low, t.im), high = std::max(high, t.im);
  const double rise = std::exp(2.5 * f.chosen.beta);
  const double first = std::clamp(f.chosen.theta / rise, low / farthest_beyond, low);
  const double last = std::clamp(f.chosen.theta * rise, high, high * farthest_beyond);
  std::vector<CurvePoint> points;
  for (std::size_t i = 0; i < curve_points; ++i) {
    CurvePoint p;
    p.im = first * std::pow(last / first, double(i) / double(curve_points - 1));
    p.probability = f.chosen.curve.at(p.im);
    points.push_back(p);
  }
  return points;
}

/// The range from 5 to 95 %: percentiles that correct the bias of the estimate (Efron 1981: by its rank among the
/// replicates) and the small number of records (Hesterberg 2015: Student's t, and n for n − 1).
CurveBand band_of(std::vector<double>& values, double estimate, std::size_t records) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto [first, last] = std::equal_range(values.begin(), values.end(), estimate);
  const double below = double(first - values.begin()) + 0.5 * double(last - first), count = double(values.size());
  const double off = normal_quantile(std::clamp(below / count, 0.5 / count, 1.0 - 0.5 / count));
  const double n = double(records), reach = std::sqrt(n / (n - 1.0)) * t_quantile(0.95, n - 1.0);
  return {quantile(values, normal_cdf(2.0 * off - reach)), quantile(values, normal_cdf(2.0 * off + reach))};
}

void run_bootstrap(Fragility& f, const FragilitySettings& settings) {
  const std::vector<CloudRun>& trials = f.selection.trials;
  std::vector<std::size_t> record_of;
  for (const CloudRun& t : trials) record_of.push_back(t.record);
  const Clusters clusters = clusters_of(record_of);
  if (clusters.size() < 2) return;
  RandomStream random(settings.seed);
  std::vector<double> theta, beta;
  std::vector<std::vector<double>> at(f.curve.size());
  std::vector<CloudRun> drawn;
  for (int i = 0; i < settings.replicates; ++i) {
    drawn.clear();
    for (std::size_t place : resampled(clusters, random)) drawn.push_back(trials[place]);
    const Estimate e = estimate(f.chosen.method, drawn, f.levels, f.limit.threshold);
    ++f.bootstrap.replicates;
    if (e.identified != Identified::yes) {
      ++f.bootstrap.unidentified;
      continue;
    }
    theta.push_back(e.theta), beta.push_back(e.beta);
    for (std::size_t k = 0; k < at.size(); ++k) at[k].push_back(e.curve.at(f.curve[k].im));
  }
  f.bootstrap.theta = band_of(theta, f.chosen.theta, clusters.size());
  f.bootstrap.beta = band_of(beta, f.chosen.beta, clusters.size());
  for (std::size_t k = 0; k < at.size(); ++k) f.curve[k].band = band_of(at[k], f.curve[k].probability, clusters.size());
}

}  // namespace

void check_limit(const CampaignTable& table, const LimitState& limit, const std::string& where) {
  if (limit.name.empty()) throw InputError("{}: a limit state has no name", where);
  const auto cases = table.cases();
  if (!limit.case_name.empty() && std::find(cases.begin(), cases.end(), limit.case_name) == cases.end())
    throw InputError("{}: limit state '{}' is for case '{}', of which {} has no runs{}", where, limit.name,
                     limit.case_name, table.path, suggestion(limit.case_name, cases));
  if (limit.demand == collapse_demand) return;
  if (!limit.demand.starts_with("edp.") && !limit.demand.starts_with("damage."))
    throw InputError("{}: the demand of limit state '{}' is '{}'. It must be a column edp.NAME or damage.NAME, or '{}'",
                     where, limit.name, limit.demand, collapse_demand);
  try {
    table.column(limit.demand);
  } catch (const InputError& error) {
    throw InputError("{}: limit state '{}': {}", where, limit.name, error.what());
  }
  if (!(limit.threshold > 0.0) || !std::isfinite(limit.threshold))
    throw InputError("{}: the threshold of limit state '{}' is {}. It must be above 0", where, limit.name,
                     limit.threshold);
}

SelectedRuns select(const CampaignTable& table, const std::string& case_name, const LimitState& limit,
                    const std::string& im) {
  SelectedRuns s;
  const std::vector<double>& intensity = table.column(im).values;
  const NumberColumn* demand = limit.demand == collapse_demand ? nullptr : &table.column(limit.demand);
  for (std::size_t i = 0; i < table.runs.size(); ++i) {
    const CampaignRun& run = table.runs[i];
    if (run.case_name != case_name) continue;
    CloudRun t;
    t.im = intensity[i];
    t.collapsed = run.status == RunStatus::collapsed;
    // A signed demand (such as the position of a keystone) counts by its magnitude. A collapse exceeds all magnitudes.
    t.demand = t.collapsed || !demand ? LognormalFit::nan : std::abs(demand->values[i]);
    t.beyond = t.collapsed || t.demand >= limit.threshold;
    if (run.status == RunStatus::failed)
      ++s.failed;
    else if (run.status == RunStatus::missing)
      ++s.missing;
    else if (!(t.im > 0.0))
      ++s.no_im;
    else if (demand && !t.collapsed && std::isnan(t.demand))
      ++s.no_demand;
    else {
      t.record = record_number(s, run);
      s.zero_demands += t.demand == 0.0, s.collapsed += t.collapsed, s.beyond += t.beyond;
      s.trials.push_back(t);
    }
  }
  return s;
}

Estimate estimate_counts(const std::vector<CloudRun>& trials, const std::vector<double>& levels) {
  const LognormalFit fit = fit_counts(counts_of(trials, levels));
  Estimate e;
  e.method = Method::counts;
  e.identified = fit.identified;
  e.below = fit.below, e.above = fit.above, e.mixed = fit.mixed;
  if (fit.identified != Identified::yes) return e;
  e.curve.theta = e.theta = fit.theta;
  e.curve.beta = e.beta = fit.beta;
  e.ln_theta_std = fit.ln_theta_std, e.beta_std = fit.beta_std;
  return e;
}

Estimate estimate_cloud(const std::vector<CloudRun>& trials, const std::vector<double>& levels, double threshold) {
  const CloudFit fit = fit_cloud(trials, levels, threshold);
  Estimate e;
  e.method = Method::cloud;
  e.identified = fit.identified;
  if (fit.identified != Identified::yes) return e;
  e.curve = fit.curve;
  e.theta = fit.curve.median(), e.beta = fit.curve.dispersion();
  e.ln_theta_std = fit.ln_theta_std, e.beta_std = fit.beta_std;
  return e;
}

Fragility assess(const CampaignTable& table, const std::string& case_name, const LimitState& limit,
                 const std::string& im, const FragilitySettings& settings) {
  Fragility f;
  f.case_name = case_name;
  f.im = im;
  f.limit = limit;
  f.selection = select(table, case_name, limit, im);
  std::vector<double> intensities;
  for (const CloudRun& t : f.selection.trials) intensities.push_back(t.im);
  f.levels = levels_of(intensities);
  f.counts = counts_of(f.selection.trials, f.levels);
  choose(f);
  if (f.chosen.identified != Identified::yes) return f;
  f.curve = empty_curve(f);
  run_bootstrap(f, settings);
  return f;
}

}  // namespace voussoir
