#include "solver/step/local_rates.h"

#include <Eigen/Eigenvalues>

#include "solver/modal/stiffness.h"

namespace voussoir {

namespace {

template <class M>
double largest_eigenvalue(const M& k, const M& m) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<M>(k, m, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

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

}  // namespace

std::vector<LocalRate> local_rates(const Model& model, const State& state) {
  std::vector<LocalRate> rates(model.bodies.size());
  const auto for_moving = [&](const std::vector<Matrix6>& blocks, auto&& act) {
    for (std::size_t i = 0; i < rates.size(); ++i)
      if (!model.bodies[i].still()) act(rates[i], free_part(model.bodies[i], blocks[i]), body_mass(model, state, i));
  };
  for_moving(sums_of_blocks(model, state, [](int, int) { return 1.0; }),
             [](LocalRate& rate, const Matrix6& k, const Matrix6& m) {
               const Mat3 ku = k.topLeftCorner<3, 3>(), mu = m.topLeftCorner<3, 3>();
               rate.displacement = largest_eigenvalue(ku, mu);
               rate.own = largest_eigenvalue(k, m);
             });
  const auto weight = [&](std::int32_t body, std::int32_t other) {
    const double own = rates[std::size_t(body)].own;
    return own > 0.0 ? 1.0 + rates[std::size_t(other)].own / own : 1.0;
  };
  for_moving(sums_of_blocks(model, state, weight),
             [](LocalRate& rate, const Matrix6& k, const Matrix6& m) { rate.bound = largest_eigenvalue(k, m); });
  return rates;
}

double step_at(double rate) {
  return rate > 0.0 ? 2.0 / std::sqrt(rate) : 0.0;
}

}  // namespace voussoir
