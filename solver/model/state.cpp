#include "solver/model/state.h"

#include <algorithm>
#include <cmath>

namespace voussoir {

void PatchMemory::resize(std::size_t patches, std::size_t batches, std::size_t points) {
  point.assign(2 * points, 0.0);
  point_rest.assign(2 * points, 0.0);
  broken.assign(points, 0);
  point_branch.clear();
  mode.assign(patches, 0);
  largest.assign(2 * lane_count * batches, 0.0);
  energy.assign(3 * lane_count * batches, 0.0);
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

Patch patch_of_row(const double* r) {
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
  list.push_back({prefix + "/point_slip", 2, "m, m", &memory.point});
  list.push_back({prefix + "/point_rest", 2, "m, -", &memory.point_rest});
  if (!memory.point_crush.empty()) list.push_back({prefix + "/point_crush", 3, "m, m, m", &memory.point_crush});
  list.push_back({prefix + "/point_broken", 1, "-", &memory.broken});
  list.push_back({prefix + "/point_branch", 1, "m", &memory.point_branch});
  list.push_back({prefix + "/mode", 1, "-", &memory.mode});
  list.push_back({prefix + "/largest", lane_count, "m", &memory.largest});
  list.push_back({prefix + "/energy", lane_count, "J", &memory.energy});
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
                                  {"bodies/baseline", pose_width, "m, -", &baseline},
                                  {"bodies/searched", searched_width, "m, -", &searched},
                                  {"bodies/listed", searched_width, "m, -", &listed},
                                  {"pairs/cells", 4, "-", &pair_cells},
                                  {"pairs/seen", searched_width, "m, -", &pair_seen},
                                  {"joints/order", 1, "-", &joint_order},
                                  {"joints/slip", lane_count, "m, m, rad", &slip},
                                  {"joints/branch", lane_count, "m, rad", &branch},
                                  {"joints/branch_work", lane_count, "J", &branch_work},
                                  {"joints/support_work", 1, "J", &support_work}};
  add(list, "joints", joint);
  list.push_back({"contacts/batches", 2, "-", &contact_tiles});
  list.push_back({"contacts/patches", patch_columns, "SI", &contact_rows});
  list.push_back({"contacts/points", 3, "m, m, m2", &contact_points});
  list.push_back({"contacts/corners", 2, "m", &contact_corners});
  add(list, "contacts", contact);
  list.push_back({"contacts/slid", 4, "m", &contact_slid});
  if (!built.empty()) list.push_back({"joints/built", 6, "m, rad", &built});
  if (fill.pose.empty()) return list;
  list.push_back({"fill/pose", node_width, "m, -", &fill.pose});
  list.push_back({"fill/motion", node_width, "m/s", &fill.motion});
  list.push_back({"fill/searched", node_width, "m", &fill.searched});
  list.push_back({"fill/plastic", lane_count, "-", &fill.plastic});
  list.push_back({"fill/last_strain", lane_count, "-", &fill.last});
  list.push_back({"fill/branch", lane_count, "-", &fill.branch});
  list.push_back({"fill/yield", 1, "-", &fill.yield});
  list.push_back({"fill/lost", 4, "J", &fill.lost});
  flatten(interface, interface_rows, interface_points, interface_corners);
  list.push_back({"interface/patches", interface_columns, "SI", &interface_rows});
  list.push_back({"interface/points", 3, "m, m, m2", &interface_points});
  list.push_back({"interface/corners", 2, "m", &interface_corners});
  list.push_back({"interface/searched", searched_width, "m, -", &interface_seen});
  add(list, "interface", interface_memory);
  return list;
}

void State::unpack(const Model& model) {
  if (!model.fill.empty())
    interface = make_interface(unflatten(interface_rows, interface_points, interface_corners, model.fill), model);
  contacts.clear();
  for (std::size_t i = 0; i + patch_columns <= contact_rows.size(); i += patch_columns)
    contacts.push_back(patch_of_row(&contact_rows[i]));
  contact_batches.clear();
  for (std::size_t k = 0; 2 * k < contact_tiles.size(); ++k) {
    append_contact_batch(*this, contact_tiles[2 * k], contact_tiles[2 * k + 1]);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      Patch& p = contacts[lane_count * k + lane];
      p.stride = lane_count, p.batch = std::int32_t(k), p.lane = std::int32_t(lane);
      fill_contact_lane(*this, lane_count * k + lane);
    }
  }
}

std::int64_t State::contact_count() const {
  return std::count_if(contact.mode.begin(), contact.mode.end(), [](std::uint8_t m) { return !(m & mode_gone); });
}

void append_contact_batch(State& state, std::int32_t tile, std::int32_t rows) {
  ContactBatch batch{};
  batch.tile = tile;
  batch.patch.points = rows;
  batch.patch.count = lane_count;
  if (!state.contact_batches.empty()) {
    const ContactBatch& last = state.contact_batches.back();
    batch.patch.first_point = last.patch.first_point + last.patch.points;
    batch.first_corner = last.first_corner + lane_count * most_corners(last.patch.points);
  }
  state.contact_batches.push_back(batch);
}

void fill_contact_lane(State& state, std::size_t slot) {
  const Patch& p = state.contacts[slot];
  ContactBatch& batch = state.contact_batches[slot / lane_count];
  const int lane = int(slot % lane_count);
  fill_lane(p, lane, batch.patch);
  for (int c = 0; c < 4; ++c) batch.frame_b[c][lane] = p.e_b[c];
  for (int c = 0; c < 3; ++c) batch.shift[c][lane] = p.shift[c], batch.gap[c][lane] = p.gap[c];
  double reach = 0.0;
  for (int i = 0; i < p.point_count; ++i) {
    const PatchPoint q = patch_point(p, state.contact_points, i);
    reach = std::max(reach, std::hypot(q.s, q.t));
  }
  batch.reach[lane] = reach;
}

void stop_motion(State& state) {
  for (std::size_t i = 0; i < state.motion.size(); i += motion_width)
    for (std::size_t c = 0; c < 6; ++c) state.motion[i + c] = 0.0;
  std::fill(state.fill.motion.begin(), state.fill.motion.end(), 0.0);
  state.base_velocity().setZero();
}

namespace {

/// Points of the interface's patches that never had a bond.
void note_bonds(const Model& model, State& state) {
  for (std::size_t i = 0; i < state.interface.patches.size(); ++i) {
    const LawConstants& law = model.laws[std::size_t(state.interface.patches[i].law)];
    const bool bond = has_bond(law);
    const PatchBatch& batch = state.interface.batches[i / lane_count].patch;
    for (std::int32_t row = 0; row < batch.points; ++row)
      state.interface_memory.broken[lane_count * std::size_t(batch.first_point + row) + i % lane_count] = bond ? 0 : 1;
  }
}

/// Ties go point by point from the beginning, stretched to their prestress (Pa).
void stretch(const Patch& tie, double prestress, std::size_t joint, State& state) {
  state.joint.mode[joint] = mode_points;
  for (int i = 0; i < tie.point_count; ++i) {
    state.joint.point_rest[point_index(tie, i, 2, 0)] = prestress / tie.kn;
    state.joint.broken[point_index(tie, i, 1, 0)] = 1;
  }
}

}  // namespace

State initial_state(const Model& model) {
  State state;
  const std::size_t n = model.bodies.size();
  state.pose.assign(pose_width * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) state.pose[pose_width * i + 3] = 1.0;
  state.baseline = state.pose;
  state.motion.assign(motion_width * n, 0.0);
  state.searched.assign(searched_width * n, 0.0f);
  for (std::size_t i = 0; i < n; ++i)
    state.searched[searched_width * i] = 1e18f;  // never looked for: as if they had come from far
  state.listed = state.searched;
  state.joint_order.assign(model.joint_of_patch.begin(), model.joint_of_patch.end());
  if (!model.plan.empty()) state.built.assign(6 * model.joints.size(), 0.0f);
  state.slip.assign(3 * lane_count * model.batches.size(), 0.0);
  state.joint.resize(model.joints.size(), model.batches.size(), lane_count * model.point_rows);
  if (std::any_of(model.joints.begin(), model.joints.end(),
                  [&](const Patch& p) { return is_composite(model.laws[std::size_t(p.law)]); }))
    state.joint.point_crush.assign(3 * lane_count * model.point_rows, 0.0);
  state.joint.last.assign(6 * lane_count * model.batches.size(), 0.0f);
  state.branch_work.assign(lane_count * model.tiles.size(), 0.0);
  state.support_work.assign(model.tiles.size(), 0.0);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const LawConstants& law = model.laws[model.joints[i].law];
    if (!has_bond(law)) state.joint.mode[i] |= mode_broken;
    if (law.kind == JointLaw::Kind::tie) stretch(model.joints[i], law.prestress, i, state);
  }
  state.fill = initial_fill(model.fill);
  state.interface = make_interface(model.interface, model);
  state.interface_seen = state.searched;
  state.interface_memory.resize(state.interface.patches.size(), state.interface.batches.size(),
                                lane_count * state.interface.point_rows);
  state.interface_memory.last.assign(9 * lane_count * state.interface.batches.size(), 0.0f);
  note_bonds(model, state);
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
  fit(state.interface_memory.point_branch, 3 * n * lane_count * state.interface.point_rows);
  set_fill_branches(model.fill, state.fill, count);
}

}  // namespace voussoir
