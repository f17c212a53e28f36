#include "viz/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viz/overlay.h"

namespace voussoir {
namespace {

double tick_step(double length, int count) {
  const double least = length / count, step = nice_above(least);
  // 2.5 gives labels such as 7.5; 1-2-5 reads better along an axis.
  return std::abs(step / std::pow(10.0, std::floor(std::log10(step) + 1e-9)) - 2.5) < 1e-6 ? 2.0 * step : step;
}

void add_linear_ticks(Axis& axis, bool widen, int count) {
  const double step = tick_step(axis.high - axis.low, count);
  if (widen) {
    axis.low = step * std::floor(axis.low / step + 1e-9);
    axis.high = step * std::ceil(axis.high / step - 1e-9);
  }
  const auto first = std::int64_t(std::ceil(axis.low / step - 1e-9));
  const auto last = std::int64_t(std::floor(axis.high / step + 1e-9));
  for (auto k = first; k <= last; ++k) axis.ticks.push_back(step * double(k));
}

void add_log_ticks(Axis& axis, bool widen, int count) {
  if (widen || axis.high / axis.low < 10.0) {
    axis.low = std::pow(10.0, std::floor(std::log10(axis.low) + 1e-9));
    axis.high = std::pow(10.0, std::ceil(std::log10(axis.high) - 1e-9));
  }
  const int first = int(std::floor(std::log10(axis.low) + 1e-9)), last = int(std::ceil(std::log10(axis.high) - 1e-9));
  const int every = std::max(1, (last - first + count - 1) / count);
  const auto inside = [&](double v) { return v >= axis.low * (1 - 1e-9) && v <= axis.high * (1 + 1e-9); };
  for (int k = first; k <= last; ++k) {
    const double decade = std::pow(10.0, k);
    if (inside(decade) && (k - first) % every == 0) axis.ticks.push_back(decade);
    for (int m = 2; m < 10 && every == 1; ++m)
      if (inside(m * decade)) axis.minor.push_back(m * decade);
  }
}

}  // namespace

double Axis::share(double value) const {
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

Axis make_axis(double low, double high, bool logarithmic, bool widen, int count) {
  Axis axis{low, high, logarithmic, {}, {}};
  if (logarithmic) {
    if (high <= low * (1 + 1e-9)) axis.low = low / 2.0, axis.high = high * 2.0;
    add_log_ticks(axis, widen, count);
  } else {
    // A constant history gets a band about it, so that it is drawn in the middle and not divided by nothing.
    const double least = 1e-9 * std::max(std::abs(low), std::abs(high));
    if (high - low <= least) {
      const double half = low == 0.0 ? 1.0 : 0.5 * std::abs(low);
      axis.low = low - half, axis.high = high + half;
    }
    add_linear_ticks(axis, widen, count);
  }
  return axis;
}

std::string tick_label(const Axis& axis, double tick) {
  // Rounding of k × step leaves values like 1e-17 where 0 is meant.
  if (!axis.logarithmic && std::abs(tick) < 1e-9 * (axis.high - axis.low)) tick = 0.0;
  return fmt::format("{:.6g}", tick);
}

}  // namespace voussoir
