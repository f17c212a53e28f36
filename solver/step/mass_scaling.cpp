#include "solver/step/mass_scaling.h"

#include <Eigen/Dense>

#include "solver/base/error.h"
#include "solver/linear/dense_eigen.h"
#include "solver/linear/eigenpairs.h"
#include "solver/linear/stiffness.h"

namespace voussoir {

namespace {

double factor_on_mass(const LocalRate& rate, double ceiling) {
  return std::max(1.0, rate.displacement / ceiling);
}

/// Of a site, kg; zero of what cannot move.
double moving_mass(const Model& model, std::size_t site) {
  const std::size_t bodies = model.bodies.size();
  if (site < bodies) return model.bodies[site].still() ? 0.0 : model.bodies[site].mass;
  return model.fill.held[site - bodies] == 7 ? 0.0 : model.fill.mass[site - bodies];
}

double share_at(const Model& model, const std::vector<LocalRate>& rates, double ceiling) {
  double added = 0.0, all = 0.0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double mass = moving_mass(model, i);
    added += (factor_on_mass(rates[i], ceiling) - 1.0) * mass, all += mass;
  }
  return added / all;
}

double largest_own(const std::vector<LocalRate>& rates) {
  double largest = 0.0;
  for (const LocalRate& rate : rates) largest = std::max(largest, rate.own);
  return largest;
}

/// The lowest ceiling that adds no more than this share.
double ceiling_of_share(const Model& model, const std::vector<LocalRate>& rates, double limit) {
  double high = largest_own(rates), low = high / (1.0 + limit) / double(1 << 20);
  while (high > (1.0 + 1e-6) * low) {
    const double middle = std::sqrt(low * high);
    (share_at(model, rates, middle) > limit ? low : high) = middle;
  }
  return high;
}

/// A ceiling at which the scaled model's critical step is `step` or up to half a per cent more. ω_max² is nearly
/// proportional to the ceiling, and a quarter of the wanted one is always low enough.
double ceiling_of_step(Model& model, const State& state, const std::vector<LocalRate>& rates, double step) {
  const std::vector<Body> bodies = model.bodies;
  const std::vector<double> inertial = model.fill.inertial;
  const double wanted = 4.0 / (step * step);
  double low = 0.25 * wanted, high = std::max(largest_own(rates), low), ceiling = std::min(high, 0.7 * wanted);
  while (high > 1.001 * low) {
    raise_to(model, rates, ceiling);
    const double rate = std::pow(critical_step(model, state).highest, 2);
    model.bodies = bodies;
    model.fill.inertial = inertial;
    (rate > wanted ? high : low) = ceiling;
    if (rate <= wanted && rate > 0.99 * wanted) break;
    ceiling *= 0.998 * wanted / rate;
    if (!(ceiling > low && ceiling < high)) ceiling = std::sqrt(low * high);
  }
  return low;
}

/// True mass less scaled mass, with the sign turned: what was added, over the unknowns.
SparseMatrix added_mass(const Model& model, const State& state, const Unknowns& unknowns, const MassScaling& scaling) {
  BlockMatrix added(model.sites(), {});
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    if (!unknowns.any(i)) continue;
    const Body& body = model.bodies[i];
    const Mat3 r = rotation_of(state, i).toRotationMatrix();
    Matrix6& m = added.diagonal(std::int32_t(i));
    m.topLeftCorner<3, 3>() = (body.inertial_mass - body.mass) * Mat3::Identity();
    m.bottomRightCorner<3, 3>() = r * (body.inertia - scaling.true_tensor[i]) * r.transpose();
  }
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i)
    added.diagonal(std::int32_t(model.bodies.size() + i)).topLeftCorner<3, 3>() =
        (model.fill.inertial[i] - model.fill.mass[i]) * Mat3::Identity();
  return added.over(unknowns);
}

}  // namespace

MassScaling raise_to(Model& model, const std::vector<LocalRate>& rates, double ceiling) {
  MassScaling scaling;
  scaling.share = share_at(model, rates, ceiling);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    Body& body = model.bodies[i];
    scaling.true_tensor.push_back(body.inertia);
    if (body.still() || rates[i].own <= ceiling) continue;
    const double mass = factor_on_mass(rates[i], ceiling), tensor = rates[i].own / ceiling;
    body.inertial_mass *= mass;
    body.inertia *= tensor;
    body.inverse_inertia /= tensor;
    ++scaling.bodies;
    scaling.heavier += mass > 1.0;
    scaling.largest = std::max(scaling.largest, mass);
    scaling.largest_rotary = std::max(scaling.largest_rotary, tensor);
  }
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i) {
    const double mass = factor_on_mass(rates[model.bodies.size() + i], ceiling);
    model.fill.inertial[i] *= mass;
    scaling.nodes += mass > 1.0;
    scaling.largest = std::max(scaling.largest, mass);
  }
  return scaling;
}

MassScaling scale_mass(Model& model, const State& state, double step, double limit) {
  const std::vector<LocalRate> rates = local_rates(model, state);
  if (!(largest_own(rates) > 0.0)) return {};  // no joints at all
  if (step <= 0.0) return raise_to(model, rates, ceiling_of_share(model, rates, limit));
  if (critical_step(model, state).step >= step) return {};
  const double ceiling = ceiling_of_step(model, state, rates, step), share = share_at(model, rates, ceiling);
  if (share > limit)
    throw InputError(
        "[analysis] mass_scaling_step = {:.4g} s would add {:.3g} % of the mass, more than mass_scaling_limit = {:.4g} "
        "({:.3g} %). Lower the time step, raise the limit, or leave out mass_scaling_step to use the largest time step "
        "within the limit.",
        step, 100 * share, limit, 100 * limit);
  return raise_to(model, rates, ceiling);
}

/// With Φ the lowest i modes of the scaled assembly and G = Φᵀ ΔM Φ, every x in their span has xᵀKx <= ω_i² xᵀMx and
/// xᵀ(M − ΔM)x >= (1 − λ_max(G)) xᵀMx. By Courant and Fischer the true frequency is at most ω_i/√(1 − λ_max(G)).
std::vector<double> frequency_shifts(const Model& model, const State& state, const MassScaling& scaling, int count) {
  const Unknowns unknowns = number_unknowns(model);
  const SparseMatrix k = assemble_stiffness(model, state, unknowns, PatchTangent::intact);
  const Eigenpairs pairs =
      lowest_eigenpairs(k, mass_blocks(model, state, unknowns).over(unknowns), std::min(count, unknowns.count));
  const SparseMatrix added = added_mass(model, state, unknowns, scaling);
  const Eigen::MatrixXd g = pairs.vectors.transpose() * (added.selfadjointView<Eigen::Lower>() * pairs.vectors);
  std::vector<double> shifts;
  for (Eigen::Index i = 0; i < pairs.values.size(); ++i) {
    if (pairs.values[i] <= pairs.zero) continue;
    const Eigen::MatrixXd part = g.topLeftCorner(i + 1, i + 1);
    const double most = eigenvalues(part)[i];
    shifts.push_back(1.0 - std::sqrt(std::max(0.0, 1.0 - most)));
  }
  return shifts;
}

}  // namespace voussoir
