#include "solver/step/critical_step.h"

#include "solver/modal/stiffness.h"

namespace voussoir {

namespace {

/// A start with every direction in it, the same on every machine.
Eigen::VectorXd scattered(Eigen::Index n) {
  Eigen::VectorXd x(n);
  std::uint64_t s = 0x9e3779b97f4a7c15ULL;
  for (Eigen::Index i = 0; i < n; ++i) {
    s ^= s << 13, s ^= s >> 7, s ^= s << 17;
    x[i] = double(s >> 11) / 9007199254740992.0 - 0.5;
  }
  return x;
}

void name_the_fastest(const Model& model, const State& state, const Unknowns& unknowns, const Eigen::VectorXd& x,
                      CriticalStep& result) {
  double most = -1.0;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Vector6 part = part_of(x, unknowns, i);
    const double energy = part.dot(body_mass(model, state, i) * part);
    if (energy > most) most = energy, result.body = std::int32_t(i);
  }
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i) {
    const double energy = model.fill.inertial[i] * part_of(x, unknowns, model.bodies.size() + i).squaredNorm();
    if (energy > most) most = energy, result.node = model.fill.mesh_node[i];
  }
  double stiffest = -1.0;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Patch& patch = model.joints[i];
    if (patch.a != result.body && patch.b != result.body) continue;
    const double k = patch_stiffness(model, state, i, PatchTangent::intact).trace();
    if (k > stiffest) stiffest = k, result.patch = std::int64_t(i);
  }
}

}  // namespace

CriticalStep critical_step(const Model& model, const State& state) {
  return critical_step(model, state, number_unknowns(model));
}

CriticalStep critical_step(const Model& model, const State& state, const Unknowns& unknowns) {
  CriticalStep result;
  const SparseMatrix k = assemble_stiffness(model, state, unknowns, PatchTangent::intact);
  Eigen::VectorXd x = scattered(unknowns.count);
  double lambda = 0.0, ten_ago = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd kx = k.selfadjointView<Eigen::Lower>() * x;
    const Eigen::VectorXd y = divide_by_mass(model, state, unknowns, kx);
    const double work = y.dot(kx), before = x.dot(kx);
    if (!(before > 0.0)) break;  // nothing but zero modes: no joints at all
    lambda = work / before;
    x = y / y.norm();
    if (i % 10 == 9) {
      if (lambda < ten_ago * (1.0 + 1e-4)) break;
      ten_ago = lambda;
    }
  }
  if (lambda <= 0.0) return result;
  result.highest = std::sqrt(lambda);
  result.step = 2.0 / result.highest;
  name_the_fastest(model, state, unknowns, x, result);
  return result;
}

}  // namespace voussoir
