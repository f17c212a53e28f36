// Fragility curves from the table of a campaign: the probability that a bridge exceeds a limit, against the intensity
// of the ground motion. Theory: docs/theory/fragility.md.
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
  double threshold = 0.0;  // in the unit of the column, above 0; a run exceeds the limit if it reaches the threshold
  std::string case_name;   // empty: all
};

/// Checks a limit state. Throws InputError whose message begins with `where`.
void check_limit(const CampaignTable& table, const LimitState& limit, const std::string& where);

/// The runs of a case that are used for a limit, and the number of runs left out by reason.
struct SelectedRuns {
  std::vector<CloudRun> trials;
  std::vector<std::string> records;  // names
  std::size_t failed = 0, missing = 0, no_im = 0, no_demand = 0;
  std::size_t zero_demands = 0;  // among the trials: they are counted, but the line does not use them
  std::size_t collapsed = 0, beyond = 0;
};
SelectedRuns select(const CampaignTable& table, const std::string& case_name, const LimitState& limit,
                    const std::string& im);

enum class Method { counts, cloud };

/// A curve by one method, or the reason why there is none.
struct Estimate {
  Method method = Method::counts;
  Identified identified = Identified::no_runs;
  FragilityCurve curve;
  double theta = LognormalFit::nan, beta = LognormalFit::nan;  // of the whole curve: median and dispersion
  double ln_theta_std = LognormalFit::nan, beta_std = LognormalFit::nan;
  double below = LognormalFit::nan, above = LognormalFit::nan;  // bounds of θ if the data do not determine it
  Count mixed;                                                  // counts that differ at one level only: that level
};
/// The estimate from counts, at the levels if there are any.
Estimate estimate_counts(const std::vector<CloudRun>& trials, const std::vector<double>& levels);
Estimate estimate_cloud(const std::vector<CloudRun>& trials, const std::vector<double>& levels, double threshold);

/// The range from 5 to 95 % over resampled records.
struct CurveBand {
  double low = LognormalFit::nan, high = LognormalFit::nan;
};
struct CurvePoint {
  double im = 0.0, probability = 0.0;
  CurveBand band;
};

struct FragilitySettings {
  int replicates = 1000;  // replicates of the bootstrap; 0: none
  std::uint64_t seed = 1;
};

struct Bootstrap {
  int replicates = 0, unidentified = 0;  // `unidentified` replicates are not part of the bands
  CurveBand theta, beta;
};

struct Fragility {
  std::string case_name, im;
  LimitState limit;
  SelectedRuns selection;
  std::vector<double> levels;  // levels of the intensity that runs share; empty: a cloud
  std::vector<Count> counts;   // at the levels, or one for each run
  Estimate chosen, other;      // `other` is by the other method, for comparison; a collapse limit has none (no_runs)
  CloudFit cloud;              // the line behind the estimate from the cloud
  Bootstrap bootstrap;
  std::vector<CurvePoint> curve;  // empty if the chosen estimate is not identified
};

/// Estimates the curve. The method is counts if runs share levels of the intensity, otherwise the cloud; if it does
/// not identify a curve, the other method is used. Each replicate draws as many records as there are, with all their
/// runs, and uses the same method.
Fragility assess(const CampaignTable& table, const std::string& case_name, const LimitState& limit,
                 const std::string& im, const FragilitySettings& settings = {});

}  // namespace voussoir
