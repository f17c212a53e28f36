#include "solver/step/critical_step.h"

#include "solver/modal/stiffness.h"

namespace voussoir {

namespace {

/// Six numbers a site; where there is no unknown, zero. A start with every direction in it, the same on every machine.
Eigen::VectorXd scattered(const Unknowns& unknowns) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(6 * unknowns.of.size()));
  std::uint64_t s = 0x9e3779b97f4a7c15ULL;
  for (std::size_t i = 0; i < unknowns.of.size(); ++i)
    for (std::size_t c = 0; c < 6; ++c) {
      if (unknowns.of[i][c] < 0) continue;
      s ^= s << 13, s ^= s >> 7, s ^= s << 17;
      x[Eigen::Index(6 * i + c)] = double(s >> 11) / 9007199254740992.0 - 0.5;
    }
  return x;
}

/// M⁻¹ of each site in world axes.
struct InverseMass {
  double mass = 0.0;            // 1/kg
  Mat3 inertia = Mat3::Zero();  // 1/(kg m2)
};
std::vector<InverseMass> inverse_masses(const Model& model, const State& state) {
  std::vector<InverseMass> inverse(model.sites());
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Mat3 r = rotation_of(state, i).toRotationMatrix();
    inverse[i] = {1.0 / model.bodies[i].inertial_mass, r * model.bodies[i].inverse_inertia * r.transpose()};
  }
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i)
    inverse[model.bodies.size() + i].mass = 1.0 / model.fill.inertial[i];
  return inverse;
}

void name_the_fastest(const Model& model, const State& state, const Eigen::VectorXd& x, CriticalStep& result) {
  double most = -1.0;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Vector6 part = x.segment<6>(Eigen::Index(6 * i));
    const double energy = part.dot(body_mass(model, state, i) * part);
    if (energy > most) most = energy, result.body = std::int32_t(i);
  }
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i) {
    const double energy =
        model.fill.inertial[i] * x.segment<6>(Eigen::Index(6 * (model.bodies.size() + i))).squaredNorm();
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
  BlockMatrix k = stiffness_blocks(model, state, PatchTangent::intact);
  k.hold(unknowns);
  const std::vector<InverseMass> inverse = inverse_masses(model, state);
  Eigen::VectorXd x = scattered(unknowns), kx(x.size());
  double lambda = 0.0, ten_ago = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double before = k.times(x, kx);
    if (!(before > 0.0)) break;  // nothing but zero modes: no joints at all
    double work = 0.0, norm2 = 0.0;
    for (std::size_t site = 0; site < k.sites(); ++site) {
      const auto force = kx.segment<6>(Eigen::Index(6 * site));
      Vector6 y;
      y << inverse[site].mass * force.head<3>(), inverse[site].inertia * force.tail<3>();
      for (std::size_t c = 0; c < 6; ++c)
        if (unknowns.of[site][c] < 0) y[Eigen::Index(c)] = 0.0;
      work += y.dot(force), norm2 += y.squaredNorm();
      x.segment<6>(Eigen::Index(6 * site)) = y;
    }
    lambda = work / before;
    x *= 1.0 / std::sqrt(norm2);
    if (i % 10 == 9) {
      if (lambda < ten_ago * (1.0 + 1e-4)) break;
      ten_ago = lambda;
    }
  }
  if (lambda <= 0.0) return result;
  result.highest = std::sqrt(lambda);
  result.step = 2.0 / result.highest;
  name_the_fastest(model, state, x, result);
  return result;
}

}  // namespace voussoir
