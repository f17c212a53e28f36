// Fragility from the sizes of demands: a straight line through their logarithms, with the share that collapses apart.
#pragma once
#include <vector>

#include "tools/fragility/probit.h"
#include "tools/fragility/statistics.h"

namespace voussoir {

/// Probability of going beyond a limit: 1 − (1 − Φ(ln(im/θ)/β)) (1 − Φ(ln(im/θ_C)/β_C)). The second factor is for what
/// collapsed and is 1 where that has no θ_C (NaN).
struct FragilityCurve {
  double theta = LognormalFit::nan, beta = LognormalFit::nan;
  double collapse_theta = LognormalFit::nan, collapse_beta = LognormalFit::nan;

  double at(double im) const;
  /// The intensity at which the probability is this (0 < p < 1), to 1e-12 of itself.
  double reaching(double probability) const;
  double median() const { return reaching(0.5); }
  /// Half the logarithm of what lies between 16 and 84 %: β itself where nothing collapsed.
  double dispersion() const;
};

/// A run as a fit sees it.
struct CloudRun {
  std::size_t record = 0;  // of the records of the selection
  double im = 0.0;         // above 0
  double demand = 0.0;     // its size, 0 or more; NaN where it collapsed
  bool collapsed = false, beyond = false;
};

constexpr std::size_t least_demands = 5;  // to draw a line through

struct CloudFit {
  Identified identified = Identified::no_runs;
  FragilityCurve curve;
  double ln_theta_std = LognormalFit::nan, beta_std = LognormalFit::nan;  // NaN with collapses: see the bands
  Line line;                               // ln demand over ln im, of the runs that stand
  double curvature_p = LognormalFit::nan;  // that (ln im)² adds nothing to the line
  LognormalFit collapse;                   // of the share that collapses
};

/// ln demand = a + b ln im with normal scatter s, the same everywhere (Cornell et al. 2002): θ = exp((ln c − a)/b) and
/// β = s/b for the threshold c. Runs that collapsed have no demand; the probability of that is a probit of its own, and
/// the two make up the whole (total probability: Jalayer et al. 2017, who take a logistic one). Where all that collapse
/// lie above all that stand it is a step half-way between, in logarithms. `levels` (from levels_of(), may be empty) are
/// for its counts. `threshold` above 0.
CloudFit fit_cloud(const std::vector<CloudRun>& trials, const std::vector<double>& levels, double threshold);

/// A count a run, or a count a level where `levels` are given (from levels_of()).
std::vector<Count> counts_of(const std::vector<CloudRun>& trials, const std::vector<double>& levels);

/// The few intensities that the runs share: at least four in five of them are at a level with two others, to 0.1 %, and
/// there are at most forty levels. Empty where there are none: a cloud. `im` may hold anything above 0.
std::vector<double> levels_of(const std::vector<double>& im);

}  // namespace voussoir
