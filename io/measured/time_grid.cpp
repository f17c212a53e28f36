#include "io/measured/time_grid.h"

#include <algorithm>
#include <cmath>

namespace voussoir {

namespace {

/// Range of the differences between the times and a line with this slope. Half of it is the largest error, because the
/// grid may start anywhere.
double spread(const std::vector<double>& times, double step) {
  double low = 0.0, high = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double rest = (times[i] - times[0]) - step * double(i);
    low = std::min(low, rest);
    high = std::max(high, rest);
  }
  return high - low;
}

/// The slope of least spread between two: it is convex in the slope.
double best_step(const std::vector<double>& times, double low, double high) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double at_a = spread(times, a), at_b = spread(times, b);
  for (int i = 0; i < 60; ++i) {
    if (at_a <= at_b) {
      high = b, b = a, at_b = at_a;
      a = high - ratio * (high - low), at_a = spread(times, a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + ratio * (high - low), at_b = spread(times, b);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

std::optional<int> decimals_of(std::string_view word) {
  if (word.find_first_of("eE") != std::string_view::npos) return std::nullopt;
  const std::size_t point = word.find('.');
  return point == std::string_view::npos ? 0 : int(word.size() - point - 1);
}

std::optional<double> grid_step(const std::vector<double>& times, double half) {
  const double steps = double(times.size() - 1), length = times.back() - times.front();
  const double room = 2.0 * half * (1.0 + 1e-6) + 1e-12 * std::abs(times.back());  // and the rounding of doubles
  const double low = (length - room) / steps, high = (length + room) / steps;
  if (!(low > 0.0)) return std::nullopt;
  const double rate = std::round(steps / length);
  if (const double whole = 1.0 / rate; rate > 0.0 && whole >= low && whole <= high && spread(times, whole) <= room)
    return whole;
  const double best = best_step(times, low, high);
  if (spread(times, best) <= room) return best;
  return std::nullopt;
}

}  // namespace voussoir
