// A lognormal fragility curve from counts: the number of runs at an intensity that exceed a limit.
#pragma once
#include <limits>
#include <string>
#include <vector>

namespace voussoir {

/// Runs at one intensity.
struct Count {
  double im = 0.0;  // above 0, in its own unit
  double runs = 0.0, beyond = 0.0;
};

/// Whether the data determine the curve, and otherwise the reason.
enum class Identified {
  yes,
  no_runs,
  none_beyond,  // the median lies above the largest intensity
  all_beyond,   // the median lies below the smallest
  one_level,    // one intensity only: a share, but no slope
  separated,    // no run below some intensity and all above it exceed the limit: no slope
  one_mixed,    // the same, except for one level at which some runs exceed the limit and others do not
  falling,      // the share that exceeds the limit does not increase with the intensity
  few_demands,  // of a cloud: fewer than five demands for a line
  flat,         // of a cloud: the demand does not increase with the intensity
  collapses     // of a cloud: the beginning of collapses is not known
};

struct LognormalFit {
  Identified identified = Identified::no_runs;
  double theta = nan, beta = nan;             // median (unit of the intensity), dispersion (of the logarithm)
  double ln_theta_std = nan, beta_std = nan;  // standard errors for independent runs
  double below = nan, above = nan;            // bounds of the median where it is not identified; NaN: none
  Count mixed;                                // the level of Identified::one_mixed
  /// The largest log-likelihood. If there is no maximum: the value that it approaches. NaN for falling, no_runs and
  /// one_level.
  double log_likelihood = nan;
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
};

/// The curve Φ(ln(im/θ)/β) with the largest likelihood of the counts (Baker 2015, eq. 11): probit regression on ln im
/// by Newton's method; the log-likelihood is concave. Whether a maximum exists is decided beforehand from the overlap
/// of the two outcomes (Albert & Anderson 1984). Standard errors follow from the observed information.
LognormalFit fit_counts(const std::vector<Count>& counts);

}  // namespace voussoir
