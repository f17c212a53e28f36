#include "solver/contact/patch_energy.h"

#include <cmath>

#include "solver/contact/patch_kernel.h"

namespace voussoir {

namespace {

PatchEnergy intact_energy(const Model& model, const State& state, const Branches& branches, std::size_t index) {
  const Patch& patch = model.joints[index];
  const Jump<double> j = patch_jump(patch, &state.pose[pose_width * patch.a], &state.pose[pose_width * patch.b]);
  const auto batch = std::size_t(patch.batch), lane = std::size_t(patch.lane);
  const double* slip = &state.slip[3 * lane_count * batch + lane];
  const double u[6] = {j.n, j.s - slip[0], j.t - slip[lane_count], j.rn - slip[2 * lane_count], j.rs, j.rt};
  if (state.joint.mode[index] & mode_broken) {  // wholly open patches carry nothing
    bool open = true;
    for (int c = 0; c < patch.corner_count; ++c) {
      const PatchPoint corner = patch_corner(patch, model.corners, c);
      open &= u[0] + u[4] * corner.t - u[5] * corner.s >= 0.0;
    }
    if (open) return {};
  }
  const double k[6] = {patch.kn * patch.area, patch.ks * patch.area,
                       patch.ks * patch.area, patch.ks * (patch.ss + patch.tt),
                       patch.kn * patch.tt,   patch.kn * patch.ss};
  PatchEnergy e;
  for (int c = 0; c < 6; ++c) {
    e.elastic += 0.5 * k[c] * u[c] * u[c];
    for (int b = 0; b < branches.count; ++b) {
      const double q = state.branch[branch_index(branches.count, batch, c, b) + lane];
      e.branches += 0.5 * k[c] * branches.stored[b] * q * q;
    }
  }
  return e;
}

PatchEnergy points_energy(const Model& model, bool yielding, const Patch& patch, const Array<double>& points,
                          const PatchMemory& memory, const State& state, const Branches& branches) {
  const Jump<double> j = patch_jump(patch, &state.pose[pose_width * patch.a], &state.pose[pose_width * patch.b]);
  PatchEnergy e;
  for (int i = 0; i < patch.point_count; ++i) {
    const PatchPoint point = patch_point(patch, points, i);
    const Triple<double> u = elastic_jump(patch, j, point, memory, i);
    const double kept = kept_at(model.laws[patch.law], patch, memory, i);
    double x[3] = {u.x, u.y, u.z};
    if (memory.broken[point_index(patch, i, 1, 0)]) {
      if (x[0] >= 0.0) continue;
      const LawConstants& law = model.laws[patch.law];
      const double limit = law.residual_cohesion - kept * patch.kn * u.x * law.residual_tan_friction;
      const double shear = kept * patch.ks * std::hypot(u.y, u.z);
      if (yielding && law.kind != JointLaw::Kind::elastic && shear > limit)
        x[1] *= limit / shear, x[2] *= limit / shear;
    }
    for (int c = 0; c < 3; ++c) {
      const double k = point.weight * (c == 0 ? patch.kn : patch.ks);
      e.elastic += 0.5 * kept * k * x[c] * x[c];
      for (int b = 0; b < branches.count; ++b) {
        const double q = memory.point_branch[point_index(patch, i, 3 * branches.count, 3 * b + c)];
        e.branches += 0.5 * k * branches.stored[b] * q * q;
      }
    }
  }
  return e;
}

}  // namespace

PatchEnergy patch_energy(const Model& model, const State& state, const Branches& branches, std::size_t index,
                         bool yielding) {
  if (index >= model.joints.size() && !state.has_contact(index - model.joints.size())) return {};
  if (index >= model.joints.size())
    return points_energy(model, yielding, state.contacts[index - model.joints.size()], state.contact_points,
                         state.contact, state, branches);
  const std::uint8_t mode = state.joint.mode[index];
  if (mode & mode_gone) return {};
  if (mode & mode_points)
    return points_energy(model, yielding, model.joints[index], model.points, state.joint, state, branches);
  return intact_energy(model, state, branches, index);
}

}  // namespace voussoir
