#include "geometry/fill_sweep.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/fill_mesh.h"

namespace voussoir {

namespace {

constexpr double kSame = 1e-6;  // m: ends of parts of the fill that are nearer are one

/// Where layers end, from low to high, and which way their diagonals lean.
struct Layers {
  std::vector<double> y;
  std::vector<char> up;  // of the layer above each y: diagonals rise from the lower to the higher node of the section
};

std::vector<double> ends_of(const FillSection& section) {
  std::vector<double> ends;
  for (const auto& triangle : section.triangles) {
    ends.push_back(triangle.y0);
    ends.push_back(triangle.y1);
  }
  return ends;
}

std::vector<double> distinct(std::vector<double> ends) {
  std::vector<double> out;
  std::sort(ends.begin(), ends.end());
  for (const double y : ends) {
    if (out.empty() || y - out.back() > kSame) out.push_back(y);
  }
  return out;
}

Layers layers_of(const std::vector<double>& all_ends, double thickness) {
  Layers layers;
  const std::vector<double> ends = distinct(all_ends);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double from = ends[i], to = ends[i + 1];
    int n = std::max(1, int(std::ceil((to - from) / thickness - 1e-9)));
    const bool spans_middle = from < -kSame && to > kSame;
    if (spans_middle) n += n % 2;
    const auto at = [&](int k) { return from + k * (to - from) / n; };
    for (int k = 0; k < n; ++k) {
      // Of two levels that mirror one another the second is the first one's, bit for bit.
      const bool mirrors = spans_middle && from == -to && 2 * k >= n;
      layers.y.push_back(!mirrors ? at(k) : 2 * k == n ? 0.0 : -at(n - k));
    }
  }
  layers.y.push_back(ends.back());
  // From the middle outwards the diagonals lean by turns, on one side the mirror image of the other.
  const auto middle = std::lower_bound(layers.y.begin(), layers.y.end(), -kSame) - layers.y.begin();
  for (std::ptrdiff_t k = 0; k + 1 < std::ptrdiff_t(layers.y.size()); ++k) {
    layers.up.push_back(k >= middle ? (k - middle) % 2 == 0 : (middle - 1 - k) % 2 == 1);
  }
  return layers;
}

/// The nodes of the section on each end of a layer, numbered as they are first asked for in order.
class Nodes {
 public:
  Nodes(const FillSection& section, const Layers& layers) : section_(section), layers_(layers) {}

  void need(std::int32_t node, std::size_t level) { number_[{node, level}] = 0; }
  void make(FillMesh& mesh) {
    for (auto& [key, number] : number_) {
      number = std::int32_t(mesh.nodes.size());
      const Vec3& p = section_.nodes[std::size_t(key.first)];
      mesh.nodes.emplace_back(p.x(), layers_.y[key.second], p.z());
    }
  }
  std::int32_t at(std::int32_t node, std::size_t level) const { return number_.at({node, level}); }

 private:
  const FillSection& section_;
  const Layers& layers_;
  std::map<std::pair<std::int32_t, std::size_t>, std::int32_t> number_;
};

/// First and last level of a triangle's part of the fill.
std::pair<std::size_t, std::size_t> levels(const Layers& layers, const FillSection::Triangle& triangle) {
  const auto level = [&](double y) {
    return std::size_t(std::lower_bound(layers.y.begin(), layers.y.end(), y - kSame) - layers.y.begin());
  };
  return {level(triangle.y0), level(triangle.y1)};
}

}  // namespace

double thickest_layer(const std::vector<double>& ends, double layer) {
  const std::vector<double> y = layers_of(ends, layer).y;
  double thickest = 0.0;
  for (std::size_t k = 0; k + 1 < y.size(); ++k) thickest = std::max(thickest, y[k + 1] - y[k]);
  return thickest;
}

FillMesh sweep(const FillSection& section, double layer) {
  const Layers layers = layers_of(ends_of(section), layer);
  Nodes nodes(section, layers);
  for (const auto& triangle : section.triangles) {
    const auto [first, last] = levels(layers, triangle);
    for (std::size_t k = first; k <= last; ++k) {
      for (const std::int32_t node : triangle.nodes) nodes.need(node, k);
    }
  }
  FillMesh mesh;
  nodes.make(mesh);
  for (const auto& triangle : section.triangles) {
    // A diagonal goes from the lower node of an edge to the higher one, whichever triangle looks at it, so that prisms
    // side by side agree (Dompierre, Labbé, Vallet & Camarero 1999).
    auto [a, b, c] = triangle.nodes;
    if (a > b) std::swap(a, b);
    if (b > c) std::swap(b, c);
    if (a > b) std::swap(a, b);
    const auto [first, last] = levels(layers, triangle);
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t low = layers.up[k] ? k : k + 1, high = layers.up[k] ? k + 1 : k;
      const std::int32_t a0 = nodes.at(a, low), b0 = nodes.at(b, low), c0 = nodes.at(c, low);
      const std::int32_t a1 = nodes.at(a, high), b1 = nodes.at(b, high), c1 = nodes.at(c, high);
      mesh.tets.push_back({a0, b0, c0, c1});
      mesh.tets.push_back({a0, b0, b1, c1});
      mesh.tets.push_back({a0, a1, b1, c1});
    }
  }
  mesh.material.assign(mesh.tets.size(), 0);
  orient_tets(mesh);
  find_surface(mesh);
  return mesh;
}

}  // namespace voussoir
