#include "tools/fragility/statistics.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "solver/base/constants.h"
#include "solver/base/csv.h"

namespace voussoir {

namespace {

constexpr double far_tail = -25.0;  // below, four terms of the asymptotic series err by less than 1e-9

/// z² Φ(z)/φ(z) − … of the far tail: Φ(z) = φ(z)/|z| (1 − 1/z² + 3/z⁴ − 15/z⁶ …) (Abramowitz & Stegun 1964, 26.2.12).
double tail_series(double z) {
  const double u = 1.0 / (z * z);
  return 1.0 - u * (1.0 - u * (3.0 - 15.0 * u));
}

double mean_of(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / double(v.size());
}

/// Σ (x − mean x)(y − mean y).
double product_sum(const std::vector<double>& x, const std::vector<double>& y) {
  const double mx = mean_of(x), my = mean_of(y);
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - mx) * (y[i] - my);
  return sum;
}

/// Residuals of y after a line in x.
std::vector<double> residuals(const std::vector<double>& x, const std::vector<double>& y) {
  const double slope = product_sum(x, y) / product_sum(x, x), mx = mean_of(x), my = mean_of(y);
  std::vector<double> left;
  for (std::size_t i = 0; i < x.size(); ++i) left.push_back(y[i] - my - slope * (x[i] - mx));
  return left;
}

std::vector<double> ranks(const std::vector<double>& v) {
  std::vector<std::size_t> order(v.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return v[a] < v[b]; });
  std::vector<double> rank(v.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;
    while (end < order.size() && v[order[end]] == v[order[i]]) ++end;
    for (std::size_t k = i; k < end; ++k) rank[order[k]] = 0.5 * double(i + end - 1);
    i = end;
  }
  return rank;
}

}  // namespace

double normal_cdf(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

double log_normal_cdf(double z) {
  if (z > far_tail) return std::log(normal_cdf(z));
  return -0.5 * z * z - std::log(-z * std::sqrt(2.0 * pi)) + std::log(tail_series(z));
}

double inverse_mills(double z) {
  if (z <= far_tail) return -z / tail_series(z);
  return std::exp(-0.5 * z * z) / (std::sqrt(2.0 * pi) * normal_cdf(z));
}

double normal_quantile(double p) {
  return boost::math::quantile(boost::math::normal(), p);
}

double t_quantile(double p, double degrees) {
  return boost::math::quantile(boost::math::students_t(degrees), p);
}

double t_p_value(double t, double degrees) {
  if (std::isnan(t) || !(degrees > 0.0)) return no_number;
  if (std::isinf(t)) return 0.0;
  return 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t(degrees), std::abs(t)));
}

double Line::p_value() const {
  if (!known()) return no_number;
  if (slope_std == 0.0) return slope == 0.0 ? 1.0 : 0.0;
  return t_p_value(slope / slope_std, double(count) - 2.0);
}

Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  Line line;
  line.count = x.size();
  line.intercept = line.slope = line.slope_std = line.scatter = line.r2 = no_number;
  if (x.empty()) return line;
  line.mean_x = mean_of(x);
  line.spread_x = product_sum(x, x);
  // Equal values differ by rounding of their mean.
  if (const double least = 1e-24 * line.mean_x * line.mean_x * double(x.size()); line.spread_x <= least)
    line.spread_x = 0.0;
  if (!line.known()) return line;
  line.slope = product_sum(x, y) / line.spread_x;
  line.intercept = mean_of(y) - line.slope * line.mean_x;
  double left = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = y[i] - line.intercept - line.slope * x[i];
    left += r * r;
  }
  const double all = product_sum(y, y);
  line.scatter = std::sqrt(left / (double(line.count) - 2.0));
  line.slope_std = line.scatter / std::sqrt(line.spread_x);
  line.r2 = all > 0.0 ? std::max(0.0, 1.0 - left / all) : no_number;
  return line;
}

double added_p_value(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z) {
  if (x.size() < 4 || !(product_sum(x, x) > 0.0) || !(product_sum(z, z) > 0.0)) return no_number;
  // Of multiple regression one coefficient is that of the residuals on the residuals (Frisch & Waugh 1933).
  const std::vector<double> ry = residuals(x, y), rz = residuals(x, z);
  const double zz = product_sum(rz, rz);
  if (zz < 1e-12 * product_sum(z, z)) return no_number;
  const double slope = product_sum(rz, ry) / zz, degrees = double(x.size()) - 3.0;
  const double left = std::max(product_sum(ry, ry) - slope * slope * zz, 0.0);
  if (left == 0.0) return slope == 0.0 ? 1.0 : 0.0;
  return t_p_value(slope / std::sqrt(left / degrees / zz), degrees);
}

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const std::vector<double> rx = ranks(x), ry = ranks(y);
  if (rx.size() < 2) return no_number;
  const double xx = product_sum(rx, rx), yy = product_sum(ry, ry);
  return xx > 0.0 && yy > 0.0 ? product_sum(rx, ry) / std::sqrt(xx * yy) : no_number;
}

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * double(sorted.size() - 1);
  const std::size_t below = std::min(std::size_t(place), sorted.size() - 1),
                    above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - double(below)) * (sorted[above] - sorted[below]);
}

}  // namespace voussoir
