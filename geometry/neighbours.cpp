#include "geometry/neighbours.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace voussoir {
// Not unnamed: BoxIndex::Content has members of these types, and stands in a header.
inline namespace boxes {

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

/// Strips of equal width across the sweep, about two boxes wide, so that a box is in few strips and a strip has few
/// boxes next to each other.
class Strips {
 public:
  Strips(const std::vector<Box>& boxes, int axis, double distance) : axis_(axis), reach_(std::max(distance, 0.0)) {
    double low = 1e300, high = -1e300, width = 0.0;
    for (const Box& box : boxes) {
      low = std::min(low, box.low[axis]), high = std::max(high, box.high[axis]);
      width += (box.high[axis] - box.low[axis] + reach_) / double(boxes.size());
    }
    const double most = std::max(1.0, std::sqrt(double(boxes.size())));
    const double wide = (high - low) / std::max(2.0 * width, 1e-300);
    count_ = wide > 1.0 ? int(std::min(wide, most)) : 1;  // 1 for what is no number, too
    from_ = low;
    size_ = (high - low) / count_;
  }
  std::size_t count() const { return std::size_t(count_); }
  int at(double x) const {
    const double strip = (x - from_) / size_;
    return strip > 0.0 && size_ > 0.0 ? int(std::min(strip, count_ - 1.0)) : 0;
  }
  int first(const Box& box) const { return at(box.low[axis_]); }
  /// The distance is slightly enlarged because of rounding.
  int last(const Box& box) const { return std::max(first(box), at(box.high[axis_] + reach_ + 1e-6 * size_)); }

 private:
  int axis_, count_ = 1;
  double from_ = 0.0, size_ = 0.0, reach_;
};

/// Columns along the sweep, each with its boxes in the order in which they were added.
class Columns {
 public:
  Columns(const std::vector<Box>& boxes, int y, int z, double distance)
      : y_(boxes, y, distance), z_(boxes, z, distance), first_(y_.count() * z_.count() + 1, 0) {
    for (const Box& box : boxes) each(box, [&](std::size_t column) { ++first_[column + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    members_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      each(boxes[i], [&](std::size_t column) { members_[next[column]++] = int(i); });
  }
  std::size_t count() const { return first_.size() - 1; }
  std::span<const int> members(std::size_t column) const {
    return std::span(members_).subspan(first_[column], first_[column + 1] - first_[column]);
  }
  std::size_t at(double y, double z) const { return std::size_t(y_.at(y)) * z_.count() + std::size_t(z_.at(z)); }

  /// All columns of a box.
  template <class F>
  void each(const Box& box, F f) const {
    for (int i = y_.first(box); i <= y_.last(box); ++i)
      for (int j = z_.first(box); j <= z_.last(box); ++j) f(std::size_t(i) * z_.count() + std::size_t(j));
  }

 private:
  Strips y_, z_;
  std::vector<std::size_t> first_;
  std::vector<int> members_;
};

/// Boxes in the order in which they begin along x.
struct Sweep {
  std::vector<int> order;  // numbers of the boxes
  std::vector<Box> boxes;
};
Sweep sweep_along(int x, const std::vector<Box>& boxes) {
  Sweep sweep;
  sweep.order.resize(boxes.size());
  std::iota(sweep.order.begin(), sweep.order.end(), 0);
  std::sort(sweep.order.begin(), sweep.order.end(), [&](int i, int j) {
    return std::pair(boxes[std::size_t(i)].low[x], i) < std::pair(boxes[std::size_t(j)].low[x], j);
  });
  sweep.boxes.reserve(boxes.size());
  for (const int i : sweep.order) sweep.boxes.push_back(boxes[std::size_t(i)]);
  return sweep;
}

}  // namespace boxes

std::vector<std::pair<int, int>> neighbours(const std::vector<Box>& boxes, double distance) {
  std::vector<std::pair<int, int>> out;
  if (boxes.size() < 2) return out;
  const int x = longest_axis(boxes), y = (x + 1) % 3, z = (x + 2) % 3;
  const auto [order, sorted] = sweep_along(x, boxes);
  const Columns columns(sorted, y, z, distance);
  std::vector<Box> column;  // in the order of the sweep, so that the inner loop reads straight on
  for (std::size_t c = 0; c < columns.count(); ++c) {
    const std::span<const int> members = columns.members(c);
    column.clear();
    for (int i : members) column.push_back(sorted[i]);
    for (std::size_t i = 0; i < column.size(); ++i) {
      const Box& a = column[i];
      const Vec3 low = a.low.array() - distance, high = a.high.array() + distance;
      for (std::size_t j = i + 1; j < column.size() && column[j].low[x] <= high[x]; ++j) {
        const Box& b = column[j];
        // All six comparisons: with a negative distance a box thinner than it meets nothing.
        if (b.low[y] > high[y] || b.high[y] < low[y] || b.low[z] > high[z] || b.high[z] < low[z]) continue;
        if (b.high[x] < low[x]) continue;
        // A pair that shares several columns counts in the one where both have begun.
        if (columns.at(std::max(a.low[y], b.low[y]), std::max(a.low[z], b.low[z])) != c) continue;
        out.push_back(std::minmax({order[members[i]], order[members[j]]}));
      }
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

struct BoxIndex::Content {
  Content(const std::vector<Box>& of, double within)
      : x(longest_axis(of)),
        distance(within),
        sweep(sweep_along(x, of)),
        columns(sweep.boxes, (x + 1) % 3, (x + 2) % 3, within) {
    for (const Box& box : of) longest = std::max(longest, box.high[x] - box.low[x]);
  }
  int x;
  double distance, longest = 0.0;  // m
  Sweep sweep;
  Columns columns;
};

BoxIndex::BoxIndex(const std::vector<Box>& boxes, double distance)
    : content_(std::make_unique<Content>(boxes, distance)) {}
BoxIndex::~BoxIndex() = default;

void BoxIndex::near(const Box& box, std::vector<int>& found) const {
  const Content& c = *content_;
  const int x = c.x, y = (x + 1) % 3, z = (x + 2) % 3;
  const Vec3 low = box.low.array() - c.distance, high = box.high.array() + c.distance;
  found.clear();
  c.columns.each(box, [&](std::size_t column) {
    const std::span<const int> members = c.columns.members(column);
    const auto begins = [&](int i, double at) { return c.sweep.boxes[std::size_t(i)].low[x] < at; };
    for (auto at = std::lower_bound(members.begin(), members.end(), low[x] - c.longest, begins); at != members.end();
         ++at) {
      const Box& b = c.sweep.boxes[std::size_t(*at)];
      if (b.low[x] > high[x]) break;
      if ((b.low.array() > high.array()).any() || (b.high.array() < low.array()).any()) continue;
      if (c.columns.at(std::max(box.low[y], b.low[y]), std::max(box.low[z], b.low[z])) != column) continue;
      found.push_back(c.sweep.order[std::size_t(*at)]);
    }
  });
  std::sort(found.begin(), found.end());
}

}  // namespace voussoir
