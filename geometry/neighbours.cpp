#include "geometry/neighbours.h"

#include <algorithm>
#include <numeric>

namespace voussoir {
namespace {

/// The axis along which the box centres differ most.
int longest_axis(const std::vector<Box>& boxes) {
  Box all;
  for (const Box& box : boxes) {
    const Vec3 centre = 0.5 * (box.low + box.high);
    all.low = all.low.cwiseMin(centre);
    all.high = all.high.cwiseMax(centre);
  }
  int axis = 0;
  (all.high - all.low).maxCoeff(&axis);
  return axis;
}

}  // namespace

std::vector<std::pair<int, int>> neighbours(const std::vector<Box>& boxes, double distance) {
  std::vector<std::pair<int, int>> out;
  if (boxes.size() < 2) return out;
  const int x = longest_axis(boxes), y = (x + 1) % 3, z = (x + 2) % 3;
  std::vector<int> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return std::pair(boxes[i].low[x], i) < std::pair(boxes[j].low[x], j); });
  std::vector<Box> sorted;  // in the order of the sweep, so that the inner loop reads straight on
  sorted.reserve(boxes.size());
  for (int i : order) sorted.push_back(boxes[i]);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Vec3 low = sorted[i].low.array() - distance, high = sorted[i].high.array() + distance;
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].low[x] <= high[x]; ++j) {
      const Box& b = sorted[j];
      // All six comparisons: with a negative distance a box thinner than it meets nothing.
      if (b.low[y] > high[y] || b.high[y] < low[y] || b.low[z] > high[z] || b.high[z] < low[z]) continue;
      if (b.high[x] < low[x]) continue;
      out.emplace_back(std::min(order[i], order[j]), std::max(order[i], order[j]));
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace voussoir
