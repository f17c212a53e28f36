#include "solver/statics/machine.h"

#include <algorithm>

namespace voussoir {

namespace {

/// Σ |to − from| on each body, then on each node, N; and the same times the square of its arm, N m2, of bodies.
struct Borne {
  std::vector<double> force, turning;
};

Borne borne_by(const Model& model, const LoadsAtWork& pattern) {
  const std::size_t bodies = model.bodies.size();
  Borne borne = {std::vector<double>(bodies + model.fill.nodes.size(), 0.0), std::vector<double>(bodies, 0.0)};
  const double a = (pattern.acceleration_to - pattern.acceleration_from).norm();
  for (std::size_t i = 0; i < bodies; ++i)
    if (!model.bodies[i].still()) borne.force[i] += model.bodies[i].mass * a;
  for (const PointLoad& p : pattern.points) {
    const double force = (p.to - p.from).norm();
    borne.force[std::size_t(p.body)] += force;
    borne.turning[std::size_t(p.body)] += force * p.arm.squaredNorm();
  }
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i) {
    const auto at = [&](const Array<double>& nodes) {
      return nodes.empty() ? Vec3(Vec3::Zero()) : Vec3(&nodes[node_width * i]);
    };
    borne.force[bodies + i] += model.fill.mass[i] * a + (at(pattern.nodes_to) - at(pattern.nodes_from)).norm();
  }
  return borne;
}

}  // namespace

void Machine::brace(Model& model) {
  const std::size_t bodies = model.bodies.size();
  const Borne borne = borne_by(model, pattern);
  double least = 1e300;
  for (std::size_t i = 0; i < borne.force.size(); ++i) {
    const double inertia = i < bodies ? model.bodies[i].inertial_mass : model.fill.inertial[i - bodies];
    if (borne.force[i] > 0.0) least = std::min(least, inertia / borne.force[i]);
  }
  stiffness = least < 1e300 ? 0.25 * least : 0.0;  // new contacts may take what it adds off again: it must do without
  // A point at an arm r moves by u + θ × r, and |u + θ × r|² ≤ 2 |u|² + 2 |θ|² r².
  for (std::size_t i = 0; i < bodies; ++i) {
    Body& body = model.bodies[i];
    if (borne.force[i] == 0.0 || body.still()) continue;
    body.inertial_mass += 2.0 * stiffness * borne.force[i];
    body.inertia += 2.0 * stiffness * borne.turning[i] * Mat3::Identity();
    body.inverse_inertia = body.inertia.inverse();
  }
  for (std::size_t i = bodies; i < borne.force.size(); ++i)
    model.fill.inertial[i - bodies] += 2.0 * stiffness * borne.force[i];
}

void Machine::push(const Model& model, const State& state, LoadsAtWork& loads) {
  multiplier = stiffness * (head - pattern_displacement(model, state, pattern));
  set_share(pattern, multiplier, loads);
}

}  // namespace voussoir
