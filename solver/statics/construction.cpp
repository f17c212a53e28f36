#include "solver/statics/construction.h"

#include <Eigen/LU>
#include <algorithm>

#include "solver/contact/grouping.h"
#include "solver/contact/interface_change.h"
#include "solver/contact/interface_jump.h"
#include "solver/contact/jump.h"
#include "solver/fill/tet_strain.h"

namespace voussoir {

namespace {

std::int32_t step_of_body(const Model& model, std::int32_t body) {
  return model.plan.block[std::size_t(model.block_of_body[std::size_t(body)])];
}

void make_joints(std::int32_t step, Model& model, State& state) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Patch& patch = model.joints[i];
    if (std::max(step_of_body(model, patch.a), step_of_body(model, patch.b)) != step) continue;
    state.joint.mode[i] &= std::uint8_t(~mode_gone);
    const Jump<double> j = patch_jump(patch, &state.pose[pose_width * std::size_t(patch.a)],
                                      &state.pose[pose_width * std::size_t(patch.b)]);
    const double now[6] = {j.n, j.s, j.t, j.rn, j.rs, j.rt};  // nothing is taken off it yet
    std::transform(now, now + 6, &state.built[6 * std::size_t(model.joint_of_patch[i])],
                   [](double x) { return float(x); });
  }
  take_built(model, state);
}

/// Patches of stones with the fill, as both lie now.
void make_patches(std::int32_t step, const Model& model, State& state) {
  if (model.interface.empty()) return;
  InterfaceChange change;
  change.gone.assign(state.interface.patches.size(), 0);
  change.bonded = true;
  for (InterfacePatch patch : model.interface) {
    if (std::max(step_of_body(model, patch.body), model.plan.triangle[std::size_t(patch.triangle)]) != step) continue;
    const InterfaceJump j = interface_jump(model, state, patch);
    for (std::size_t k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c) patch.rest[k][c] += j.moved[k][c];
    patch.from = -1;
    change.fresh.push_back(std::move(patch));
  }
  if (!change.fresh.empty()) change_interface(model, state, 0, std::move(change));
}

/// The plastic memory with which a tetrahedron is free of stress in the placement of its nodes: b = F Cp⁻¹ Fᵀ = 1 and
/// θ = θp (docs/theory/fill.md).
void make_tetrahedron(const Model& model, State& state, std::size_t batch, int lane) {
  const TetShape shape = tet_shape(model.fill, batch, lane);
  Mat3 h = Mat3::Zero();
  for (std::size_t k = 0; k < 4; ++k)
    h += Vec3(&state.fill.pose[node_width * std::size_t(shape.nodes[k])]) * shape.gradient[k].transpose();
  if (h.isZero(0.0)) return;
  const Mat3 f = Mat3::Identity() + h, inverse = f.inverse();
  const Lanes change = splat(f.determinant() - 1.0);
  const Mat3 memory = inverse * inverse.transpose() - Mat3::Identity();
  const double rows[row_shear] = {memory(0, 0),
                                  memory(1, 1),
                                  memory(2, 2),
                                  memory(0, 1),
                                  memory(0, 2),
                                  memory(1, 2),
                                  tet::volumetric(change).strain[0]};
  for (int c = 0; c < row_shear; ++c) state.fill.plastic[plastic_index(batch, c) + std::size_t(lane)] = rows[c];
  state.fill.yield[lane_count * batch + std::size_t(lane)] |= built_deformed;
}

void make_fill(std::int32_t step, const Model& model, State& state) {
  for (std::size_t b = 0; b < model.fill.batches.size(); ++b) {
    if (model.fill.step_of_law[std::size_t(model.fill.batches[b].law)] != step) continue;
    for (int lane = 0; lane < lane_count; ++lane) make_tetrahedron(model, state, b, lane);  // further lanes repeat one
  }
}

}  // namespace

void clear_site(const Model& model, State& state) {
  for (std::uint8_t& mode : state.joint.mode) mode |= mode_gone;
  state.interface = make_interface({}, model);
  state.interface_memory.resize(0, 0, 0);
  state.interface_memory.last.clear();
}

void add_step(std::int32_t step, Model& model, State& state) {
  make_joints(step, model, state);
  make_fill(step, model, state);
  make_patches(step, model, state);
}

Model during_step(const Model& model, std::int32_t step) {
  constexpr double unlimited = 1e30;  // Pa: what has no stiffness shall not flow
  Model m = model;
  m.contact.search = false;
  for (std::size_t i = 0; i < m.bodies.size(); ++i) {
    const auto block = std::size_t(m.block_of_body[i]);
    if (m.plan.block[block] > step || m.plan.free[block] > step) m.bodies[i].hold();
  }
  const auto later = [&](std::int32_t of) { return of > step; };
  if (std::all_of(m.fill.step_of_law.begin(), m.fill.step_of_law.end(), later)) {
    m.fill = {};
    return m;
  }
  for (std::size_t l = 0; l < m.fill.laws.size(); ++l) {
    if (!later(m.fill.step_of_law[l])) continue;
    FillLaw& law = m.fill.laws[l];
    law.density = law.bulk = law.shear = 0.0;
    law.tension = law.strength = unlimited;
  }
  lump(m.fill);
  return m;
}

}  // namespace voussoir
