#include "tools/fragility/probit.h"

#include <algorithm>
#include <cmath>

#include "tools/fragility/statistics.h"

namespace voussoir {

namespace {

/// Range of ln im of each outcome.
struct Ranges {
  double within_low = INFINITY, within_high = -INFINITY, beyond_low = INFINITY, beyond_high = -INFINITY;
};

Ranges ranges_of(const std::vector<Count>& counts) {
  Ranges r;
  for (const Count& c : counts) {
    const double x = std::log(c.im);
    if (c.beyond > 0.0) r.beyond_low = std::min(r.beyond_low, x), r.beyond_high = std::max(r.beyond_high, x);
    if (c.beyond < c.runs) r.within_low = std::min(r.within_low, x), r.within_high = std::max(r.within_high, x);
  }
  return r;
}

/// All runs are on their side of one intensity x, except those at x. If fewer than half of the runs at x exceed the
/// limit, the median is above x and below the next intensity; otherwise below x and above the previous one.
void bound_by_one_level(const std::vector<Count>& counts, double x, LognormalFit& fit) {
  double next = INFINITY, last = -INFINITY;
  fit.identified = Identified::one_mixed;
  fit.mixed.im = std::exp(x);
  for (const Count& c : counts) {
    const double here = std::log(c.im);
    if (here == x) fit.mixed.runs += c.runs, fit.mixed.beyond += c.beyond;
    if (here > x) next = std::min(next, here);
    if (here < x) last = std::max(last, here);
  }
  const double share = fit.mixed.beyond / fit.mixed.runs;
  fit.log_likelihood = fit.mixed.beyond * std::log(share) + (fit.mixed.runs - fit.mixed.beyond) * std::log(1.0 - share);
  if (share <= 0.5) fit.below = fit.mixed.im;
  if (share >= 0.5) fit.above = fit.mixed.im;
  if (share < 0.5 && std::isfinite(next)) fit.above = std::exp(next);
  if (share > 0.5 && std::isfinite(last)) fit.below = std::exp(last);
}

/// Sets `identified` and the bounds of the median; true when the likelihood has a maximum of finite slope.
bool overlapping(const std::vector<Count>& counts, LognormalFit& fit) {
  const Ranges r = ranges_of(counts);
  const bool any_within = r.within_low <= r.within_high, any_beyond = r.beyond_low <= r.beyond_high;
  fit.identified = Identified::yes;
  if (!any_within && !any_beyond)
    fit.identified = Identified::no_runs;
  else if (!any_beyond)
    fit.identified = Identified::none_beyond, fit.below = std::exp(r.within_high), fit.log_likelihood = 0.0;
  else if (!any_within)
    fit.identified = Identified::all_beyond, fit.above = std::exp(r.beyond_low), fit.log_likelihood = 0.0;
  else if (std::min(r.within_low, r.beyond_low) == std::max(r.within_high, r.beyond_high))
    fit.identified = Identified::one_level;
  else if (r.within_high == r.beyond_low)
    bound_by_one_level(counts, r.within_high, fit);
  else if (r.within_high < r.beyond_low) {
    fit.identified = Identified::separated;
    fit.below = std::exp(r.within_high), fit.above = std::exp(r.beyond_low), fit.log_likelihood = 0.0;
  } else if (r.beyond_high <= r.within_low)
    fit.identified = Identified::falling;
  return fit.identified == Identified::yes;
}

/// ln L of Φ(a + g u), its gradient and the observed information.
struct Likelihood {
  double value = 0.0, da = 0.0, dg = 0.0, aa = 0.0, ag = 0.0, gg = 0.0;
  double determinant() const { return aa * gg - ag * ag; }
};

struct Standardised {
  std::vector<double> u;
  double mean = 0.0, spread = 1.0;  // of ln im
};

Standardised standardised(const std::vector<Count>& counts) {
  Standardised s;
  double runs = 0.0, squares = 0.0;
  for (const Count& c : counts) runs += c.runs, s.mean += c.runs * std::log(c.im);
  s.mean /= runs;
  for (const Count& c : counts) squares += c.runs * (std::log(c.im) - s.mean) * (std::log(c.im) - s.mean);
  s.spread = std::sqrt(squares / runs);
  for (const Count& c : counts) s.u.push_back((std::log(c.im) - s.mean) / s.spread);
  return s;
}

Likelihood likelihood(const std::vector<Count>& counts, const std::vector<double>& u, double a, double g) {
  Likelihood l;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double z = a + g * u[i], k = counts[i].beyond, rest = counts[i].runs - k;
    const double up = inverse_mills(z), down = inverse_mills(-z);
    const double slope = k * up - rest * down, bend = k * up * (up + z) + rest * down * (down - z);
    if (k > 0.0) l.value += k * log_normal_cdf(z);
    if (rest > 0.0) l.value += rest * log_normal_cdf(-z);
    l.da += slope, l.dg += slope * u[i];
    l.aa += bend, l.ag += bend * u[i], l.gg += bend * u[i] * u[i];
  }
  return l;
}

}  // namespace

LognormalFit fit_counts(const std::vector<Count>& counts) {
  LognormalFit fit;
  if (!overlapping(counts, fit)) return fit;
  const Standardised s = standardised(counts);
  double a = 0.0, g = 0.0;
  Likelihood now = likelihood(counts, s.u, a, g);
  for (int i = 0; i < 200; ++i) {
    const double det = now.determinant();
    const double step_a = (now.gg * now.da - now.ag * now.dg) / det, step_g = (now.aa * now.dg - now.ag * now.da) / det;
    if (!(now.da * step_a + now.dg * step_g > 1e-20 * (1.0 + std::abs(now.value)))) break;  // Newton's decrement
    double share = 1.0;
    Likelihood next = likelihood(counts, s.u, a + step_a, g + step_g);
    for (; next.value < now.value && share > 1e-9;
         next = likelihood(counts, s.u, a + share * step_a, g + share * step_g))
      share *= 0.5;
    if (!(next.value > now.value)) break;  // rounding
    a += share * step_a, g += share * step_g, now = next;
  }
  fit.log_likelihood = now.value;
  if (!(g > 0.0)) {
    fit.identified = Identified::falling;
    return fit;
  }
  // θ and β follow from a and g; so do their standard errors, to first order.
  const double det = now.determinant(), var_a = now.gg / det, var_g = now.aa / det, cov = -now.ag / det;
  const double per_a = -s.spread / g, per_g = s.spread * a / (g * g);
  fit.theta = std::exp(s.mean - s.spread * a / g);
  fit.beta = s.spread / g;
  fit.ln_theta_std = std::sqrt(per_a * per_a * var_a + 2.0 * per_a * per_g * cov + per_g * per_g * var_g);
  fit.beta_std = fit.beta / g * std::sqrt(var_g);
  return fit;
}

}  // namespace voussoir
