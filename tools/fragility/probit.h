// A lognormal fragility curve from counts: how many of the runs at an intensity go beyond a limit.
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

/// Whether the data say where the curve lies, or why not.
enum class Identified {
  yes,
  no_runs,
  none_beyond,  // the median lies above the largest intensity
  all_beyond,   // the median lies below the smallest
  one_level,    // one intensity alone: a share, but no slope
  separated,    // all below some intensity stay within, all above it go beyond: no slope
  one_mixed,    // the same, but for a level at which some do
  falling,      // the share that goes beyond does not grow with the intensity
  few_demands,  // of a cloud: fewer than five demands to draw a line through
  flat,         // of a cloud: the demand does not grow with the intensity
  collapses     // of a cloud: where the collapses begin is not known
};

struct LognormalFit {
  Identified identified = Identified::no_runs;
  double theta = nan, beta = nan;             // median (unit of the intensity), dispersion (of the logarithm)
  double ln_theta_std = nan, beta_std = nan;  // standard errors, of runs that are independent of each other
  double below = nan, above = nan;            // bounds of the median where it is not identified; NaN: none
  Count mixed;                                // that level
  /// The largest; where there is none, what it grows towards. NaN: falling, no runs, or one level.
  double log_likelihood = nan;
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
};

/// Φ(ln(im/θ)/β) that makes the counts most probable (Baker 2015, eq. 11): probit regression on ln im by Newton's
/// method, whose function is concave. Whether there is a largest likelihood is decided beforehand, from where the two
/// outcomes overlap (Albert & Anderson 1984). Standard errors are those of the observed information.
LognormalFit fit_counts(const std::vector<Count>& counts);

}  // namespace voussoir
