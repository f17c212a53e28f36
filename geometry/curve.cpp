#include "geometry/curve.h"

#include <algorithm>
#include <utility>

namespace voussoir {

namespace {

/// Morton code of a point in a box, 21 bits an axis.
std::uint64_t morton(const Vec3& p, const Box& box) {
  const double extent = std::max(1e-12, (box.high - box.low).maxCoeff());
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto bits = std::uint64_t(std::clamp((p[axis] - box.low[axis]) / extent, 0.0, 1.0) * 2097151.0);
    for (int i = 0; i < 21; ++i) code |= ((bits >> i) & 1u) << (3 * i + axis);
  }
  return code;
}

}  // namespace

std::vector<std::int32_t> along_curve(const std::vector<Vec3>& points) {
  const Box box = bounding_box(points);
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys;
  for (std::size_t i = 0; i < points.size(); ++i) keys.emplace_back(morton(points[i], box), std::int32_t(i));
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> order;
  for (const auto& key : keys) order.push_back(key.second);
  return order;
}

std::vector<std::int32_t> in_slabs(const std::vector<Vec3>& points, double thickness) {
  const Box box = bounding_box(points);
  int axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const auto slab = [&](std::int32_t i) {
    return std::int64_t((points[std::size_t(i)][axis] - box.low[axis]) / thickness);
  };
  std::vector<std::int32_t> order = along_curve(points);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return slab(a) < slab(b); });
  return order;
}

}  // namespace voussoir
