#include "solver/contact/interface_jump.h"

#include <cmath>

namespace voussoir {

InterfaceJump interface_jump(const Model& model, const State& state, const InterfacePatch& patch) {
  InterfaceJump j;
  const auto body = std::size_t(patch.body);
  const Eigen::Quaterniond turned = rotation_of(state, body);
  j.axes =
      (turned * Eigen::Quaterniond(patch.frame[0], patch.frame[1], patch.frame[2], patch.frame[3])).toRotationMatrix();
  j.centroid = model.bodies[body].centroid + Vec3(&state.pose[pose_width * body]);
  j.origin = j.centroid + turned * Vec3(patch.arm);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto node = std::size_t(patch.node[k]);
    j.at[k] = model.fill.nodes[node] + Vec3(&state.fill.pose[node_width * node]);
    j.moved[k] = j.axes.transpose() * (j.at[k] - j.origin) - Vec3(patch.rest[k]);
  }
  return j;
}

Vec3 elastic_point(const Model& model, const State& state, std::size_t slot, const InterfaceJump& jump,
                   const Mat3& shape, std::size_t i) {
  const Interface& interface = state.interface;
  const PatchMemory& memory = state.interface_memory;
  const InterfacePatch& patch = interface.patches[slot];
  const LawConstants& law = model.laws[std::size_t(patch.law)];
  Vec3 u = jump.point(shape, patch.points[i].s, patch.points[i].t);
  for (std::size_t c = 0; c < 2; ++c) u[Eigen::Index(c) + 1] -= memory.point[interface.point_index(slot, i, 2, c)];
  u[0] -= memory.point_rest[interface.point_index(slot, i, 2, 0)];
  if (!memory.broken[interface.point_index(slot, i, 1, 0)]) return u;
  if (u[0] >= 0.0) return Vec3::Zero();
  const double limit = law.residual_cohesion - patch.kn * u[0] * law.residual_tan_friction;
  const double shear = patch.ks * std::hypot(u[1], u[2]);
  if (law.kind != JointLaw::Kind::elastic && shear > limit) u[1] *= limit / shear, u[2] *= limit / shear;
  return u;
}

double interface_energy(const Model& model, const State& state, std::size_t slot) {
  const InterfacePatch& patch = state.interface.patches[slot];
  const InterfaceJump j = interface_jump(model, state, patch);
  const Mat3 shape = shape_functions(patch);
  double sum = 0.0;
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    const Vec3 u = elastic_point(model, state, slot, j, shape, i);
    sum += 0.5 * patch.points[i].weight * (patch.kn * u[0] * u[0] + patch.ks * (u[1] * u[1] + u[2] * u[2]));
  }
  return sum;
}

}  // namespace voussoir
