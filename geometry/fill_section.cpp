#include "geometry/fill_section.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/base/constants.h"

namespace voussoir {

namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;  // nodes, the lower first
Edge edge_of(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// Twice the area of a triangle in the plane x-z, positive if it turns from x to z.
double twice_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x() - a.x()) * (c.z() - a.z()) - (b.z() - a.z()) * (c.x() - a.x());
}

/// Cost of a triangle: edges above the bound, heights below 0.45 of the bound, then unequal sides.
/// Infinite, as it were, for one that is turned over or flat. The weights were tried on CS1 and CS2.
double badness(const std::array<Vec3, 3>& corner, double turn, double bound) {
  constexpr double near = 0.985, low = 0.45, of_length = 400.0, of_height = 4.0, of_shape = 0.01, never = 1e6;
  const double area = turn * twice_area(corner[0], corner[1], corner[2]) / (bound * bound);
  if (area <= 1e-4) return never;
  double sum = 0.0, squares = 0.0, longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length2 = (corner[(i + 1) % 3] - corner[i]).squaredNorm() / (bound * bound);
    squares += length2, longest = std::max(longest, length2);
    const double over = std::max(std::sqrt(length2) - near, 0.0);
    sum += of_length * over * over;
  }
  const double lack = std::max(low - area / std::sqrt(longest), 0.0);
  const double unlike = 1.0 - 2.0 * std::sqrt(3.0) * area / squares;  // 0 for equal sides
  return sum + of_height * lack * lack + of_shape * unlike * unlike;
}

/// A section while its edges are shortened.
class Shortening {
 public:
  Shortening(FillSection& section, double bound) : section_(section), bound_(bound) {
    around_.resize(section.nodes.size());
    fixed_.assign(section.nodes.size(), false), unsettled_.assign(section.nodes.size(), true);
    for (std::size_t t = 0; t < section.triangles.size(); ++t) enter(std::int32_t(t));
    for (const auto& [edge, sides] : sides_)
      if (stays(sides)) fixed_[std::size_t(edge.first)] = fixed_[std::size_t(edge.second)] = true;
    for (const auto& triangle : section.triangles) turn_.push_back(turn_of(triangle.nodes));
  }

  void run() {
    constexpr int rounds = 400;
    for (int round = 0; round < rounds; ++round) {
      settle();
      const std::vector<Edge> left = too_long();
      if (left.empty()) return;
      halve(left);
    }
  }

 private:
  FillSection& section_;
  double bound_;
  std::map<Edge, std::vector<std::int32_t>> sides_;  // triangles of each edge
  std::vector<std::vector<std::int32_t>> around_;    // triangles of each node
  std::vector<double> turn_;                         // of each triangle, as it was numbered: 1 or −1
  std::vector<bool> fixed_, unsettled_;              // of each node

  const Vec3& at(std::int32_t node) const { return section_.nodes[std::size_t(node)]; }
  std::array<std::int32_t, 3>& nodes(std::int32_t t) { return section_.triangles[std::size_t(t)].nodes; }
  double length(const Edge& e) const { return (at(e.first) - at(e.second)).norm(); }
  double turn_of(const std::array<std::int32_t, 3>& n) const {
    return twice_area(at(n[0]), at(n[1]), at(n[2])) > 0.0 ? 1.0 : -1.0;
  }
  double bad(const std::array<std::int32_t, 3>& n, std::int32_t t) const {
    return badness({at(n[0]), at(n[1]), at(n[2])}, turn_[std::size_t(t)], bound_);
  }
  double bad_around(std::int32_t node) const {
    double sum = 0.0;
    for (const std::int32_t t : around_[std::size_t(node)]) sum += bad(section_.triangles[std::size_t(t)].nodes, t);
    return sum;
  }
  /// An edge of the outline, or between parts.
  bool stays(const std::vector<std::int32_t>& sides) const {
    if (sides.size() != 2) return true;
    const auto &a = section_.triangles[std::size_t(sides[0])], &b = section_.triangles[std::size_t(sides[1])];
    return a.y0 != b.y0 || a.y1 != b.y1 || a.material != b.material;
  }

  void enter(std::int32_t t) {
    for (std::size_t i = 0; i < 3; ++i) {
      sides_[edge_of(nodes(t)[i], nodes(t)[(i + 1) % 3])].push_back(t);
      around_[std::size_t(nodes(t)[i])].push_back(t);
    }
  }
  void leave(std::int32_t t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto side = sides_.find(edge_of(nodes(t)[i], nodes(t)[(i + 1) % 3]));
      std::erase(side->second, t);
      if (side->second.empty()) sides_.erase(side);
      std::erase(around_[std::size_t(nodes(t)[i])], t);
    }
  }
  void unsettle(std::int32_t node) {
    for (const std::int32_t t : around_[std::size_t(node)])
      for (const std::int32_t k : nodes(t)) unsettled_[std::size_t(k)] = true;
  }

  /// Nodes move and edges turn until neither makes anything better.
  void settle() {
    constexpr int sweeps = 300;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      bool changed = false;
      for (std::size_t node = 0; node < section_.nodes.size(); ++node)
        if (unsettled_[node]) changed |= move(std::int32_t(node));
      changed |= turn_edges();
      if (!changed) return;
    }
  }

  /// Tries steps in eight directions, long ones first.
  bool move(std::int32_t node) {
    unsettled_[std::size_t(node)] = false;
    if (fixed_[std::size_t(node)]) return false;
    constexpr double gain = 1e-5;
    Vec3& place = section_.nodes[std::size_t(node)];
    double least = bad_around(node);
    bool moved = false;
    for (const double step : {0.08, 0.03, 0.01, 0.003})
      for (int d = 0; d < 8; ++d) {
        const Vec3 was = place;
        place += step * bound_ * Vec3(std::cos(0.25 * pi * d), 0.0, std::sin(0.25 * pi * d));
        const double now = bad_around(node);
        if (now < least - gain)
          least = now, moved = true;
        else
          place = was;
      }
    if (moved) unsettle(node);
    return moved;
  }

  bool turn_edges() {
    std::vector<Edge> edges;
    for (const auto& [edge, sides] : sides_)
      if (unsettled_[std::size_t(edge.first)] || unsettled_[std::size_t(edge.second)]) edges.push_back(edge);
    bool turned = false;
    for (const Edge& edge : edges) turned |= turn_edge(edge);
    return turned;
  }

  /// Puts the other diagonal of an edge's two triangles in its place if that is better.
  bool turn_edge(const Edge& edge) {
    const auto found = sides_.find(edge);
    if (found == sides_.end() || stays(found->second)) return false;
    const std::int32_t one = found->second[0], two = found->second[1];
    const auto across = [&](std::int32_t t) {
      for (const std::int32_t k : nodes(t))
        if (k != edge.first && k != edge.second) return k;
      return edge.first;
    };
    const std::int32_t c = across(one), d = across(two);
    std::array<std::int32_t, 3> first = nodes(one), second = nodes(two);
    std::replace(first.begin(), first.end(), edge.second, d);
    std::replace(second.begin(), second.end(), edge.first, c);
    if (bad(first, one) + bad(second, two) > bad(nodes(one), one) + bad(nodes(two), two) - 1e-9) return false;
    leave(one), leave(two);
    nodes(one) = first, nodes(two) = second;
    enter(one), enter(two);
    unsettle(c), unsettle(d);
    return true;
  }

  /// The longest first.
  std::vector<Edge> too_long() const {
    std::vector<Edge> edges;
    for (const auto& [edge, sides] : sides_)
      if (!stays(sides) && length(edge) > bound_) edges.push_back(edge);
    std::stable_sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return length(a) > length(b); });
    return edges;
  }

  /// Halves some of them, far from one another: of the others many will do without.
  void halve(const std::vector<Edge>& edges) {
    std::size_t most = 1 + edges.size() / 10;
    std::vector<bool> taken(section_.nodes.size(), false);
    for (const Edge& edge : edges) {
      if (most == 0) return;
      if (taken[std::size_t(edge.first)] || taken[std::size_t(edge.second)]) continue;
      --most;
      const std::vector<std::int32_t> halved = sides_.at(edge);
      for (const std::int32_t t : halved)
        for (const std::int32_t k : nodes(t))
          for (const std::int32_t other : around_[std::size_t(k)])
            for (const std::int32_t n : nodes(other))
              if (std::size_t(n) < taken.size()) taken[std::size_t(n)] = true;
      halve(edge, halved);
    }
  }
  void halve(const Edge& edge, const std::vector<std::int32_t>& sides) {
    const auto middle = std::int32_t(section_.nodes.size());
    section_.nodes.push_back(0.5 * (at(edge.first) + at(edge.second)));
    around_.emplace_back();
    fixed_.push_back(false), unsettled_.push_back(true);
    for (const std::int32_t t : sides) {
      leave(t);
      FillSection::Triangle half = section_.triangles[std::size_t(t)];
      std::replace(half.nodes.begin(), half.nodes.end(), edge.first, middle);
      std::replace(nodes(t).begin(), nodes(t).end(), edge.second, middle);
      section_.triangles.push_back(half);
      turn_.push_back(turn_[std::size_t(t)]);
      enter(t), enter(std::int32_t(section_.triangles.size()) - 1);
    }
    unsettle(middle);
  }
};

double distance(const Side& side, const Vec3& p) {
  const Vec3 along = side[1] - side[0];
  const double share = std::clamp((p - side[0]).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - side[0] - share * along).norm();
}

/// Whether a ray from `p` along x crosses the outline an odd number of times.
bool is_inside(const std::vector<Side>& outline, const Vec3& p) {
  bool inside = false;
  for (const auto& [a, b] : outline)
    if ((a.z() > p.z()) != (b.z() > p.z()) && p.x() < a.x() + (p.z() - a.z()) / (b.z() - a.z()) * (b.x() - a.x()))
      inside = !inside;
  return inside;
}

/// The highest of the level sides, of several the longest; none if no side is level.
const Side* top_of(const std::vector<Side>& outline) {
  constexpr double same = 1e-9;  // m
  const Side* top = nullptr;
  for (const Side& side : outline) {
    if (std::abs(side[0].z() - side[1].z()) > same) continue;
    const double rise = top ? side[0].z() - (*top)[0].z() : 1.0;
    if (rise > same || (rise > -same && (side[1] - side[0]).norm() > ((*top)[1] - (*top)[0]).norm())) top = &side;
  }
  return top;
}

}  // namespace

double longest_edge(const FillSection& section) {
  double longest = 0.0;
  for (const auto& triangle : section.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &p = section.nodes[std::size_t(triangle.nodes[i])],
                 &q = section.nodes[std::size_t(triangle.nodes[(i + 1) % 3])];
      longest = std::max(longest, (q - p).norm());
    }
  }
  return longest;
}

std::vector<Vec3> lattice_inside(const std::vector<Side>& outline, double edge) {
  constexpr double apart = 0.45;
  std::vector<Vec3> points;
  const Side* top = top_of(outline);
  if (!top) return points;
  Vec3 low = (*top)[0], high = low;
  for (const Side& side : outline)
    for (const Vec3& p : side) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double length = ((*top)[1] - (*top)[0]).norm(), along = length / std::ceil(length / edge - 1e-9);
  const double down = std::sqrt(edge * edge - 0.25 * along * along), x0 = std::min((*top)[0].x(), (*top)[1].x());
  for (int row = 1; (*top)[0].z() - row * down > low.z(); ++row) {
    const double from = x0 + (row % 2 ? 0.5 * along : 0.0);
    for (double i = std::floor((low.x() - from) / along); from + i * along < high.x(); ++i) {
      const Vec3 p(from + i * along, 0.0, (*top)[0].z() - row * down);
      const auto far = [&](const Side& side) { return distance(side, p) >= apart * edge; };
      if (is_inside(outline, p) && std::all_of(outline.begin(), outline.end(), far)) points.push_back(p);
    }
  }
  return points;
}

void shorten_edges(FillSection& section, double bound) {
  Shortening(section, bound).run();
}

}  // namespace voussoir
