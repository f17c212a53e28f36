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

/// A tetrahedron where it is: gradients of the shape functions in the present placement, reference volume.
struct Element {
  std::array<std::int32_t, 4> nodes = {};
  std::array<Vec3, 4> gradient;  // 1/m
  double volume = 0.0;           // m3
  const FillLaw* law = nullptr;
};

Element element(const FillModel& fill, const Array<double>& pose, std::size_t batch, int lane) {
  const TetShape shape = tet_shape(fill, batch, lane);
  Element e;
  e.nodes = shape.nodes;
  e.volume = shape.volume;
  e.law = &fill.law_of(batch);
  Mat3 f = Mat3::Identity();
  for (std::size_t k = 0; k < 4; ++k)
    f += Vec3(&pose[node_width * std::size_t(e.nodes[k])]) * shape.gradient[k].transpose();
  const Mat3 turn = f.inverse().transpose();
  for (std::size_t k = 0; k < 4; ++k) e.gradient[k] = turn * shape.gradient[k];
  return e;
}

template <class Use>
void each_element(const Model& model, const State& state, const Use& use) {
  const FillModel& fill = model.fill;
  for (std::size_t b = 0; b < fill.batches.size(); ++b)
    for (int lane = 0; lane < fill.batches[b].count; ++lane) use(element(fill, state.fill.pose, b, lane));
}

/// Elements about each node, and what they add to κ V ∇N of the nodes of its ring.
struct Ring {
  std::vector<std::int32_t> nodes;  // ascending
  std::vector<Vec3> pull;           // N: Σ κ V ∇N
};

std::vector<Ring> rings_of(const Model& model, const State& state) {
  std::vector<std::vector<std::pair<std::int32_t, Vec3>>> parts(model.fill.nodes.size());
  each_element(model, state, [&](const Element& e) {
    for (const std::int32_t about : e.nodes)
      for (std::size_t k = 0; k < 4; ++k)
        parts[std::size_t(about)].emplace_back(e.nodes[k], e.law->bulk * e.volume * e.gradient[k]);
  });
  std::vector<Ring> rings(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::stable_sort(parts[i].begin(), parts[i].end(), [](const auto& p, const auto& q) { return p.first < q.first; });
    for (const auto& [node, pull] : parts[i]) {
      if (rings[i].nodes.empty() || rings[i].nodes.back() != node)
        rings[i].nodes.push_back(node), rings[i].pull.push_back(Vec3::Zero());
      rings[i].pull.back() += pull;
    }
  }
  return rings;
}

}  // namespace

void couple_fill(const Model& model, const State& state, std::vector<std::pair<std::int32_t, std::int32_t>>& coupled) {
  if (model.fill.empty()) return;
  std::vector<std::vector<std::int32_t>> rings(model.fill.nodes.size());
  for (const TetBatch& b : model.fill.batches)
    for (int lane = 0; lane < b.count; ++lane)
      for (const auto& about : b.node)
        for (const auto& corner : b.node) rings[std::size_t(about[lane])].push_back(corner[lane]);
  std::vector<std::vector<std::int32_t>> partners(rings.size());  // higher ones, of each node
  for (std::vector<std::int32_t>& ring : rings) {
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    for (std::size_t i = 0; i < ring.size(); ++i)
      for (std::size_t j = i + 1; j < ring.size(); ++j) partners[std::size_t(ring[i])].push_back(ring[j]);
  }
  for (std::size_t i = 0; i < partners.size(); ++i) {
    std::sort(partners[i].begin(), partners[i].end());
    partners[i].erase(std::unique(partners[i].begin(), partners[i].end()), partners[i].end());
    for (const std::int32_t j : partners[i]) coupled.emplace_back(site_of(model, std::int32_t(i)), site_of(model, j));
  }
  for (std::size_t i = 0; i < state.interface.patches.size(); ++i)
    if (state.interface.used(i))
      for (const std::int32_t node : state.interface.patches[i].node)
        coupled.emplace_back(state.interface.patches[i].body, site_of(model, node));
}

void add_fill(const Model& model, const State& state, BlockMatrix& k) {
  if (model.fill.empty()) return;
  // 2 μ e:e: V μ (g_i · g_j 1 + g_j g_iᵀ − ⅔ g_i g_jᵀ)
  each_element(model, state, [&](const Element& e) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        const Vec3 &gi = e.gradient[i], &gj = e.gradient[j];
        const Mat3 block = e.volume * e.law->shear *
                           (gi.dot(gj) * Mat3::Identity() + gj * gi.transpose() - (2.0 / 3.0) * gi * gj.transpose());
        k.add(site_of(model, e.nodes[i]), site_of(model, e.nodes[j]), of_node(block));
      }
  });
  // ½ Σ_a K_a θ_a², K_a = ¼ Σ κ V, K_a θ_a = ¼ Σ κ V θ
  const std::vector<Ring> rings = rings_of(model, state);
  for (std::size_t a = 0; a < rings.size(); ++a)
    for (std::size_t i = 0; i < rings[a].nodes.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j)
        k.add(site_of(model, rings[a].nodes[i]), site_of(model, rings[a].nodes[j]),
              of_node(rings[a].pull[i] * rings[a].pull[j].transpose() / (4.0 * model.fill.weight[a])));
}

void add_interface(const Model& model, const State& state, PatchTangent kind, BlockMatrix& k) {
  const Interface& interface = state.interface;
  for (std::size_t slot = 0; slot < interface.patches.size(); ++slot) {
    if (!interface.used(slot)) continue;
    const InterfacePatch& patch = interface.patches[slot];
    const InterfaceJump jump = interface_jump(model, state, patch);
    std::array<Vec3, 3> reach;  // m, of the corners from the stone's centroid
    for (std::size_t c = 0; c < 3; ++c) reach[c] = jump.at[c] - jump.centroid;
    const Mat3 shape = shape_functions(patch);
    Mat3 sums[3][3];  // Σ w N_i N_j D, world axes
    for (auto& row : sums)
      for (Mat3& sum : row) sum.setZero();
    for (std::size_t p = 0; p < patch.points.size(); ++p) {
      const PatchPoint& point = patch.points[p];
      const Vec3 n = shape * Vec3(1.0, point.s, point.t);
      Mat3 d = Vec3(patch.kn, patch.ks, patch.ks).asDiagonal();
      if (kind == PatchTangent::present) {
        const Vec3 u = jump.point(shape, point.s, point.t);
        const PatchMemory& memory = state.interface_memory;
        const Triple<double> elastic = {u[0], u[1] - memory.point[interface.point_index(slot, p, 2, 0)],
                                        u[2] - memory.point[interface.point_index(slot, p, 2, 1)]};
        d = point_tangent(model.laws[std::size_t(patch.law)], patch.kn, patch.ks, elastic,
                          memory.broken[interface.point_index(slot, p, 1, 0)]);
      }
      const Mat3 world = jump.axes * d * jump.axes.transpose();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) sums[i][j] += point.weight * n[i] * n[j] * world;
    }
    // δ of corner i: δu_i − δu_a − δθ × r_i = δu_i − G_i δ_a with G_i = (1, −[r_i]×)
    Matrix6 own = Matrix6::Zero();
    for (int i = 0; i < 3; ++i) {
      Eigen::Matrix<double, 3, 6> gi;
      gi << Mat3::Identity(), -skew(reach[std::size_t(i)]);
      Matrix6 across = Matrix6::Zero();
      for (int j = 0; j < 3; ++j) {
        Eigen::Matrix<double, 3, 6> gj;
        gj << Mat3::Identity(), -skew(reach[std::size_t(j)]);
        own += gi.transpose() * sums[i][j] * gj;
        across.topRows<3>() -= sums[i][j] * gj;
        if (j <= i) k.add(site_of(model, patch.node[i]), site_of(model, patch.node[j]), of_node(sums[i][j]));
      }
      k.add(site_of(model, patch.node[i]), patch.body, across);
    }
    k.add(patch.body, patch.body, own);
  }
}

}  // namespace voussoir
