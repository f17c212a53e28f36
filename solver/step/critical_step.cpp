#include "solver/step/critical_step.h"

#include "solver/base/error.h"
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
  CriticalStep result;
  const Unknowns unknowns = number_unknowns(model);
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

MassScaling scale_mass(Model& model, const State& state, double step, double limit) {
  MassScaling scaling;
  double total = 0.0, added = 0.0;
  std::vector<double> translation(model.bodies.size(), 0.0);  // N/m, bound on the body's own stiffness
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Patch& p = model.joints[i];
    const double k = p.area * std::max(p.kn, p.ks);
    translation[p.a] += k;
    translation[p.b] += k;
  }
  for (const Body& body : model.bodies)
    if (!body.fixed) total += body.mass;
  for (int round = 0; round < 40; ++round) {
    const CriticalStep critical = critical_step(model, state);
    if (critical.step >= step || critical.body < 0) break;
    // All bodies about as stiff for their mass as the one that sets the step are raised together.
    const Body& worst = model.bodies[critical.body];
    const double rate = 0.9 * translation[critical.body] / worst.inertial_mass;
    const double factor = std::min(2.0, std::pow(step / critical.step, 2) * 1.02);
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      Body& body = model.bodies[i];
      if (body.fixed || translation[i] / body.inertial_mass < rate) continue;
      if (body.inertial_mass == body.mass) ++scaling.bodies;
      added += (factor - 1.0) * body.inertial_mass;
      body.inertial_mass *= factor;
      body.inertia *= factor;
      body.inverse_inertia /= factor;
    }
    scaling.share = added / total;
    if (scaling.share > limit)
      throw InputError(
          "mass scaling to a step of {:.3g} s would add {:.2f} % of the mass, more than mass_scaling_limit = {:.2f} %; "
          "lower mass_scaling_step or raise the limit",
          step, 100 * scaling.share, 100 * limit);
  }
  return scaling;
}

}  // namespace voussoir
