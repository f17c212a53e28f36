#include "solver/contact/enclosed.h"

#include <algorithm>

namespace voussoir {

namespace {

/// A place that moves with a body, where it was as built.
Vec3 as_built(const Model& model, const State& state, std::int32_t body, const Vec3& place) {
  const double* p = &state.pose[pose_width * std::size_t(body)];
  const Vec3& centroid = model.bodies[std::size_t(body)].centroid;
  return centroid + rotation_of(state, std::size_t(body)).conjugate() * (place - centroid - Vec3(p[0], p[1], p[2]));
}

/// Whether a place (as built) is within `reach` of a joint.
bool is_near(const Model& model, const Patch& joint, const Vec3& place, double reach) {
  const double* e = joint.e_a;
  const Vec3 at = Eigen::Quaterniond(e[0], e[1], e[2], e[3]).conjugate() * (place - Vec3(joint.place));
  if (std::abs(at.x()) > reach) return false;
  for (int i = 0; i < joint.corner_count; ++i) {
    const PatchPoint p = patch_corner(joint, model.corners, i);
    const PatchPoint q = patch_corner(joint, model.corners, (i + 1) % joint.corner_count);
    const double s = q.s - p.s, t = q.t - p.t;
    if (t * (at.y() - p.s) - s * (at.z() - p.t) > reach * std::hypot(s, t)) return false;
  }
  return true;
}

}  // namespace

JointsOfBodies::JointsOfBodies(const Model& model)
    : model_(model), first_(model.bodies.size() + 1, 0), entries_(2 * model.joint_by_cells.size()) {
  for (const auto& [cells, joint] : model.joint_by_cells)
    ++first_[std::size_t(cells[0]) + 1], ++first_[std::size_t(cells[1]) + 1];
  for (std::size_t i = 0; i + 1 < first_.size(); ++i) first_[i + 1] += first_[i];
  std::vector<std::int32_t> next = first_;
  for (const auto& [cells, joint] : model.joint_by_cells) {
    entries_[std::size_t(next[std::size_t(cells[0])]++)] = {cells[1], joint};
    entries_[std::size_t(next[std::size_t(cells[1])]++)] = {cells[0], joint};
  }
}

std::pair<const JointsOfBodies::Entry*, const JointsOfBodies::Entry*> JointsOfBodies::of(std::int32_t body) const {
  return {entries_.data() + first_[std::size_t(body)], entries_.data() + first_[std::size_t(body) + 1]};
}

const Patch& JointsOfBodies::patch(const Entry& entry) const {
  return model_.joints[std::size_t(model_.joint_places[std::size_t(entry.joint)].now)];
}

bool JointsOfBodies::enclose(const State& state, const CellPair& cells, const Vec3& place, double reach) const {
  const auto stands_there = [&](std::int32_t body, const Entry& e) {
    return is_near(model_, patch(e), as_built(model_, state, body, place), reach);
  };
  const auto is_held = [&](std::int32_t body, std::int32_t other) {
    const auto [first, end] = of(body);
    return std::any_of(first, end, [&](const Entry& e) {
      return e.other != other && stands_there(body, e) && stands_there(e.other, e);
    });
  };
  const auto [first, end] = of(cells[0]);
  const bool joined = std::any_of(first, end, [&](const Entry& e) {
    const auto now = std::size_t(model_.joint_places[std::size_t(e.joint)].now);
    return e.other == cells[1] && !(state.joint.mode[now] & mode_gone) && stands_there(cells[0], e) &&
           stands_there(cells[1], e);
  });
  return joined || (is_held(cells[0], cells[1]) && is_held(cells[1], cells[0]));
}

}  // namespace voussoir
