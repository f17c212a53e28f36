#include "solver/statics/stops.h"

#include <algorithm>
#include <cmath>

namespace voussoir {

std::vector<Stop> stops_of(const QuasiStaticSettings& settings) {
  double whole = 0.0, last = 0.0;
  for (const double corner : settings.path) whole += std::abs(corner - last), last = corner;
  std::vector<Stop> stops;
  double gone = 0.0, from = 0.0;
  for (const double corner : settings.path) {
    const double leg = std::abs(corner - from);
    const auto count = std::max<std::int64_t>(1, std::llround(double(settings.steps) * leg / std::max(whole, 1e-300)));
    for (std::int64_t i = 1; i <= count; ++i) {
      const double part = double(i) / double(count);
      const bool there = i == count;  // exactly
      stops.push_back({(gone + part * leg) / std::max(whole, 1e-300), there ? corner : from + part * (corner - from)});
    }
    gone += leg, from = corner;
  }
  if (!stops.empty()) stops.back().way = 1.0;
  return stops;
}

}  // namespace voussoir
