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

double ContactBound::of_all(const Stepper& stepper) {
  std::vector<std::int32_t> all(stepper.model->bodies.size());
  std::iota(all.begin(), all.end(), 0);
  return of(stepper, all);
}

}  // namespace voussoir
