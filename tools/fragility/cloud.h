// Fragility from the sizes of demands (cloud method): a straight line through their logarithms, and the share of
// collapses separately.
#pragma once
#include <vector>

#include "tools/fragility/probit.h"
#include "tools/fragility/statistics.h"

namespace voussoir {

/// Probability of exceeding a limit: 1 − (1 − Φ(ln(im/θ)/β)) (1 − Φ(ln(im/θ_C)/β_C)). The second factor describes
/// collapses. It is 1 if θ_C is not known (NaN).
struct FragilityCurve {
  double theta = LognormalFit::nan, beta = LognormalFit::nan;
  double collapse_theta = LognormalFit::nan, collapse_beta = LognormalFit::nan;

  double at(double im) const;
  /// The intensity with the probability p (0 < p < 1), to a relative error of 1e-12.
  double reaching(double probability) const;
  double median() const { return reaching(0.5); }
  /// Half the logarithm of the ratio of the 84 % and 16 % intensities. It equals β if there are no collapses.
  double dispersion() const;
};

/// A run as input of a fit.
struct CloudRun {
  std::size_t record = 0;  // index into the records of the selection
  double im = 0.0;         // above 0
  double demand = 0.0;     // 0 or more; NaN if the run collapsed
  bool collapsed = false, beyond = false;
};

constexpr std::size_t least_demands = 5;  // for a line

struct CloudFit {
  Identified identified = Identified::no_runs;
  FragilityCurve curve;
  double ln_theta_std = LognormalFit::nan, beta_std = LognormalFit::nan;  // NaN with collapses: use the bands
  Line line;                               // ln demand against ln im, of the runs without collapse
  double curvature_p = LognormalFit::nan;  // p-value of the hypothesis that (ln im)² does not improve the line
  LognormalFit collapse;                   // fit of the share of collapses
};

/// Fits ln demand = a + b ln im with a constant normal scatter s (Cornell et al. 2002): θ = exp((ln c − a)/b) and β =
/// s/b for the threshold c. Runs with collapse have no demand. The probability of collapse is a separate probit curve,
/// and both are combined by total probability (Jalayer et al. 2017, who use a logistic curve). If all runs with
/// collapse have higher intensities than all others, this curve is a step half-way between them, in logarithms.
/// `levels` (from levels_of(), may be empty) are for its counts. `threshold` is above 0.
CloudFit fit_cloud(const std::vector<CloudRun>& trials, const std::vector<double>& levels, double threshold);

/// One count for each run, or one for each level if `levels` are given (from levels_of()).
std::vector<Count> counts_of(const std::vector<CloudRun>& trials, const std::vector<double>& levels);

/// The few intensities that runs share: at least four in five runs are at a level with two others, to 0.1 %, and there
/// are at most forty levels. Empty if there are none (a cloud). All values of `im` are above 0.
std::vector<double> levels_of(const std::vector<double>& im);

}  // namespace voussoir
