#include "geometry/fill_columns.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace voussoir {

namespace {

constexpr double stagger = 2.0 / 3.0;  // of a layer: how far edges between columns of different colours rise at most
constexpr int colours = 3;

std::vector<double> distinct(std::vector<double> ends) {
  std::vector<double> out;
  std::sort(ends.begin(), ends.end());
  for (const double y : ends)
    if (out.empty() || y - out.back() > same_end) out.push_back(y);
  return out;
}

/// The same with the middle, if it lies between them.
std::vector<double> with_middle(std::vector<double> ends) {
  ends = distinct(std::move(ends));
  if (ends.empty() || ends.front() > -same_end || ends.back() < same_end) return ends;
  const auto above = std::lower_bound(ends.begin(), ends.end(), -same_end);
  if (*above > same_end) ends.insert(above, 0.0);
  return ends;
}

/// The division of the space between two ends.
struct Layers {
  int count = 1;
  double thickness = 0.0;  // m
  bool level = false;      // one thin layer: columns need not be staggered
};

Layers layers_of(double space, double layer) {
  Layers layers;
  layers.count = std::max(1, int(std::ceil(space / layer - 1e-9)));
  layers.thickness = space / layers.count;
  layers.level = layers.count == 1 && layers.thickness <= (1.0 + 1e-9) * stagger * layer;
  return layers;
}

/// The thickest layer between the ends that is staggered; 0 if none is.
double staggered_layer(const std::vector<double>& ends, double layer) {
  double thickest = 0.0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if (const Layers layers = layers_of(ends[i + 1] - ends[i], layer); !layers.level)
      thickest = std::max(thickest, layers.thickness);
  return thickest;
}

/// The stagger (one of three) of each column: neighbours differ if the edge between them needs it.
class Colouring {
 public:
  Colouring(const FillSection& section, double edge, double layer) : colour(section.nodes.size(), -1) {
    near_.resize(section.nodes.size());
    std::set<std::pair<std::int32_t, std::int32_t>> edges;
    for (const auto& triangle : section.triangles)
      for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(triangle.nodes[i], triangle.nodes[(i + 1) % 3]));
    for (const auto& [a, b] : edges) {
      const double squared = (section.nodes[std::size_t(a)] - section.nodes[std::size_t(b)]).squaredNorm();
      const double over = std::max(squared + layer * layer - edge * edge, 0.0);
      near_[std::size_t(a)].push_back({b, squared, over});
      near_[std::size_t(b)].push_back({a, squared, over});
    }
    grow();
    improve();
  }
  std::vector<int> colour;

 private:
  struct Neighbour {
    std::int32_t node;
    double squared, over;  // m2: of the edge's length, and what it has too much if both have one colour
  };
  std::vector<std::vector<Neighbour>> near_;

  /// Cost of a colour for a node: excess length of edges, then length of the edges that rise most.
  std::pair<double, double> cost(std::size_t node, int c) const {
    std::pair<double, double> sum{0.0, 0.0};
    for (const Neighbour& n : near_[node])
      if (colour[std::size_t(n.node)] == c) sum.first += n.over, sum.second += n.squared;
    return sum;
  }
  int best(std::size_t node) const {
    int least = 0;
    for (int c = 1; c < colours; ++c)
      if (cost(node, c) < cost(node, least)) least = c;
    return least;
  }

  /// From node to node, first those with the longest edges to nodes that have a colour.
  void grow() {
    std::set<std::pair<double, std::int32_t>> waiting;  // less the squares of those edges
    std::vector<double> key(near_.size(), 0.0);
    for (std::size_t i = 0; i < near_.size(); ++i) waiting.insert({0.0, std::int32_t(i)});
    while (!waiting.empty()) {
      const std::int32_t node = waiting.begin()->second;
      waiting.erase(waiting.begin());
      colour[std::size_t(node)] = best(std::size_t(node));
      for (const Neighbour& n : near_[std::size_t(node)]) {
        if (colour[std::size_t(n.node)] >= 0) continue;
        waiting.erase({key[std::size_t(n.node)], n.node});
        key[std::size_t(n.node)] -= n.squared;
        waiting.insert({key[std::size_t(n.node)], n.node});
      }
    }
  }

  void improve() {
    constexpr int rounds = 100;
    for (int round = 0; round < rounds; ++round) {
      bool changed = false;
      for (std::size_t node = 0; node < near_.size(); ++node) {
        const int other = best(node);
        if (!(cost(node, other) < cost(node, colour[node]))) continue;
        colour[node] = other, changed = true;
      }
      if (!changed) return;
    }
  }
};

/// Nodes of a column between two ends, the first of them included, counted from the one nearer to y = 0.
std::vector<double> between(double from, double to, double layer, int colour) {
  std::vector<double> y = {from};
  const Layers layers = layers_of(to - from, layer);
  if (layers.level || colour == 0) {
    for (int k = 1; k < layers.count; ++k) y.push_back(from + k * layers.thickness);
    return y;
  }
  for (int k = 0; k < layers.count; ++k) {
    double at = k + double(colour) / colours;  // steps at the ends are no shorter than half a layer
    at = std::clamp(at, 0.5, layers.count - 0.5);
    y.push_back(from + at * layers.thickness);
  }
  return y;
}

std::vector<double> column(const std::vector<double>& ends, double layer, int colour) {
  std::vector<double> y;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double low = ends[i], high = ends[i + 1];
    if (high > same_end) {
      for (const double at : between(low, high, layer, colour)) y.push_back(at);
    } else {  // the mirror image, bit for bit
      const std::vector<double> mirrored = between(-high, -low, layer, colour);
      y.push_back(low);
      for (auto at = mirrored.rbegin(); at + 1 != mirrored.rend(); ++at) y.push_back(-*at);
    }
  }
  y.push_back(ends.back());
  return y;
}

using Ranges = std::map<std::pair<std::int32_t, std::int32_t>, std::set<std::pair<double, double>>>;

/// Edges of the section, and from where to where triangles at them reach.
Ranges ranges_of(const FillSection& section) {
  Ranges ranges;
  for (const auto& triangle : section.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      ranges[std::minmax(triangle.nodes[i], triangle.nodes[(i + 1) % 3])].insert({triangle.y0, triangle.y1});
  return ranges;
}

/// Halves steps of more than `least` m where edges between two columns are too long; false if there are none.
bool halve_steps(const FillSection& section, const Ranges& ranges, double edge, double least, FillColumns& columns) {
  std::vector<std::set<double>> fresh(columns.size());
  bool any = false;
  for (const auto& [nodes, parts] : ranges) {
    const auto a = std::size_t(nodes.first), b = std::size_t(nodes.second);
    const double squared = (section.nodes[a] - section.nodes[b]).squaredNorm();
    if (squared >= edge * edge) continue;  // no steps would do
    for (const auto& [from, to] : parts) {
      std::size_t i = level_at(columns[a], from), j = level_at(columns[b], from);
      const std::size_t end_i = level_at(columns[a], to), end_j = level_at(columns[b], to);
      while (i < end_i && j < end_j) {
        const double a0 = columns[a][i], a1 = columns[a][i + 1], b0 = columns[b][j], b1 = columns[b][j + 1];
        const bool first = a0 + a1 < b0 + b1;
        const double rise = first ? a1 - b0 : b1 - a0;
        const bool of_a = a1 - a0 >= b1 - b0;
        if (squared + rise * rise > edge * edge && (of_a ? a1 - a0 : b1 - b0) > least) {
          fresh[of_a ? a : b].insert(of_a ? 0.5 * (a0 + a1) : 0.5 * (b0 + b1));
          any = true;
        }
        ++(first ? i : j);
      }
    }
  }
  for (std::size_t node = 0; node < columns.size(); ++node) {
    columns[node].insert(columns[node].end(), fresh[node].begin(), fresh[node].end());
    std::sort(columns[node].begin(), columns[node].end());
  }
  return any;
}

}  // namespace

std::size_t level_at(const std::vector<double>& column, double y) {
  return std::size_t(std::lower_bound(column.begin(), column.end(), y - same_end) - column.begin());
}

double section_bound(const std::vector<double>& ends, double edge, double layer) {
  const std::vector<double> all = with_middle(ends);
  double rise = 0.0;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const Layers layers = layers_of(all[i + 1] - all[i], layer);
    rise = std::max(rise, (layers.level ? 1.0 : stagger) * layers.thickness);
  }
  return std::sqrt(edge * edge - rise * rise);
}

FillColumns make_columns(const FillSection& section, double edge, double layer) {
  std::vector<std::vector<double>> ends(section.nodes.size());
  for (const auto& triangle : section.triangles)
    for (const std::int32_t node : triangle.nodes)
      ends[std::size_t(node)].insert(ends[std::size_t(node)].end(), {triangle.y0, triangle.y1});
  double thickest = 0.0;
  for (auto& of_node : ends) {
    of_node = with_middle(of_node);
    thickest = std::max(thickest, staggered_layer(of_node, layer));
  }
  const std::vector<int> colour = Colouring(section, edge, thickest).colour;
  FillColumns columns;
  for (std::size_t node = 0; node < ends.size(); ++node) columns.push_back(column(ends[node], layer, colour[node]));
  const Ranges ranges = ranges_of(section);
  while (halve_steps(section, ranges, (1.0 + 1e-9) * edge, 0.1 * layer, columns)) {
  }
  return columns;
}

}  // namespace voussoir
