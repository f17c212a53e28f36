// Statistics for fragility: the normal distribution, a straight line, ranks. All values given to these functions are
// finite.
#pragma once
#include <cstddef>
#include <vector>

namespace voussoir {

/// Φ(z), the distribution function of the standard normal distribution.
double normal_cdf(double z);
/// ln Φ(z), exact to 1e-9 for all z.
double log_normal_cdf(double z);
/// φ(z)/Φ(z), the inverse of Mills' ratio.
double inverse_mills(double z);

/// The quantile for the probability p (0 < p < 1) of the standard normal distribution, and of Student's t with this
/// number of degrees of freedom.
double normal_quantile(double p);
double t_quantile(double p, double degrees);

/// Probability that Student's t with this number of degrees of freedom is farther from zero than t, on either side. NaN
/// if t is NaN or the number is not above 0.
double t_p_value(double t, double degrees);

/// y = intercept + slope x + scatter, by least squares. NaN if the data do not determine a value.
struct Line {
  std::size_t count = 0;
  double intercept = 0.0, slope = 0.0;
  double slope_std = 0.0;
  double scatter = 0.0;                 // standard deviation of the residuals, count − 2 degrees of freedom
  double r2 = 0.0;                      // share of the variance of y that the line explains
  double mean_x = 0.0, spread_x = 0.0;  // Σ (x − mean)²
  /// p-value of the hypothesis that the slope is zero.
  double p_value() const;
  bool known() const { return count >= 3 && spread_x > 0.0; }
};
Line fit_line(const std::vector<double>& x, const std::vector<double>& y);

/// p-value of c in y = a + b x + c z by least squares (Student's t, n − 3 degrees of freedom). NaN if z depends
/// linearly on x (the rest is less than 1e-6 of its spread) or if there are fewer than four values.
double added_p_value(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z);

/// Rank correlation (Spearman 1904); equal values share their mean rank. NaN if one of the two does not vary.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

/// The quantile for a share (0 to 1), with linear interpolation. `sorted` is not empty.
double quantile(const std::vector<double>& sorted, double share);

}  // namespace voussoir
