#include "geometry/fill_sweep.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/fill_mesh.h"

namespace voussoir {

namespace {

/// The order in which columns step up, from the lowest step to the highest: by where the middle of a step lies. So the
/// shorter diagonal is taken between two columns, and triangles side by side agree on it. Steps at one height go by the
/// number of the column, by turns up and down from y = 0 outwards, on one side the mirror image of the other.
class Order {
 public:
  explicit Order(const FillColumns& columns) {
    for (const auto& y : columns)
      for (std::size_t k = 0; k + 1 < y.size(); ++k) middles_.push_back(std::abs(middle(y, k)));
    std::sort(middles_.begin(), middles_.end());
    const auto same = [](double a, double b) { return b - a < same_end; };
    middles_.erase(std::unique(middles_.begin(), middles_.end(), same), middles_.end());
  }
  using Key = std::pair<std::ptrdiff_t, std::int32_t>;
  Key key(const std::vector<double>& y, std::size_t step, std::int32_t node) const {
    const double at = middle(y, step);
    const auto rank = std::upper_bound(middles_.begin(), middles_.end(), std::abs(at) + same_end) - middles_.begin();
    const bool above = at > 0.0, turned = (rank % 2 == 1) == above;
    return {above ? rank : -rank, turned ? -node : node};
  }

 private:
  std::vector<double> middles_;
  static double middle(const std::vector<double>& y, std::size_t step) { return 0.5 * (y[step] + y[step + 1]); }
};

/// The nodes of the columns that tetrahedra use, numbered column by column.
class Nodes {
 public:
  Nodes(const FillSection& section, const FillColumns& columns) : section_(section), columns_(columns) {
    for (const auto& y : columns) number_.emplace_back(y.size(), -1);
  }
  void need(std::int32_t node, std::size_t level) { number_[std::size_t(node)][level] = 0; }
  void make(FillMesh& mesh) {
    for (std::size_t node = 0; node < number_.size(); ++node)
      for (std::size_t level = 0; level < number_[node].size(); ++level) {
        if (number_[node][level] < 0) continue;
        number_[node][level] = std::int32_t(mesh.nodes.size());
        mesh.nodes.emplace_back(section_.nodes[node].x(), columns_[node][level], section_.nodes[node].z());
      }
  }
  std::int32_t at(std::int32_t node, std::size_t level) const { return number_[std::size_t(node)][level]; }

 private:
  const FillSection& section_;
  const FillColumns& columns_;
  std::vector<std::vector<std::int32_t>> number_;
};

/// Each step of one of the three columns is a tetrahedron with where the others stand.
void sweep_triangle(const FillSection::Triangle& triangle, const FillColumns& columns, const Order& order,
                    const Nodes& nodes, FillMesh& mesh) {
  std::array<std::size_t, 3> level, last;
  const auto column = [&](std::size_t i) -> const std::vector<double>& {
    return columns[std::size_t(triangle.nodes[i])];
  };
  for (std::size_t i = 0; i < 3; ++i)
    level[i] = level_at(column(i), triangle.y0), last[i] = level_at(column(i), triangle.y1);
  while (level != last) {
    std::size_t next = 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto key = [&](std::size_t k) { return order.key(column(k), level[k], triangle.nodes[k]); };
      if (level[i] < last[i] && (next == 3 || key(i) < key(next))) next = i;
    }
    std::array<std::int32_t, 4> tet;
    for (std::size_t i = 0; i < 3; ++i) tet[i] = nodes.at(triangle.nodes[i], level[i]);
    tet[3] = nodes.at(triangle.nodes[next], ++level[next]);
    mesh.tets.push_back(tet);
    mesh.material.push_back(triangle.material);
  }
}

}  // namespace

FillMesh sweep(const FillSection& section, double edge, double layer) {
  const FillColumns columns = make_columns(section, edge, layer);
  Nodes nodes(section, columns);
  for (const auto& triangle : section.triangles)
    for (const std::int32_t node : triangle.nodes) {
      const std::vector<double>& column = columns[std::size_t(node)];
      for (std::size_t k = level_at(column, triangle.y0); k <= level_at(column, triangle.y1); ++k) nodes.need(node, k);
    }
  FillMesh mesh;
  nodes.make(mesh);
  const Order order(columns);
  for (const auto& triangle : section.triangles) sweep_triangle(triangle, columns, order, nodes, mesh);
  orient_tets(mesh);
  find_surface(mesh);
  return mesh;
}

}  // namespace voussoir
