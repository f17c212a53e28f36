// Campaigns with known answers.
#pragma once
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "solver/base/random.h"
#include "tools/campaign/table.h"
#include "tools/fragility/fragility.h"

namespace voussoir::test {

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// ln demand = ln a + b ln im + s N, one record a run at an intensity of its own, spread evenly in its logarithm.
struct Cloud {
  double a = 0.02, b = 1.5, s = 0.5;  // m at im = 1 m/s2
  double lowest = 0.3, highest = 6.0;
  int runs = 100;
  double theta(double threshold) const { return std::pow(threshold / a, 1.0 / b); }
  double beta() const { return s / b; }
};

inline std::vector<CloudRun> draw(const Cloud& c, double threshold, RandomStream& random) {
  std::vector<CloudRun> trials;
  for (int i = 0; i < c.runs; ++i) {
    CloudRun t;
    t.record = std::size_t(i);
    t.im = c.lowest * std::pow(c.highest / c.lowest, random.uniform());
    t.demand = c.a * std::pow(t.im, c.b) * std::exp(c.s * random.normal());
    t.beyond = t.demand >= threshold;
    trials.push_back(t);
  }
  return trials;
}

/// At each of a few intensities each record has its own capacity θ exp(β N), drawn anew: runs are independent.
inline std::vector<CloudRun> draw_stripes(const std::vector<double>& levels, int records, double theta, double beta,
                                          RandomStream& random) {
  std::vector<CloudRun> trials;
  for (double level : levels)
    for (int i = 0; i < records; ++i) {
      CloudRun t;
      t.record = trials.size();
      t.im = level;
      t.demand = level / (theta * std::exp(beta * random.normal()));  // beyond 1
      t.beyond = t.demand >= 1.0;
      trials.push_back(t);
    }
  return trials;
}

inline CampaignRun run_of(const std::string& name, const std::string& case_name, const std::string& record,
                          RunStatus status = RunStatus::done) {
  CampaignRun run;
  run.run = name, run.case_name = case_name, run.record = record;
  run.status = status;
  return run;
}

/// A table of trials with the columns im.pga and edp.x; records r0, r1, …
inline CampaignTable table_of(const std::vector<CloudRun>& trials, const std::string& case_name = "bridge") {
  CampaignTable table;
  table.path = "table.csv";
  table.columns = {{std::string("im.pga"), {}}, {std::string("edp.x"), {}}};
  for (const CloudRun& t : trials) {
    table.runs.push_back(run_of(fmt::format("run-{}", table.runs.size()), case_name, fmt::format("r{}", t.record),
                                t.collapsed ? RunStatus::collapsed : RunStatus::done));
    table.columns[0].values.push_back(t.im);
    table.columns[1].values.push_back(t.demand);
  }
  return table;
}

}  // namespace voussoir::test
