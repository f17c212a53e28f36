#include "solver/linear/fill_stiffness.h"

#include <algorithm>

#include "solver/contact/interface_jump.h"

namespace voussoir {

namespace {

std::int32_t site_of(const Model& model, std::int32_t node) {
  return std::int32_t(model.bodies.size()) + node;
}

Matrix6 of_node(const Mat3& block) {
  Matrix6 m = Matrix6::Zero();
  m.topLeftCorner<3, 3>() = block;
  return m;
}

FillElement element(const FillModel& fill, const Array<double>& pose, std::size_t batch, int lane) {
  const TetShape shape = tet_shape(fill, batch, lane);
  const FillLaw& law = fill.law_of(batch);
  FillElement e;
  e.nodes = shape.nodes;
  e.volume = shape.volume;
  e.bulk = law.bulk, e.shear = law.shear;
  Mat3 f = Mat3::Identity();
  for (std::size_t k = 0; k < 4; ++k)
    f += Vec3(&pose[node_width * std::size_t(e.nodes[k])]) * shape.gradient[k].transpose();
  const Mat3 turn = f.inverse().transpose();
  for (std::size_t k = 0; k < 4; ++k) e.gradient[k] = turn * shape.gradient[k];
  return e;
}

std::vector<FillElement> elements_of(const Model& model, const State& state) {
  const FillModel& fill = model.fill;
  std::vector<FillElement> elements;
  for (std::size_t b = 0; b < fill.batches.size(); ++b) {
    if (fill.law_of(b).bulk <= 0.0) continue;  // not there yet, while a bridge is built
    for (int lane = 0; lane < fill.batches[b].count; ++lane)
      elements.push_back(element(fill, state.fill.pose, b, lane));
  }
  return elements;
}

}  // namespace

Mat3 shear_block(const Vec3& gi, const Vec3& gj) {
  return gi.dot(gj) * Mat3::Identity() + gj * gi.transpose() - (2.0 / 3.0) * gi * gj.transpose();
}

std::vector<FillRing> fill_rings(const std::vector<FillElement>& elements, std::size_t nodes) {
  std::vector<std::vector<std::pair<std::int32_t, Vec3>>> parts(nodes);
  std::vector<FillRing> rings(nodes);
  for (const FillElement& e : elements)
    for (const std::int32_t about : e.nodes) {
      rings[std::size_t(about)].weight += e.bulk * e.volume;
      for (std::size_t k = 0; k < 4; ++k)
        parts[std::size_t(about)].emplace_back(e.nodes[k], e.bulk * e.volume * e.gradient[k]);
    }
  for (std::size_t i = 0; i < nodes; ++i) {
    std::stable_sort(parts[i].begin(), parts[i].end(), [](const auto& p, const auto& q) { return p.first < q.first; });
    for (const auto& [node, pull] : parts[i]) {
      if (rings[i].nodes.empty() || rings[i].nodes.back() != node)
        rings[i].nodes.push_back(node), rings[i].pull.push_back(Vec3::Zero());
      rings[i].pull.back() += pull;
    }
  }
  return rings;
}

InterfaceStiffness interface_stiffness(const std::array<std::array<Mat3, 3>, 3>& corners,
                                       const std::array<Vec3, 3>& reach) {
  InterfaceStiffness k;
  k.corners = corners;
  std::array<Eigen::Matrix<double, 3, 6>, 3> g;
  for (std::size_t i = 0; i < 3; ++i) g[i] << Mat3::Identity(), -skew(reach[i]);
  for (std::size_t i = 0; i < 3; ++i) {
    k.across[i].setZero();
    for (std::size_t j = 0; j < 3; ++j) {
      k.own += g[i].transpose() * corners[i][j] * g[j];
      k.across[i] -= corners[i][j] * g[j];
    }
  }
  return k;
}

void couple_nodes(const std::vector<std::array<std::int32_t, 4>>& elements, std::size_t nodes, std::int32_t first,
                  SitePairs& coupled) {
  std::vector<std::vector<std::int32_t>> rings(nodes);
  for (const auto& corners : elements)
    for (const std::int32_t about : corners)
      for (const std::int32_t corner : corners) rings[std::size_t(about)].push_back(corner);
  std::vector<std::vector<std::int32_t>> partners(nodes);  // higher ones, of each node
  for (std::vector<std::int32_t>& ring : rings) {
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    for (std::size_t i = 0; i < ring.size(); ++i)
      for (std::size_t j = i + 1; j < ring.size(); ++j) partners[std::size_t(ring[i])].push_back(ring[j]);
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    std::sort(partners[i].begin(), partners[i].end());
    partners[i].erase(std::unique(partners[i].begin(), partners[i].end()), partners[i].end());
    for (const std::int32_t j : partners[i]) coupled.emplace_back(first + std::int32_t(i), first + j);
  }
}

void couple_fill(const Model& model, const State& state, SitePairs& coupled) {
  if (model.fill.empty()) return;
  std::vector<std::array<std::int32_t, 4>> elements;
  for (const TetBatch& b : model.fill.batches)
    for (int lane = 0; lane < b.count; ++lane)
      elements.push_back({b.node[0][lane], b.node[1][lane], b.node[2][lane], b.node[3][lane]});
  couple_nodes(elements, model.fill.nodes.size(), site_of(model, 0), coupled);
  for (std::size_t i = 0; i < state.interface.patches.size(); ++i)
    if (state.interface.used(i))
      for (const std::int32_t node : state.interface.patches[i].node)
        coupled.emplace_back(state.interface.patches[i].body, site_of(model, node));
}

void add_fill(const Model& model, const State& state, BlockMatrix& k) {
  if (model.fill.empty()) return;
  const std::vector<FillElement> elements = elements_of(model, state);
  for (const FillElement& e : elements)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        k.add(site_of(model, e.nodes[i]), site_of(model, e.nodes[j]),
              of_node(e.volume * e.shear * shear_block(e.gradient[i], e.gradient[j])));
  // ½ Σ_a K_a θ_a², K_a = ¼ Σ κ V, K_a θ_a = ¼ Σ κ V θ
  for (const FillRing& ring : fill_rings(elements, model.fill.nodes.size()))
    for (std::size_t i = 0; i < ring.nodes.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        k.add(site_of(model, ring.nodes[i]), site_of(model, ring.nodes[j]),
              of_node(ring.pull[i] * ring.pull[j].transpose() / (4.0 * ring.weight)));
}

void add_interface(const Model& model, const State& state, PatchTangent kind, BlockMatrix& k) {
  const Interface& interface = state.interface;
  for (std::size_t slot = 0; slot < interface.patches.size(); ++slot) {
    if (!interface.used(slot)) continue;
    const InterfacePatch& patch = interface.patches[slot];
    const InterfaceJump jump = interface_jump(model, state, patch);
    std::array<Vec3, 3> reach;
    for (std::size_t c = 0; c < 3; ++c) reach[c] = jump.at[c] - jump.centroid;
    const Mat3 shape = shape_functions(patch);
    std::array<std::array<Mat3, 3>, 3> sums;
    for (auto& row : sums)
      for (Mat3& sum : row) sum.setZero();
    for (std::size_t p = 0; p < patch.points.size(); ++p) {
      const PatchPoint& point = patch.points[p];
      const Vec3 n = shape * Vec3(1.0, point.s, point.t);
      Mat3 d = Vec3(patch.kn, patch.ks, patch.ks).asDiagonal();
      if (kind == PatchTangent::present) {
        const Vec3 u = jump.point(shape, point.s, point.t);
        const PatchMemory& memory = state.interface_memory;
        const Triple<double> elastic = {u[0] - memory.point_rest[interface.point_index(slot, p, 2, 0)],
                                        u[1] - memory.point[interface.point_index(slot, p, 2, 0)],
                                        u[2] - memory.point[interface.point_index(slot, p, 2, 1)]};
        d = point_tangent(model.laws[std::size_t(patch.law)], patch.kn, patch.ks, elastic,
                          memory.broken[interface.point_index(slot, p, 1, 0)]);
      }
      const Mat3 world = jump.axes * d * jump.axes.transpose();
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          sums[i][j] += point.weight * n[Eigen::Index(i)] * n[Eigen::Index(j)] * world;
    }
    const InterfaceStiffness of = interface_stiffness(sums, reach);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j <= i; ++j)
        k.add(site_of(model, patch.node[i]), site_of(model, patch.node[j]), of_node(of.corners[i][j]));
      Matrix6 across = Matrix6::Zero();
      across.topRows<3>() = of.across[i];
      k.add(site_of(model, patch.node[i]), patch.body, across);
    }
    k.add(patch.body, patch.body, of.own);
  }
}

}  // namespace voussoir
