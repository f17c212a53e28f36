#include "solver/contact/patch_kernel.h"

#include <algorithm>

#include "solver/contact/wrench.h"

namespace voussoir {

namespace {

void store_wrench(const Triple<double>& f, const Triple<double>& m, double* wrench) {
  wrench[0] = f.x, wrench[1] = f.y, wrench[2] = f.z;
  wrench[3] = m.x, wrench[4] = m.y, wrench[5] = m.z;
}

PointMemory load_memory(const Patch& patch, int i, const PatchMemory& memory) {
  const auto column = [&](int c) { return memory.point[point_index(patch, i, 4, c)]; };
  return {column(0), column(1), column(2), column(3), memory.broken[point_index(patch, i, 1, 0)] != 0};
}

void store_memory(const Patch& patch, int i, const PointMemory& point, PatchMemory& memory) {
  const double columns[4] = {point.n, point.s, point.t, point.softening};
  for (int c = 0; c < 4; ++c) memory.point[point_index(patch, i, 4, c)] = columns[c];
  memory.broken[point_index(patch, i, 1, 0)] = point.broken;
}

/// The jump of the pass before, six numbers; contacts keep theirs one after the other, joints eight side by side.
float& last_jump(const Patch& patch, std::size_t index, int c, PatchMemory& memory) {
  return patch.stride == 1 ? memory.last[6 * index + std::size_t(c)]
                           : memory.last[last_index(std::size_t(patch.batch), c) + std::size_t(patch.lane)];
}

/// How much a point's jump has changed since the pass before, and its elastic jump then.
struct PointBefore {
  double du[3], elastic[3];
};

PointBefore point_before(const PatchPoint& at, const Triple<double>& u, const double* change, const PointMemory& pm) {
  PointBefore b{
      {change[0] + change[4] * at.t - change[5] * at.s, change[1] - change[3] * at.t, change[2] + change[3] * at.s},
      {}};
  b.elastic[0] = u.x - pm.n - b.du[0], b.elastic[1] = u.y - pm.s - b.du[1], b.elastic[2] = u.z - pm.t - b.du[2];
  if (pm.broken && b.elastic[0] >= 0.0) b.elastic[0] = b.elastic[1] = b.elastic[2] = 0.0;  // it was open
  return b;
}

/// Work done on the point's springs over the step, by the mean of the tractions at both ends, less what they now hold
/// more: what a yielding point has lost. (By the traction at the end alone the ledger would leak in proportion to the
/// step.)
void book_losses(const Patch& patch, const PointBefore& b, double plastic_opening, bool was_broken, PointResult& r) {
  const auto lost = [&](double k, double now, int c) {
    return 0.5 * k * ((now + b.elastic[c]) * b.du[c] - now * now + b.elastic[c] * b.elastic[c]);
  };
  const double shear = lost(patch.ks, r.s, 1) + lost(patch.ks, r.t, 2);
  if (was_broken) {
    r.friction = shear + (r.open ? 0.0 : patch.kn * r.n * plastic_opening);
    r.fracture = 0.0;
  } else {  // what the law calls friction is friction, the rest went with the bond
    r.fracture = shear + lost(patch.kn, r.n, 0) - r.friction;
  }
}

/// Viscous jump of one point's branches after an elastic move to (n, s, t), and the work done on them over the step, by
/// the mean of their tractions at both ends; they are emptied when the point yields.
Triple<double> advance_branches(const Branches& branches, const Patch& patch, int i, const PointResult& r,
                                const PointBefore& before, double weight, PatchMemory& memory, double& work) {
  Triple<double> viscous = {0.0, 0.0, 0.0};
  const double u[3] = {r.n, r.s, r.t};
  double* v = &viscous.x;
  for (int k = 0; k < branches.count; ++k)
    for (int c = 0; c < 3; ++c) {
      float& kept = memory.point_branch[point_index(patch, i, 3 * branches.count, 3 * k + c)];
      const double then = kept, stiffness = weight * (c == 0 ? patch.kn : patch.ks);
      const double q = r.elastic ? branches.e[k] * then + branches.g[k] * (u[c] - before.elastic[c]) : 0.0;
      work += 0.5 * stiffness * (then + q) * before.du[c];
      v[c] += q;
      kept = float(q);
    }
  return viscous;
}

struct PointSums {
  Resultant<double> resultant{};
  double friction = 0.0, fracture = 0.0, damping = 0.0;
  double opening = 0.0, slip2 = 0.0;
  bool all_open = true, all_broken = true;
};

template <class Law>
PointSums sum_points(Law, const LawConstants& law, const Patch& patch, const Jump<double>& j,
                     const Array<double>& points, const Branches& branches, const double* change, PatchMemory& memory) {
  PointSums sums;
  Resultant<double>& q = sums.resultant;
  for (int i = 0; i < patch.point_count; ++i) {
    const PatchPoint point = patch_point(patch, points, i);
    const Triple<double> u = point_jump(patch, j, point.s, point.t);
    PointMemory pm = load_memory(patch, i, memory);
    const PointBefore before = point_before(point, u, change, pm);
    const PointMemory old = pm;
    PointResult r = Law::update(law, patch.kn, patch.ks, u.x, u.y, u.z, pm);
    if (!r.elastic) book_losses(patch, before, pm.n - old.n, old.broken, r);
    store_memory(patch, i, pm, memory);
    double damping = 0.0;
    Triple<double> viscous = {0.0, 0.0, 0.0};
    if (branches.count) viscous = advance_branches(branches, patch, i, r, before, point.weight, memory, damping);
    const double sigma = point.weight * patch.kn * (r.n + viscous.x);
    const double ts = point.weight * patch.ks * (r.s + viscous.y), tt = point.weight * patch.ks * (r.t + viscous.z);
    q.n += sigma, q.s += ts, q.t += tt;
    q.sn += point.s * sigma, q.tn += point.t * sigma;
    q.ss += point.s * ts, q.ts += point.t * ts, q.st += point.s * tt, q.tt += point.t * tt;
    sums.friction += point.weight * r.friction;
    sums.fracture += point.weight * r.fracture;
    sums.damping += damping;
    sums.all_open &= r.open;
    sums.all_broken &= pm.broken;
    if (pm.broken) {
      sums.opening = std::max(sums.opening, u.x);
      if (!r.open) sums.slip2 = std::max(sums.slip2, pm.s * pm.s + pm.t * pm.t);
    } else {
      sums.opening = std::max(sums.opening, pm.n);
      sums.slip2 = std::max(sums.slip2, pm.s * pm.s + pm.t * pm.t);
    }
  }
  return sums;
}

}  // namespace

bool past_limits(const Model& model, const Patch& patch, const Jump<double>& j) {
  return j.s * j.s + j.t * j.t > model.slip_limit2(patch.area) ||
         j.rn * j.rn + j.rs * j.rs + j.rt * j.rt > model.turn_limit2();
}

bool point_patch(const Model& model, const Patch& patch, std::size_t index, const Array<double>& points,
                 const double* pose, const Branches& branches, PatchMemory& memory, double* wrench) {
  const Jump<double> j = patch_jump(patch, pose + pose_width * patch.a, pose + pose_width * patch.b);
  const LawConstants& law = model.laws[patch.law];
  const double now[6] = {j.n, j.s, j.t, j.rn, j.rs, j.rt};
  double change[6];
  for (int c = 0; c < 6; ++c) {
    float& last = last_jump(patch, index, c, memory);
    change[c] = double(float(now[c])) - double(last);  // of rounded jumps: the changes add up to the jump
    last = float(now[c]);
  }
  const PointSums sums =
      with_law(law.kind, [&](auto kind) { return sum_points(kind, law, patch, j, points, branches, change, memory); });
  Triple<double> force, moment;
  world_wrench(sums.resultant, j, force, moment);
  store_wrench(force, moment, wrench);
  double* energy = &memory.energy[3 * index];
  energy[0] += sums.friction, energy[1] += sums.fracture, energy[2] += sums.damping;
  double* largest = &memory.largest[2 * index];
  // The gap of a contact that was found apart is no opening of a joint: it only keeps what it was handed.
  if (patch.stride > 1) largest[0] = std::max(largest[0], sums.opening);
  largest[1] = std::max(largest[1], std::sqrt(sums.slip2));
  if (sums.all_open && sums.all_broken) memory.mode[index] |= patch.stride > 1 ? mode_broken : mode_broken | mode_open;
  return past_limits(model, patch, j);
}

bool in_tile_energy(const Model& model, const State& state, std::size_t joint) {
  return model.laws[std::size_t(model.joints[joint].law)].kind == JointLaw::Kind::brittle ||
         !(state.joint.mode[joint] & mode_points);
}

void joint_to_points(const Model& model, State& state, const Branches& branches, std::size_t index) {
  const Patch& patch = model.joints[index];
  const auto batch = std::size_t(patch.batch), lane = std::size_t(patch.lane);
  const double* slip = &state.slip[3 * lane_count * batch + lane];
  const double a = slip[0], b = slip[lane_count], r = slip[2 * lane_count];
  const bool broken = state.joint.mode[index] & mode_broken;
  for (int i = 0; i < model.batches[batch].points; ++i) {  // those without weight too
    const PatchPoint point = patch_point(patch, model.points, i);
    store_memory(patch, i, {0.0, a - r * point.t, b + r * point.s, broken ? 1.0 : 0.0, broken}, state.joint);
    for (int k = 0; k < branches.count; ++k) {
      const auto row = [&](int c) -> double { return state.branch[branch_index(branches.count, batch, c, k) + lane]; };
      const double field[3] = {row(0) + row(4) * point.t - row(5) * point.s, row(1) - row(3) * point.t,
                               row(2) + row(3) * point.s};
      for (int c = 0; c < 3; ++c)
        state.joint.point_branch[point_index(patch, i, 3 * branches.count, 3 * k + c)] = float(field[c]);
    }
  }
  state.joint.mode[index] |= mode_points;
  state.joint.mode[index] &= std::uint8_t(~(mode_broken | mode_open | mode_slid));
}

void follow_open_contact(State& state, std::size_t contact) {
  std::uint8_t& mode = state.contact.mode[contact];
  if (!(mode & mode_open)) return;
  mode &= std::uint8_t(~mode_open);
  const Patch& patch = state.contacts[contact];
  const float* last = &state.contact.last[6 * contact];  // n, s, t, θn
  for (int i = 0; i < patch.point_count; ++i) {
    const PatchPoint at = patch_point(patch, state.contact_points, i);
    store_memory(patch, i, {0.0, double(last[1]) - last[3] * at.t, double(last[2]) + last[3] * at.s, 0.0, true},
                 state.contact);
  }
}

namespace {

/// A contact that was wholly open, and is: there is nothing to it but its jump. False when some point may close.
bool stays_open(const Model& model, State& state, std::size_t contact, double* wrench, bool& reclip) {
  if (!(state.contact.mode[contact] & mode_open)) return false;
  const Patch& p = state.contacts[contact];
  const Jump<double> j = patch_jump(p, &state.pose[pose_width * p.a], &state.pose[pose_width * p.b]);
  const double rs = j.rs + p.gap[1], rt = j.rt + p.gap[2], n = j.n + p.gap[0];
  if (n <= 0.0 || n * n <= (rs * rs + rt * rt) * p.reach * p.reach) return false;
  const double now[6] = {j.n, j.s, j.t, j.rn, j.rs, j.rt};
  for (int c = 0; c < 6; ++c) state.contact.last[6 * contact + std::size_t(c)] = float(now[c]);
  store_wrench({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, wrench);
  reclip |= past_limits(model, p, j);
  return true;
}

}  // namespace

PassReport PatchPass::contacts(std::size_t begin, std::size_t end) const {
  PassReport report;
  for (std::size_t i = begin; i < end; ++i) {
    double* wrench = contact_wrenches + wrench_width * i;
    ++report.points;
    if (stays_open(*model, *state, i, wrench, report.reclip)) continue;
    follow_open_contact(*state, i);
    report.reclip |= point_patch(*model, state->contacts[i], i, state->contact_points, state->pose.data(), branches,
                                 state->contact, wrench);
  }
  return report;
}

}  // namespace voussoir
