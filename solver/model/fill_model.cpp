#include "solver/model/fill_model.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "geometry/curve.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

using Corners = std::array<std::int32_t, 4>;

void order_nodes(const FillMesh& mesh, FillModel& fill) {
  fill.mesh_node = along_curve(mesh.nodes);
  fill.node_of.resize(mesh.nodes.size());
  for (std::size_t i = 0; i < fill.mesh_node.size(); ++i) {
    fill.node_of[std::size_t(fill.mesh_node[i])] = std::int32_t(i);
    const Vec3& at = fill.nodes.emplace_back(mesh.nodes[std::size_t(fill.mesh_node[i])]);
    fill.place.insert(fill.place.end(), {at.x(), at.y(), at.z(), 0.0});
  }
}

/// A tetrahedron with its corners turned so that the lowest node in the order comes first.
struct Element {
  std::int32_t law = 0;
  Corners nodes = {};
  std::int32_t tet = 0;
  std::int32_t tile() const { return nodes[0] / tile_nodes; }
};

/// Even permutations only: they keep the volume's sign.
Corners lowest_first(const Corners& n) {
  const auto lowest = std::min_element(n.begin(), n.end()) - n.begin();
  constexpr int turned[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
  Corners r;
  for (std::size_t i = 0; i < 4; ++i) r[i] = n[std::size_t(turned[lowest][i])];
  return r;
}

std::vector<Element> order_elements(const Assembly& assembly, const std::vector<std::int32_t>& steps, FillModel& fill) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> law_of;  // of a step and the assembly's materials
  std::vector<Element> elements;
  for (std::size_t i = 0; i < assembly.fill.tets.size(); ++i) {
    const std::int32_t material = assembly.fill.material[i];
    const std::int32_t step = steps.empty() ? 0 : steps[i];
    const auto [at, fresh] = law_of.try_emplace(std::pair(step, material), std::int32_t(fill.laws.size()));
    if (fresh) {
      fill.laws.push_back(fill_law(assembly.materials.at(std::size_t(material))));
      fill.step_of_law.push_back(step);
    }
    Corners nodes;
    for (std::size_t k = 0; k < 4; ++k) nodes[k] = fill.node_of[std::size_t(assembly.fill.tets[i][k])];
    elements.push_back({at->second, lowest_first(nodes), std::int32_t(i)});
  }
  std::sort(elements.begin(), elements.end(), [](const Element& p, const Element& q) {
    return std::tuple(p.tile(), p.law, p.nodes, p.tet) < std::tuple(q.tile(), q.law, q.nodes, q.tet);
  });
  return elements;
}

void fill_lane(const FillModel& fill, const Element& element, int lane, TetBatch& batch) {
  const auto at = [&](int k) { return fill.nodes[std::size_t(element.nodes[std::size_t(k)])]; };
  const double volume = (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6.0;
  if (!(volume > 0.0))
    throw InputError(
        "tetrahedron {} of the fill, at ({:.3f}, {:.3f}, {:.3f}) m, has a volume of {:.3g} m3. It must be above 0. "
        "Generate a new mesh of the fill.",
        element.tet, at(0).x(), at(0).y(), at(0).z(), volume);
  for (int k = 0; k < 4; ++k) batch.node[k][lane] = element.nodes[std::size_t(k)];
}

/// A lane takes elements one after the other from its own part of the list: those side by side seldom share nodes, and
/// additions to one node do not wait for each other. Lists are short, so that elements near each other share batches
/// that follow each other: their nodes are in the cache, and they often flow together.
constexpr std::size_t longest_list = 64;
void add_batches(const std::vector<Element>& elements, std::size_t first, std::size_t end, FillModel& fill) {
  const std::size_t all = end - first, batches = (all + lane_count - 1) / lane_count;
  const std::size_t longer = all - lane_count * (batches - 1);  // lanes that are at work in the last batch, too
  for (std::size_t b = 0; b < batches; ++b) {
    TetBatch batch{};
    batch.law = elements[first].law;
    batch.count = std::int32_t(b + 1 < batches ? std::size_t(lane_count) : longer);
    for (int lane = 0; lane < lane_count; ++lane) {
      const bool spare = lane >= batch.count;
      const auto at = std::size_t(spare ? batch.count - 1 : lane);
      const Element& element = elements[first + at * batches - (at > longer ? at - longer : 0) + b];
      fill_lane(fill, element, lane, batch);
      if (!spare) fill.lane_of_tet[std::size_t(element.tet)] = std::int32_t(fill.tet_of_lane.size());
      fill.tet_of_lane.push_back(spare ? -1 : element.tet);
    }
    fill.batches.push_back(batch);
  }
}

/// Nodes of later tiles that batches from the tile's first on touch, each once and in order.
std::vector<std::int32_t> nodes_beyond(const FillModel& fill, const FillTile& tile) {
  std::vector<std::int32_t> nodes;
  for (std::int32_t b = tile.first_batch; b < tile.end_batch; ++b)
    for (const auto& corner : fill.batches[std::size_t(b)].node)
      for (const std::int32_t node : corner)
        if (node >= tile.end_node) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void place_sums(TetBatch& batch, const FillTile& tile, const std::vector<std::int32_t>& beyond) {
  for (int k = 0; k < 4; ++k)
    for (int lane = 0; lane < lane_count; ++lane) {
      const std::int32_t node = batch.node[k][lane];
      const auto at = std::lower_bound(beyond.begin(), beyond.end(), node) - beyond.begin();
      batch.sum[k][lane] = node < tile.end_node ? tile.first_sum + node - tile.first_node
                                                : tile.first_sum + tile.end_node - tile.first_node + std::int32_t(at);
    }
}

void make_tiles(const std::vector<Element>& elements, FillModel& fill) {
  const auto nodes = std::int32_t(fill.nodes.size());
  std::vector<std::vector<std::int32_t>> sums_of(fill.nodes.size());
  std::size_t element = 0;
  std::int32_t sum = 0;
  for (std::int32_t first = 0; first < nodes; first += tile_nodes) {
    FillTile tile;
    tile.first_node = first, tile.end_node = std::min(nodes, first + tile_nodes);
    tile.first_batch = std::int32_t(fill.batches.size());
    while (element < elements.size() && elements[element].tile() == first / tile_nodes) {
      std::size_t end = element + 1;
      while (end < elements.size() && elements[end].tile() == elements[element].tile() &&
             elements[end].law == elements[element].law)
        ++end;
      for (; element < end; element = std::min(end, element + longest_list))
        add_batches(elements, element, std::min(end, element + longest_list), fill);
    }
    tile.end_batch = std::int32_t(fill.batches.size());
    const std::vector<std::int32_t> beyond = nodes_beyond(fill, tile);
    tile.first_sum = sum;
    for (std::int32_t b = tile.first_batch; b < tile.end_batch; ++b)
      place_sums(fill.batches[std::size_t(b)], tile, beyond);
    for (std::int32_t node = first; node < tile.end_node; ++node) sums_of[std::size_t(node)].push_back(sum++);
    for (const std::int32_t node : beyond) {
      sums_of[std::size_t(node)].push_back(sum++);
      if (tile.followers.empty() || tile.followers.back() != node / tile_nodes)
        tile.followers.push_back(node / tile_nodes);
    }
    tile.end_sum = sum;
    fill.tiles.push_back(std::move(tile));
  }
  for (const std::vector<std::int32_t>& places : sums_of) {
    fill.first_sum.push_back(std::int32_t(fill.sums.size()));
    fill.sums.insert(fill.sums.end(), places.begin(), places.end());
  }
  fill.first_sum.push_back(std::int32_t(fill.sums.size()));
}

}  // namespace

namespace {

void note_shapes(FillModel& fill) {
  fill.shapes.assign(shape_rows * lane_count * fill.batches.size(), 0.0f);
  for (std::size_t b = 0; b < fill.batches.size(); ++b)
    for (int lane = 0; lane < lane_count; ++lane) {
      const TetShape shape = tet_shape(fill, b, lane);
      float* const column = &fill.shapes[shape_rows * lane_count * b + std::size_t(lane)];
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < 3; ++c)
          column[lane_count * (3 * k + c)] = float(shape.gradient[k + 1][Eigen::Index(c)]);
      column[lane_count * 9] = float(shape.volume);
    }
}

}  // namespace

/// A quarter of each tetrahedron's mass, and its κ V, to each of its nodes.
void lump(FillModel& fill) {
  fill.mass.assign(fill.nodes.size(), 0.0);
  fill.weight.assign(fill.nodes.size(), 0.0);
  for (std::size_t b = 0; b < fill.batches.size(); ++b) {
    const TetBatch& batch = fill.batches[b];
    const FillLaw& law = fill.law_of(b);
    for (int lane = 0; lane < batch.count; ++lane) {
      const TetShape shape = tet_shape(fill, b, lane);
      for (const std::int32_t node : shape.nodes) {
        fill.mass[std::size_t(node)] += 0.25 * law.density * shape.volume;
        fill.weight[std::size_t(node)] += law.bulk * shape.volume;
      }
    }
  }
  fill.held.assign(fill.nodes.size(), 0);
  for (std::size_t i = 0; i < fill.nodes.size(); ++i)
    if (!(fill.weight[i] > 0.0)) fill.held[i] = 7, fill.weight[i] = 1.0;
  fill.inertial = fill.mass;
}

TetShape tet_shape(const std::array<std::int32_t, 4>& corners, const std::vector<Vec3>& nodes) {
  TetShape shape;
  shape.nodes = corners;
  const Vec3& first = nodes[std::size_t(corners[0])];
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = nodes[std::size_t(corners[std::size_t(k) + 1])] - first;
  shape.volume = edges.determinant() / 6.0;
  const Mat3 inverse = edges.inverse();  // its rows are the gradients of corners 1 to 3
  shape.gradient[0] = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    shape.gradient[std::size_t(k) + 1] = inverse.row(k);
    shape.gradient[0] -= shape.gradient[std::size_t(k) + 1];
  }
  return shape;
}

TetShape tet_shape(const FillModel& fill, std::size_t batch, int lane) {
  std::array<std::int32_t, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = fill.batches[batch].node[k][lane];
  return tet_shape(corners, fill.nodes);
}

FillModel build_fill(const Assembly& assembly, const std::vector<std::int32_t>& steps) {
  FillModel fill;
  if (assembly.fill.empty()) return fill;
  order_nodes(assembly.fill, fill);
  const std::vector<Element> elements = order_elements(assembly, steps, fill);
  fill.lane_of_tet.assign(assembly.fill.tets.size(), -1);
  make_tiles(elements, fill);
  note_shapes(fill);
  lump(fill);
  for (const auto& corners : assembly.fill.triangles)
    fill.triangles.push_back({fill.node_of[std::size_t(corners[0])], fill.node_of[std::size_t(corners[1])],
                              fill.node_of[std::size_t(corners[2])]});
  for (std::size_t i = 0; i < fill.nodes.size(); ++i)
    if (!(fill.mass[i] > 0.0))
      throw InputError("node {} of the fill belongs to no tetrahedron. Remove it from the mesh.", fill.mesh_node[i]);
  return fill;
}

}  // namespace voussoir
