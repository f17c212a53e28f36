#include "solver/statics/resultants.h"

#include <algorithm>

#include "solver/contact/jump.h"
#include "solver/model/composite_law.h"
#include "solver/step/make_snapshot.h"

namespace voussoir {

namespace {

/// A patch as the resultants look at it: a joint or a contact with the tables that hold its points.
struct RestPatch {
  const Patch& patch;
  std::size_t wrench;  // its number among Stepper::wrenches
  bool by_points;
  const Array<double>&points, &corners;
  const PatchMemory& memory;
};

/// Of a patch on the intact path the corners tell; else the points, which lie on its edges too.
double largest_compression(const RestPatch& p, const Model& model, const Jump<double>& j) {
  double least = 0.0;
  if (p.by_points) {
    const LawConstants& law = model.laws[std::size_t(p.patch.law)];
    for (int i = 0; i < p.patch.point_count; ++i)
      least = std::min(least, kept_at(law, p.patch, p.memory, i) *
                                  elastic_jump(p.patch, j, patch_point(p.patch, p.points, i), p.memory, i).x);
  } else {
    for (int i = 0; i < p.patch.corner_count; ++i) {
      const PatchPoint corner = patch_corner(p.patch, p.corners, i);
      least = std::min(least, point_jump(p.patch, j, corner.s, corner.t).x);
    }
  }
  return -p.patch.kn * least;
}

PatchForce force_of(const RestPatch& p, const Stepper& stepper, const PatchSnapshot& seen) {
  const Model& model = *stepper.model;
  const double* w = &stepper.wrenches[wrench_width * p.wrench];
  const auto pose = [&](std::int32_t body) { return &stepper.state->pose[pose_width * std::size_t(body)]; };
  PatchForce f;
  f.force = Vec3(w[0], w[1], w[2]), f.moment = Vec3(w[3], w[4], w[5]);
  if (seen.tie || f.force.isZero(0.0)) return f;
  f.shear_capacity = shear_capacity(model.laws[std::size_t(p.patch.law)], seen);
  f.largest_compression = largest_compression(p, model, patch_jump(p.patch, pose(p.patch.a), pose(p.patch.b)));
  return f;
}

}  // namespace

RestForces forces_at_rest(const Model& model, const State& state) {
  RestForces rest;
  rest.snapshot = make_snapshot(model, state);
  rest.snapshot.fill = {};
  State own = state;
  Stepper stepper;
  stepper.model = &model;
  stepper.state = &own;
  stepper.prepare();
  stepper.patches_only();
  rest.forces.resize(rest.snapshot.patches.size());
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const auto at = std::size_t(model.joint_of_patch[i]);
    const bool by_points = own.joint.mode[i] & mode_points;
    rest.forces[at] = force_of({model.joints[i], i, by_points, model.points, model.corners, own.joint}, stepper,
                               rest.snapshot.patches[at]);
  }
  std::size_t at = model.joints.size();
  for (std::size_t i = 0; i < own.contacts.size(); ++i) {
    if (!own.has_contact(i)) continue;
    rest.forces[at] =
        force_of({own.contacts[i], model.joints.size() + i, true, own.contact_points, own.contact_corners, own.contact},
                 stepper, rest.snapshot.patches[at]);
    ++at;
  }
  return rest;
}

}  // namespace voussoir
