#include "solver/step/contact_bound.h"

#include <algorithm>
#include <numeric>

namespace voussoir {

namespace {

/// A patch's stiffness over the mass of one of its bodies, 1/s2.
double rate_bound(const Patch& p, const Body& body, const double* arm) {
  const double arm2 = arm[0] * arm[0] + arm[1] * arm[1] + arm[2] * arm[2];
  const double inertia = body.inertia.diagonal().minCoeff();
  return std::max(p.kn, p.ks) * (p.area / body.inertial_mass + (p.area * arm2 + p.ss + p.tt) / inertia);
}

/// The same of a patch with the fill.
double rate_bound(const InterfacePatch& p, const Body& body) {
  double moment = p.area * Vec3(p.arm).squaredNorm();
  for (const PatchPoint& point : p.points) moment += point.weight * (point.s * point.s + point.t * point.t);
  return std::max(p.kn, p.ks) * (p.area / body.inertial_mass + moment / body.inertia.diagonal().minCoeff());
}

std::vector<std::vector<std::int32_t>> joints_of_bodies(const Model& model) {
  std::vector<std::vector<std::int32_t>> joints(model.bodies.size());
  for (std::size_t i = 0; i < model.joint_places.size(); ++i) {
    const Patch& p = model.joints[std::size_t(model.joint_places[i].now)];
    for (const std::int32_t body : {p.a, p.b}) joints[std::size_t(body)].push_back(std::int32_t(i));
  }
  return joints;
}

/// Of each node, N/m: Σ V (κ + 4/3 μ) |∇N|² over the elements about it, in the reference placement.
std::vector<double> stiffness_of_elements(const FillModel& fill) {
  std::vector<double> sums(fill.nodes.size(), 0.0);
  for (std::size_t b = 0; b < fill.batches.size(); ++b) {
    for (int lane = 0; lane < fill.batches[b].count; ++lane) {
      const TetShape shape = tet_shape(fill, b, lane);
      for (std::size_t k = 0; k < 4; ++k)
        sums[std::size_t(shape.nodes[k])] += shape.volume * fill.law_of(b).stiff() * shape.gradient[k].squaredNorm();
    }
  }
  return sums;
}

}  // namespace

double ContactBound::of(const Stepper& stepper, const std::vector<std::int32_t>& bodies) {
  const Model& model = *stepper.model;
  const State& state = *stepper.state;
  if (joints_.empty()) joints_ = joints_of_bodies(model);
  double largest = 0.0;
  for (const std::int32_t index : bodies) {
    const auto i = std::size_t(index);
    const Body& body = model.bodies[i];
    if (body.still()) continue;
    double sum = 0.0;
    for (const std::int32_t joint : joints_[i]) {
      const auto place = std::size_t(model.joint_places[std::size_t(joint)].now);
      const Patch& p = model.joints[place];
      if (!(state.joint.mode[place] & mode_gone)) sum += rate_bound(p, body, p.a == index ? p.arm_a : p.arm_b);
    }
    const Incidence& contacts = stepper.incidence;
    for (std::int32_t k = contacts.first[i]; k < contacts.first[i + 1]; ++k) {
      const std::int32_t entry = contacts.contacts[std::size_t(k)];
      const auto slot = std::size_t(entry >> 1);
      if (slot >= state.contacts.size())
        sum += rate_bound(state.interface.patches[slot - state.contacts.size()], body);
      else
        sum +=
            rate_bound(state.contacts[slot], body, entry & 1 ? state.contacts[slot].arm_b : state.contacts[slot].arm_a);
    }
    largest = std::max(largest, sum);
  }
  return largest;
}

double ContactBound::of_bodies(const Stepper& stepper) {
  std::vector<std::int32_t> all(stepper.model->bodies.size());
  std::iota(all.begin(), all.end(), 0);
  return of(stepper, all);
}

double ContactBound::of(const Model& model, const State& state, const std::vector<std::int32_t>& nodes) {
  if (elements_.empty()) elements_ = stiffness_of_elements(model.fill);
  double largest = 0.0;
  for (const std::int32_t index : nodes) {
    const auto i = std::size_t(index);
    if (model.fill.held[i] == 7) continue;
    double sum = elements_[i];
    for (std::int32_t k = state.interface.first_of_node[i]; k < state.interface.first_of_node[i + 1]; ++k) {
      const std::int32_t entry = state.interface.of_node[std::size_t(k)];
      const InterfacePatch& patch = state.interface.patches[std::size_t(entry / 3)];
      const Mat3 shape = shape_functions(patch);
      for (const PatchPoint& p : patch.points) {
        const double n = shape.row(entry % 3).dot(Vec3(1.0, p.s, p.t));
        sum += std::max(patch.kn, patch.ks) * p.weight * std::abs(n);
      }
    }
    largest = std::max(largest, sum / model.fill.inertial[i]);
  }
  return largest;
}

double ContactBound::of_nodes(const Stepper& stepper) {
  if (stepper.model->fill.empty()) return 0.0;
  std::vector<std::int32_t> all(stepper.model->fill.nodes.size());
  std::iota(all.begin(), all.end(), 0);
  return of(*stepper.model, *stepper.state, all);
}

}  // namespace voussoir
