#include "solver/step/local_rates.h"

#include <Eigen/Dense>

#include "solver/linear/dense_eigen.h"
#include "solver/linear/stiffness.h"

namespace voussoir {

namespace {

/// Without the ways that a guide holds.
Matrix6 free_part(const Body& body, Matrix6 k) {
  for (int c = 0; c < 6; ++c)
    if (body.held(c)) k.row(c).setZero(), k.col(c).setZero();
  return k;
}

/// Σ over each body's patches of weight(body, other) × its diagonal block.
template <class F>
std::vector<Matrix6> sums_of_blocks(const Model& model, const State& state, F weight) {
  std::vector<Matrix6> sums(model.bodies.size(), Matrix6::Zero());
  const std::size_t joints = model.joints.size();
  for (std::size_t i = 0; i < joints + state.contacts.size(); ++i) {
    const Patch& patch = i < joints ? model.joints[i] : state.contacts[i - joints];
    const auto [a, b] = own_stiffness(model, state, i, PatchTangent::intact);
    sums[std::size_t(patch.a)] += weight(patch.a, patch.b) * a;
    sums[std::size_t(patch.b)] += weight(patch.b, patch.a) * b;
  }
  return sums;
}

/// Rates of the nodes of the fill, and the contribution of the interface to the blocks of the bodies in addition to
/// `joints`; empty without a fill. The strain of a patch with the fill is the motion of the stone minus that of the
/// nodes; with c = 1 both count twice.
std::vector<Matrix6> fill_rates(const Model& model, const State& state, const std::vector<Matrix6>& joints,
                                std::vector<LocalRate>& rates) {
  if (model.fill.empty()) return {};
  const std::size_t bodies = model.bodies.size();
  const BlockMatrix k = stiffness_blocks(model, state, PatchTangent::intact);
  std::vector<double> rows(model.sites(), 0.0);
  std::vector<char> touches(model.sites(), 0);
  k.for_each([&](std::int32_t row, std::int32_t column, const Matrix6& block) {
    if (row == column) return;
    const double size = std::size_t(column) < bodies ? 0.0 : block.norm();
    rows[std::size_t(row)] += size, rows[std::size_t(column)] += size;
    touches[std::size_t(row)] |= std::size_t(column) < bodies;
  });
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i) {
    if (model.fill.held[i] == 7) continue;
    const std::size_t site = bodies + i;
    const Mat3 own = k.diagonal(std::int32_t(site)).topLeftCorner<3, 3>();
    const double largest = largest_eigenvalue(own);
    LocalRate& rate = rates[site];
    rate.displacement = rate.own = largest / model.fill.inertial[i];
    rate.bound = (touches[site] ? 2.0 : 1.0) * (largest + rows[site]) / model.fill.inertial[i];
  }
  std::vector<Matrix6> interface(bodies);
  for (std::size_t i = 0; i < bodies; ++i) interface[i] = k.diagonal(std::int32_t(i)) - joints[i];
  return interface;
}

}  // namespace

std::vector<LocalRate> local_rates(const Model& model, const State& state) {
  std::vector<LocalRate> rates(model.sites());
  const auto for_moving = [&](const std::vector<Matrix6>& blocks, auto&& act) {
    for (std::size_t i = 0; i < model.bodies.size(); ++i)
      if (!model.bodies[i].still()) act(rates[i], free_part(model.bodies[i], blocks[i]), body_mass(model, state, i));
  };
  std::vector<Matrix6> own = sums_of_blocks(model, state, [](int, int) { return 1.0; });
  const std::vector<Matrix6> interface = fill_rates(model, state, own, rates);
  for (std::size_t i = 0; i < interface.size(); ++i) own[i] += interface[i];
  for_moving(own, [](LocalRate& rate, const Matrix6& k, const Matrix6& m) {
    const Mat3 ku = k.topLeftCorner<3, 3>(), mu = m.topLeftCorner<3, 3>();
    rate.displacement = largest_eigenvalue(ku, mu);
    rate.own = largest_eigenvalue(k, m);
  });
  const auto weight = [&](std::int32_t body, std::int32_t other) {
    const double rate = rates[std::size_t(body)].own;
    return rate > 0.0 ? 1.0 + rates[std::size_t(other)].own / rate : 1.0;
  };
  std::vector<Matrix6> bound = sums_of_blocks(model, state, weight);
  for (std::size_t i = 0; i < interface.size(); ++i) bound[i] += 2.0 * interface[i];
  for_moving(bound, [](LocalRate& rate, const Matrix6& k, const Matrix6& m) { rate.bound = largest_eigenvalue(k, m); });
  return rates;
}

double step_at(double rate) {
  return rate > 0.0 ? 2.0 / std::sqrt(rate) : 0.0;
}

}  // namespace voussoir
