#include "solver/contact/branch_memory.h"

#include "solver/contact/jump.h"

namespace voussoir {

namespace {

/// p of the new branch for the jump u, from p of the old one (or from rest).
double convert(const Branches& from, const Branches& to, int k, double p, double u) {
  const bool keeps = from.count == to.count && from.e[k] > 0.0;
  const double q = keeps ? (p + from.g[k] * u) / from.e[k] : 0.0;
  return to.e[k] * q - to.g[k] * u;
}

void convert_points(const Patch& patch, const Array<double>& points, const State& state, const Branches& from, const Branches& to,
                    const PatchMemory& memory, Array<double>& next) {
  const Jump<double> j = patch_jump(patch, &state.pose[pose_width * patch.a], &state.pose[pose_width * patch.b]);
  for (int i = 0; i < patch.point_count; ++i) {
    const Triple<double> u = elastic_jump(patch, j, patch_point(patch, points, i), memory, i);
    const double x[3] = {u.x, u.y, u.z};
    if (memory.broken[point_index(patch, i, 1, 0)] && x[0] >= 0.0) continue;
    for (int k = 0; k < to.count; ++k)
      for (int c = 0; c < 3; ++c) {
        const double p = from.count == to.count ? memory.point_branch[point_index(patch, i, 3 * from.count, 3 * k + c)] : 0.0;
        next[point_index(patch, i, 3 * to.count, 3 * k + c)] = convert(from, to, k, p, x[c]);
      }
  }
}

void convert_intact(const Model& model, const State& state, const Branches& from, const Branches& to, std::size_t index,
                    Array<double>& next) {
  const Patch& patch = model.joints[index];
  const Jump<double> j = patch_jump(patch, &state.pose[pose_width * patch.a], &state.pose[pose_width * patch.b]);
  const std::size_t batch = index / lane_count, lane = index % lane_count;
  const double* slip = &state.slip[3 * lane_count * batch + lane];
  const double u[6] = {j.n, j.s - slip[0], j.t - slip[lane_count], j.rn - slip[2 * lane_count], j.rs, j.rt};
  if ((state.joint.mode[index] & mode_broken) && u[0] >= 0.0) return;
  for (int k = 0; k < to.count; ++k)
    for (int c = 0; c < 6; ++c) {
      const double p = from.count == to.count ? state.branch[lane_count * (6 * (from.count * batch + k) + c) + lane] : 0.0;
      next[lane_count * (6 * (to.count * batch + k) + c) + lane] = convert(from, to, k, p, u[c]);
    }
}

}  // namespace

void set_branches(const Model& model, State& state, const Branches& from, const Branches& to) {
  Array<double> branch(6 * lane_count * to.count * model.batches.size(), 0.0);
  Array<double> joint_points(to.count * model.points.size(), 0.0), contact_points(to.count * state.contact_points.size(), 0.0);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (state.joint.mode[i] & mode_gone) continue;
    if (state.joint.mode[i] & mode_points)
      convert_points(model.joints[i], model.points, state, from, to, state.joint, joint_points);
    else
      convert_intact(model, state, from, to, i, branch);
  }
  for (const Patch& contact : state.contacts)
    convert_points(contact, state.contact_points, state, from, to, state.contact, contact_points);
  state.branch = std::move(branch);
  state.joint.point_branch = std::move(joint_points);
  state.contact.point_branch = std::move(contact_points);
}

}  // namespace voussoir
