// From the table of a campaign to fragility curves: how probable it is that a bridge goes beyond a limit, over the
// intensity of the ground motion. Theory: docs/theory/fragility.md.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/campaign/table.h"
#include "tools/fragility/cloud.h"

namespace voussoir {

/// The demand of the limit "the bridge falls".
inline constexpr const char* collapse_demand = "collapse";

struct LimitState {
  std::string name;
  std::string demand;      // a column, edp.* or damage.*, or collapse_demand
  double threshold = 0.0;  // in the column's unit, above 0; a run is beyond when it reaches it
  std::string case_name;   // empty: all
};

/// What is wrong with a limit state, as InputError; `where` begins the message.
void check_limit(const CampaignTable& table, const LimitState& limit, const std::string& where);

/// Runs of a case that say something about a limit, and what had to be left out.
struct SelectedRuns {
  std::vector<CloudRun> trials;
  std::vector<std::string> records;  // names
  std::size_t failed = 0, missing = 0, no_im = 0, no_demand = 0;
  std::size_t zero_demands = 0;  // among the trials: they count, but no line goes through them
  std::size_t collapsed = 0, beyond = 0;
};
SelectedRuns select(const CampaignTable& table, const std::string& case_name, const LimitState& limit,
                    const std::string& im);

enum class Method { counts, cloud };

/// A curve by one method, or why there is none.
struct Estimate {
  Method method = Method::counts;
  Identified identified = Identified::no_runs;
  FragilityCurve curve;
  double theta = LognormalFit::nan, beta = LognormalFit::nan;  // of the whole curve: median and dispersion
  double ln_theta_std = LognormalFit::nan, beta_std = LognormalFit::nan;
  double below = LognormalFit::nan, above = LognormalFit::nan;  // bounds of θ where the data do not tell it
  Count mixed;                                                  // of counts that differ at one level alone: that level
};
/// By counts, at the levels where there are any.
Estimate estimate_counts(const std::vector<CloudRun>& trials, const std::vector<double>& levels);
Estimate estimate_cloud(const std::vector<CloudRun>& trials, const std::vector<double>& levels, double threshold);

/// From 5 to 95 % of what resampled records give.
struct CurveBand {
  double low = LognormalFit::nan, high = LognormalFit::nan;
};
struct CurvePoint {
  double im = 0.0, probability = 0.0;
  CurveBand band;
};

struct FragilitySettings {
  int replicates = 1000;  // of the bootstrap; 0: none
  std::uint64_t seed = 1;
};

struct Bootstrap {
  int replicates = 0, unidentified = 0;  // the second are left out of the bands
  CurveBand theta, beta;
};

struct Fragility {
  std::string case_name, im;
  LimitState limit;
  SelectedRuns selection;
  std::vector<double> levels;  // of the intensity, where runs share them; empty: a cloud
  std::vector<Count> counts;   // at the levels, or a run each
  Estimate chosen, other;      // other: by the other method, for comparison; of a collapse there is none (no_runs)
  CloudFit cloud;              // the line behind the cloud's estimate
  Bootstrap bootstrap;
  std::vector<CurvePoint> curve;  // empty where the chosen estimate is not identified
};

/// Counts are preferred where runs share levels of the intensity, else the cloud; the other one where that is not
/// identified. Replicates draw as many records as there are, with all their runs, and go through the same method.
Fragility assess(const CampaignTable& table, const std::string& case_name, const LimitState& limit,
                 const std::string& im, const FragilitySettings& settings = {});

}  // namespace voussoir
