#include "solver/model/state.h"

#include <algorithm>
#include <cmath>

#include "solver/contact/jump.h"

namespace voussoir {

void PatchMemory::resize(std::size_t patches, std::size_t points) {
  point.assign(4 * points, 0.0);
  broken.assign(points, 0);
  point_branch.clear();
  mode.assign(patches, 0);
  largest.assign(2 * patches, 0.0);
  energy.assign(3 * patches, 0.0);
}

namespace {

constexpr int patch_columns = 37;

void pack(const Patch& p, Array<double>& rows) {
  const double row[patch_columns] = {double(p.a),
                                     double(p.b),
                                     double(p.cell_a),
                                     double(p.cell_b),
                                     double(p.law),
                                     double(p.first_point),
                                     double(p.point_count),
                                     double(p.first_corner),
                                     double(p.corner_count),
                                     p.arm_a[0],
                                     p.arm_a[1],
                                     p.arm_a[2],
                                     p.arm_b[0],
                                     p.arm_b[1],
                                     p.arm_b[2],
                                     p.place[0],
                                     p.place[1],
                                     p.place[2],
                                     p.shift[0],
                                     p.shift[1],
                                     p.shift[2],
                                     p.e_a[0],
                                     p.e_a[1],
                                     p.e_a[2],
                                     p.e_a[3],
                                     p.e_b[0],
                                     p.e_b[1],
                                     p.e_b[2],
                                     p.e_b[3],
                                     p.gap[0],
                                     p.gap[1],
                                     p.gap[2],
                                     p.kn,
                                     p.ks,
                                     p.area,
                                     p.ss,
                                     p.tt};
  rows.insert(rows.end(), row, row + patch_columns);
}

Patch unpack(const double* r) {
  Patch p;
  std::int32_t* whole[9] = {&p.a,           &p.b,           &p.cell_a,       &p.cell_b,      &p.law,
                            &p.first_point, &p.point_count, &p.first_corner, &p.corner_count};
  for (std::int32_t* field : whole) *field = std::int32_t(*r++);
  const auto take = [&](double* to, int n) {
    for (int i = 0; i < n; ++i) to[i] = *r++;
  };
  take(p.arm_a, 3), take(p.arm_b, 3), take(p.place, 3), take(p.shift, 3), take(p.e_a, 4), take(p.e_b, 4),
      take(p.gap, 3);
  take(&p.kn, 1), take(&p.ks, 1), take(&p.area, 1), take(&p.ss, 1), take(&p.tt, 1);
  return p;
}

void add(std::vector<NamedArray>& list, const std::string& prefix, PatchMemory& memory) {
  list.push_back({prefix + "/point_memory", 4, "m, m, m, -", &memory.point});
  list.push_back({prefix + "/point_broken", 1, "-", &memory.broken});
  list.push_back({prefix + "/point_branch", 1, "m", &memory.point_branch});
  list.push_back({prefix + "/mode", 1, "-", &memory.mode});
  list.push_back({prefix + "/largest", 2, "m", &memory.largest});
  list.push_back({prefix + "/energy", 3, "J", &memory.energy});
  list.push_back({prefix + "/last_jump", 1, "m, rad", &memory.last});
}

}  // namespace

std::vector<NamedArray> State::arrays() {
  contact_rows.clear();
  for (const Patch& p : contacts) pack(p, contact_rows);
  std::vector<NamedArray> list = {{"scalars", 1, "SI", &scalars},
                                  {"counters", 1, "-", &counters},
                                  {"bodies/pose", pose_width, "m, -", &pose},
                                  {"bodies/motion", motion_width, "m/s, kg m2/s, J", &motion},
                                  {"bodies/baseline", 3, "m", &baseline},
                                  {"bodies/searched", searched_width, "m, -", &searched},
                                  {"joints/slip", lane_count, "m, m, rad", &slip},
                                  {"joints/branch", lane_count, "m, rad", &branch},
                                  {"joints/branch_work", lane_count, "J", &branch_work}};
  add(list, "joints", joint);
  list.push_back({"contacts/patches", patch_columns, "SI", &contact_rows});
  list.push_back({"contacts/points", 3, "m, m, m2", &contact_points});
  list.push_back({"contacts/corners", 2, "m", &contact_corners});
  add(list, "contacts", contact);
  list.push_back({"contacts/slid", 4, "m", &contact_slid});
  return list;
}

void State::unpack_contacts() {
  contacts.clear();
  for (std::size_t i = 0; i + patch_columns <= contact_rows.size(); i += patch_columns)
    contacts.push_back(unpack(&contact_rows[i]));
  for (Patch& patch : contacts) set_reach(contact_points, patch);
}

void set_reach(const Array<double>& points, Patch& contact) {
  contact.reach = 0.0;
  for (int i = 0; i < contact.point_count; ++i) {
    const PatchPoint p = patch_point(contact, points, i);
    contact.reach = std::max(contact.reach, std::hypot(p.s, p.t));
  }
}

void stop_motion(State& state) {
  for (std::size_t i = 0; i < state.motion.size(); i += motion_width)
    for (std::size_t c = 0; c < 6; ++c) state.motion[i + c] = 0.0;
  state.base_velocity().setZero();
}

State initial_state(const Model& model) {
  State state;
  const std::size_t n = model.bodies.size();
  state.pose.assign(pose_width * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) state.pose[pose_width * i + 3] = 1.0;
  state.motion.assign(motion_width * n, 0.0);
  state.baseline.assign(3 * n, 0.0);
  state.searched.assign(searched_width * n, 0.0f);
  for (std::size_t i = 0; i < n; ++i)
    state.searched[searched_width * i] = 1e18f;  // never looked for: as if they had come from far
  state.slip.assign(3 * lane_count * model.batches.size(), 0.0);
  state.joint.resize(model.joints.size(), lane_count * model.point_rows);
  state.joint.last.assign(6 * lane_count * model.batches.size(), 0.0f);
  state.branch_work.assign(lane_count * model.tiles.size(), 0.0);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const LawConstants& law = model.laws[model.joints[i].law];
    const bool bondless =
        law.kind != JointLaw::Kind::elastic && law.tension <= 0.0 && law.cohesion <= law.residual_cohesion;
    if (bondless) state.joint.mode[i] |= mode_broken;
  }
  return state;
}

void set_branches(const Model& model, State& state, int count) {
  const std::size_t n = std::size_t(count);
  const auto fit = [](Array<float>& branches, std::size_t size) {
    if (branches.size() != size) branches.assign(size, 0.0f);
  };
  fit(state.branch, 6 * lane_count * n * model.batches.size());
  fit(state.joint.point_branch, n * model.points.size());
  fit(state.contact.point_branch, n * state.contact_points.size());
}

}  // namespace voussoir
