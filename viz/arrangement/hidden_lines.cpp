#include "viz/arrangement/hidden_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <set>

namespace voussoir {

namespace {

constexpr std::size_t most_cells = 250;  // of the grid, each way

}  // namespace

InFront::InFront(const FlatView& view) : view_(view), all_(extent_of(view.faces)) {
  const Vec3 extent = all_.high - all_.low;
  size_ = std::max(extent.norm(), 1e-9);
  const double cells = std::clamp(double(view.faces.size()), 1.0, double(most_cells * most_cells));
  const double side = std::sqrt(std::max(extent.x(), 1e-6 * size_) * std::max(extent.y(), 1e-6 * size_) / cells);
  columns_ = std::clamp(std::size_t(extent.x() / side), std::size_t(1), most_cells);
  rows_ = std::clamp(std::size_t(extent.y() / side), std::size_t(1), most_cells);
  cells_.resize(columns_ * rows_);
  for (std::size_t f = 0; f < view.faces.size(); ++f) {
    boxes_.push_back(bounding_box(view.faces[f].corners));
    for (std::size_t r = row(boxes_[f].low.y()); r <= row(boxes_[f].high.y()); ++r)
      for (std::size_t c = column(boxes_[f].low.x()); c <= column(boxes_[f].high.x()); ++c)
        cells_[r * columns_ + c].push_back(f);
  }
}

std::size_t InFront::column(double u) const {
  const double share = (u - all_.low.x()) / std::max(all_.high.x() - all_.low.x(), 1e-12);
  return std::size_t(std::clamp(share * double(columns_), 0.0, double(columns_ - 1)));
}

std::size_t InFront::row(double v) const {
  const double share = (v - all_.low.y()) / std::max(all_.high.y() - all_.low.y(), 1e-12);
  return std::size_t(std::clamp(share * double(rows_), 0.0, double(rows_ - 1)));
}

double InFront::depth(std::size_t face, const Vec3& place) const {
  return view_.faces[face].depth.dot(Vec3(place.x(), place.y(), 1.0));
}

std::ptrdiff_t InFront::at(const Vec3& place) const {
  std::ptrdiff_t nearest = -1;
  double least = 1e300;
  for (const std::size_t f : cells_[row(place.y()) * columns_ + column(place.x())]) {
    if (!holds(view_.faces[f], place)) continue;
    const double d = depth(f, place);
    // Of a cut and a face in its plane the cut is in front.
    if (d < least - 1e-9 || (d < least + 1e-9 && view_.faces[f].cut)) least = d, nearest = std::ptrdiff_t(f);
  }
  return nearest;
}

template <class Pair>
void InFront::near_pairs(Pair&& pair) const {
  for (std::size_t cell = 0; cell < cells_.size(); ++cell)
    for (std::size_t i = 0; i < cells_[cell].size(); ++i)
      for (std::size_t j = i + 1; j < cells_[cell].size(); ++j) {
        const std::size_t a = cells_[cell][i], b = cells_[cell][j];
        // Once: in the first cell that both share.
        const Vec3 low = boxes_[a].low.cwiseMax(boxes_[b].low), high = boxes_[a].high.cwiseMin(boxes_[b].high);
        if (row(low.y()) * columns_ + column(low.x()) == cell && low.x() < high.x() && low.y() < high.y()) pair(a, b);
      }
}

namespace {

/// 1 if the first is farther away where both are visible, −1 if it is nearer, 0 if they do not overlap.
int which_is_farther(const FlatView& view, const InFront& front, std::size_t a, std::size_t b) {
  const Polygon both = intersect(view.faces[a].corners, view.faces[b].corners, Vec3::UnitZ());
  if (both.size() < 3 || polygon_area(both) < 1e-10 * front.size() * front.size()) return 0;
  const Vec3 at = polygon_centroid(both);
  const double difference = front.depth(a, at) - front.depth(b, at);
  if (std::abs(difference) < 1e-9 * front.size())
    return view.faces[a].cut == view.faces[b].cut ? 0 : view.faces[a].cut ? -1 : 1;
  return difference > 0.0 ? 1 : -1;
}

}  // namespace

std::vector<std::size_t> painting_order(const FlatView& view, const InFront& front, const std::vector<int>& colour) {
  const std::size_t n = view.faces.size();
  std::vector<std::vector<std::size_t>> before(n);  // faces painted over each face
  std::vector<std::size_t> waits(n, 0);
  front.near_pairs([&](std::size_t a, std::size_t b) {
    const int farther = which_is_farther(view, front, a, b);
    if (farther == 0) return;
    before[farther > 0 ? a : b].push_back(farther > 0 ? b : a);
    ++waits[farther > 0 ? b : a];
  });
  using Entry = std::pair<double, std::size_t>;  // depth, face
  std::map<int, std::priority_queue<Entry>> ready;
  std::set<Entry, std::greater<>> left;
  const auto depth = [&](std::size_t f) { return front.depth(f, polygon_centroid(view.faces[f].corners)); };
  for (std::size_t f = 0; f < n; ++f) {
    left.insert({depth(f), f});
    if (waits[f] == 0) ready[colour[f]].push({depth(f), f});
  }
  std::vector<std::size_t> order;
  int last = 0;
  while (!left.empty()) {
    auto queue = ready.find(last);
    if (queue == ready.end()) {
      queue = ready.begin();
      for (auto q = ready.begin(); q != ready.end(); ++q)
        if (q->second.top() > queue->second.top()) queue = q;
    }
    // If faces overlap in a cycle, the farthest is painted first.
    const Entry next = queue == ready.end() ? *left.begin() : queue->second.top();
    if (queue != ready.end()) {
      queue->second.pop();
      if (queue->second.empty()) ready.erase(queue);
    }
    if (left.erase(next) == 0) continue;
    order.push_back(next.second);
    last = colour[next.second];
    for (const std::size_t over : before[next.second])
      if (--waits[over] == 0) ready[colour[over]].push({depth(over), over});
  }
  return order;
}

namespace {

constexpr double crease = 0.94;  // cosine of the angle from which an edge between two faces of one component is drawn

/// The kind of an edge at one of its points; none if it is hidden or not an edge.
std::optional<LineKind> kind_at(const FlatView& view, const InFront& front, std::size_t f, const Vec3& at,
                                const Vec3& outward) {
  const FlatFace& face = view.faces[f];
  const double beside = 1e-4 * front.size(), level = 2e-4 * front.size();
  const Vec3 in = at - beside * outward, out = at + beside * outward;
  const std::ptrdiff_t top = front.at(in);
  if (top >= 0 && std::size_t(top) != f && front.depth(std::size_t(top), in) < front.depth(f, in) - 0.1 * level)
    return std::nullopt;
  const std::ptrdiff_t next = front.at(out);
  if (next < 0) return LineKind::outline;
  const FlatFace& other = view.faces[std::size_t(next)];
  const double step = front.depth(std::size_t(next), at) - front.depth(f, at);
  if (step < -level) return std::nullopt;  // it draws its own edge
  if (step > level) return LineKind::outline;
  const double cosine = face.normal.dot(other.normal);
  if (face.cut != other.cut) return LineKind::outline;
  if (face.block == other.block && (cosine > crease || face.block < 0)) return std::nullopt;
  if (face.component != other.component || face.fixed != other.fixed || cosine < crease) return LineKind::edge;
  return LineKind::joint;
}

/// Calls `part(from, to, kind)` for the runs of a line over which `kind(point)` stays the same.
template <class Kind, class Part>
void runs(const FlatLine& line, double resolution, Kind&& kind, Part&& part) {
  const double length = (line.second - line.first).norm();
  if (length < 1e-9) return;
  const int pieces = std::clamp(int(std::ceil(length / resolution)), 1, 400);
  const auto point = [&](double t) -> Vec3 { return line.first + t * (line.second - line.first); };
  double from = 0.0;
  auto now = kind(point(0.5 / pieces));
  for (int i = 1; i < pieces; ++i) {
    const auto next = kind(point((i + 0.5) / pieces));
    if (next == now) continue;
    double low = (i - 0.5) / pieces, high = (i + 0.5) / pieces;
    for (int halving = 0; halving < 5; ++halving) {
      const double middle = 0.5 * (low + high);
      (kind(point(middle)) == now ? low : high) = middle;
    }
    part(point(from), point(high), now);
    from = high, now = next;
  }
  part(point(from), point(1.0), now);
}

}  // namespace

std::array<std::vector<FlatLine>, kLineKinds> visible_lines(const FlatView& view, const InFront& front,
                                                            double resolution) {
  std::array<std::vector<FlatLine>, kLineKinds> lines;
  using Rounded = std::array<std::int64_t, 4>;
  std::set<Rounded> drawn;
  const auto rounded = [&](const Vec3& a, const Vec3& b) {
    const auto whole = [&](double x) { return std::llround(20.0 * x / resolution); };
    Rounded key = {whole(a.x()), whole(a.y()), whole(b.x()), whole(b.y())};
    if (std::tie(key[2], key[3]) < std::tie(key[0], key[1])) std::swap(key[0], key[2]), std::swap(key[1], key[3]);
    return key;
  };
  for (std::size_t f = 0; f < view.faces.size(); ++f) {
    const Polygon& corners = view.faces[f].corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const FlatLine edge = {corners[i], corners[(i + 1) % corners.size()]};
      const Vec3 along = edge.second - edge.first;
      const Vec3 outward = Vec3(along.y(), -along.x(), 0.0).normalized();
      runs(
          edge, resolution, [&](const Vec3& at) { return kind_at(view, front, f, at, outward); },
          [&](const Vec3& from, const Vec3& to, const std::optional<LineKind>& kind) {
            if (kind && drawn.insert(rounded(from, to)).second) lines[std::size_t(*kind)].emplace_back(from, to);
          });
    }
  }
  return lines;
}

std::vector<FlatLine> visible_parts(const InFront& front, std::size_t face, const FlatLine& line, double resolution) {
  std::vector<FlatLine> parts;
  const auto seen = [&](const Vec3& at) {
    const std::ptrdiff_t top = front.at(at);
    return top < 0 || std::size_t(top) == face ||
           front.depth(std::size_t(top), at) >= front.depth(face, at) - 1e-5 * front.size();
  };
  runs(line, resolution, seen, [&](const Vec3& from, const Vec3& to, bool is_seen) {
    if (is_seen) parts.emplace_back(from, to);
  });
  return parts;
}

}  // namespace voussoir
