#include "tools/fragility/ranking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "solver/base/csv.h"
#include "solver/base/error.h"
#include "tools/fragility/bootstrap.h"
#include "tools/fragility/fragility.h"

namespace voussoir {

namespace {

/// Characteristics of a ground motion other than its intensity.
constexpr std::array<const char*, 4> characteristics = {"im.d595", "im.d575", "im.magnitude", "im.distance"};

bool is_characteristic(const std::string& name) {
  return std::find(characteristics.begin(), characteristics.end(), name) != characteristics.end();
}

/// Logarithms of a column at these runs, or plain numbers where they are not all above 0; empty where some are missing.
std::vector<double> scaled_values(const std::vector<double>& column, const std::vector<std::size_t>& rows,
                                  bool logarithms) {
  std::vector<double> values;
  for (std::size_t i : rows) values.push_back(column[i]);
  if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); })) return {};
  if (logarithms && std::all_of(values.begin(), values.end(), [](double v) { return v > 0.0; }))
    for (double& v : values) v = std::log(v);
  return values;
}

/// The runs of the case without collapse that have both numbers above 0.
std::vector<std::size_t> rows_with(const CampaignTable& table, const std::string& case_name,
                                   const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < table.runs.size(); ++i)
    if (table.runs[i].status == RunStatus::done && table.runs[i].case_name == case_name && x[i] > 0.0 &&
        std::abs(y[i]) > 0.0)
      rows.push_back(i);
  return rows;
}

MeasurePair pairing_of(const CampaignTable& table, const std::string& case_name, const std::string& im,
                       const std::string& demand) {
  MeasurePair p;
  p.im = im, p.demand = demand;
  p.complete = coverage(table, {case_name}, im).complete();
  std::vector<double> size = table.column(demand).values;
  for (double& v : size) v = std::abs(v);
  const std::vector<std::size_t> rows = rows_with(table, case_name, table.column(im).values, size);
  const std::vector<double> x = scaled_values(table.column(im).values, rows, true), y = scaled_values(size, rows, true);
  p.line = fit_line(x, y);
  const auto test = [&](const std::string& name, const std::vector<double>& column) {
    const std::vector<double> z = scaled_values(column, rows, name != "im.magnitude");
    if (z.size() != rows.size()) return;
    if (const double value = added_p_value(x, y, z); !std::isnan(value)) p.sufficiency.push_back({name, value});
  };
  std::vector<double> scales;
  for (const CampaignRun& run : table.runs) scales.push_back(run.scale);
  test("scale", scales);
  for (const char* name : characteristics)
    if (const NumberColumn* column = table.find(name)) test(name, column->values);
  return p;
}

/// ln L of the counts, summed over the cases. −∞ if in one case the counts fall with the intensity, or if runs are
/// missing that another intensity has.
double plausibility(const CampaignTable& table, const std::vector<std::string>& cases, const LimitState& limit,
                    const std::string& im, std::size_t most_runs) {
  double sum = 0.0;
  std::size_t runs = 0;
  for (const std::string& name : cases) {
    const SelectedRuns s = select(table, name, limit, im);
    std::vector<double> im_of;
    for (const CloudRun& t : s.trials) im_of.push_back(t.im);
    const LognormalFit fit = fit_counts(counts_of(s.trials, levels_of(im_of)));
    runs += s.trials.size();
    if (std::isnan(fit.log_likelihood)) return -INFINITY;
    sum += fit.log_likelihood;
  }
  return runs == most_runs ? sum : -INFINITY;
}

std::string most_plausible(const CampaignTable& table, const std::vector<std::string>& cases, const LimitState& limit,
                           const std::vector<std::string>& candidates) {
  std::size_t most_runs = 0;
  for (const std::string& im : candidates) {
    std::size_t runs = 0;
    for (const std::string& name : cases) runs += select(table, name, limit, im).trials.size();
    most_runs = std::max(most_runs, runs);
  }
  std::string best = candidates.front();
  double highest = -INFINITY;
  for (const std::string& im : candidates)
    if (const double value = plausibility(table, cases, limit, im, most_runs); value > highest)
      best = im, highest = value;
  return best;
}

/// Runs with a damage and all demands, so that all demands are compared over the same runs.
struct Compared {
  std::vector<std::size_t> rows;
  Clusters clusters;
};

Compared compared(const CampaignTable& table, const std::string& case_name,
                  const std::vector<const std::vector<double>*>& columns) {
  Compared c;
  std::vector<std::string> records;
  std::vector<std::size_t> record_of;
  for (std::size_t i = 0; i < table.runs.size(); ++i) {
    const CampaignRun& run = table.runs[i];
    if (!has_result(run) || run.case_name != case_name) continue;
    if (std::any_of(columns.begin(), columns.end(), [&](const auto* v) { return std::isnan((*v)[i]); })) continue;
    const std::string& name = run.record.empty() ? run.run : run.record;
    auto at = std::find(records.begin(), records.end(), name);
    if (at == records.end()) at = records.insert(records.end(), name);
    record_of.push_back(std::size_t(at - records.begin()));
    c.rows.push_back(i);
  }
  c.clusters = clusters_of(record_of);
  return c;
}

double correlation_at(const std::vector<double>& x, const std::vector<double>& y,
                      const std::vector<std::size_t>& rows) {
  std::vector<double> a, b;
  for (std::size_t i : rows) a.push_back(std::abs(x[i])), b.push_back(y[i]);
  return rank_correlation(a, b);
}

/// Share of resamples in which the first demand remains ahead of the second.
double share_ahead(const Compared& c, const std::vector<double>& first, const std::vector<double>& second,
                   const std::vector<double>& damage, int replicates, std::uint64_t seed) {
  RandomStream random(seed);
  int ahead = 0, known = 0;
  for (int i = 0; i < replicates && c.clusters.size() > 1; ++i) {
    std::vector<std::size_t> rows;
    for (std::size_t place : resampled(c.clusters, random)) rows.push_back(c.rows[place]);
    const double one = correlation_at(first, damage, rows), two = correlation_at(second, damage, rows);
    if (std::isnan(one) || std::isnan(two)) continue;
    ++known;
    ahead += one > two;
  }
  return known > 0 ? double(ahead) / double(known) : no_number;
}

DamageRanking damage_ranking(const CampaignTable& table, const std::string& case_name, const std::string& damage,
                             const std::vector<std::string>& demands, int replicates, std::uint64_t seed) {
  DamageRanking r;
  r.damage = damage;
  r.ahead = no_number;
  const std::vector<double>& values = table.column(damage).values;
  std::vector<const std::vector<double>*> columns = {&values};
  for (const std::string& demand : demands) columns.push_back(&table.column(demand).values);
  const Compared c = compared(table, case_name, columns);
  if (c.rows.size() < 3) return r;
  for (const std::string& demand : demands) {
    const double rho = correlation_at(table.column(demand).values, values, c.rows);
    if (!std::isnan(rho)) r.demands.push_back({damage, demand, c.rows.size(), rho});
  }
  std::stable_sort(r.demands.begin(), r.demands.end(),
                   [](const auto& a, const auto& b) { return a.correlation > b.correlation; });
  if (r.demands.size() > 1)
    r.ahead = share_ahead(c, table.column(r.demands[0].demand).values, table.column(r.demands[1].demand).values, values,
                          replicates, seed);
  return r;
}

}  // namespace

double MeasurePair::proficiency() const {
  return line.known() && line.slope > 0.0 ? line.scatter / line.slope : INFINITY;
}

double MeasurePair::least_p() const {
  double least = no_number;
  for (const Sufficiency& s : sufficiency)
    if (!(s.p >= least)) least = s.p;
  return least;
}

Coverage coverage(const CampaignTable& table, const std::vector<std::string>& cases, const std::string& im) {
  const std::vector<double>& values = table.column(im).values;
  Coverage c;
  for (std::size_t i = 0; i < table.runs.size(); ++i) {
    if (!has_result(table.runs[i]) || std::ranges::find(cases, table.runs[i].case_name) == cases.end()) continue;
    ++c.runs;
    c.with += values[i] > 0.0;
  }
  return c;
}

std::vector<std::string> main_demands(const CampaignTable& table) {
  std::vector<std::string> found;
  for (const std::string& name : table.names("edp."))
    if (name.find('.', 4) == std::string::npos) found.push_back(name);
  return found;
}

std::vector<std::string> intensities(const CampaignTable& table) {
  std::vector<std::string> found = table.names("im.");
  std::erase_if(found, is_characteristic);
  return found;
}

std::vector<MeasurePair> rank_intensities(const CampaignTable& table, const std::string& case_name,
                                          const std::string& demand) {
  std::vector<MeasurePair> pairings;
  for (const std::string& im : intensities(table)) {
    MeasurePair p = pairing_of(table, case_name, im, demand);
    if (p.line.known() && p.line.count >= least_demands) pairings.push_back(std::move(p));
  }
  std::ranges::stable_sort(pairings, {}, [](const MeasurePair& p) { return std::pair(!p.complete, p.proficiency()); });
  return pairings;
}

std::string best_intensity(const CampaignTable& table, const std::vector<std::string>& cases, const std::string& demand,
                           double threshold) {
  std::vector<std::string> candidates = intensities(table);
  if (candidates.empty())
    throw InputError("{}: there is no intensity measure. The table needs columns such as im.pga or im.sa_0.30",
                     table.path);
  const auto complete = [&](const std::string& im) { return coverage(table, cases, im).complete(); };
  if (std::ranges::any_of(candidates, complete)) std::erase_if(candidates, std::not_fn(complete));
  std::string best;
  double least = INFINITY;
  for (const std::string& im : candidates) {
    double sum = 0.0;
    for (const std::string& name : cases) {
      if (demand == collapse_demand) break;
      const MeasurePair p = pairing_of(table, name, im, demand);
      sum += p.line.count >= least_demands ? std::log(p.proficiency()) : INFINITY;
    }
    if (demand != collapse_demand && sum < least) best = im, least = sum;
  }
  if (!best.empty()) return best;
  return most_plausible(table, cases, {"", demand, threshold, ""}, candidates);
}

std::vector<DamageRanking> rank_demands(const CampaignTable& table, const std::string& case_name, int replicates,
                                        std::uint64_t seed) {
  std::vector<DamageRanking> rankings;
  for (const std::string& damage : table.names("damage.")) {
    if (!damage.ends_with(".broken_share")) continue;
    DamageRanking r = damage_ranking(table, case_name, damage, main_demands(table), replicates, seed);
    if (!r.demands.empty()) rankings.push_back(std::move(r));
  }
  return rankings;
}

}  // namespace voussoir
