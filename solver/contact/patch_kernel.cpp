#include "solver/contact/patch_kernel.h"

#include <algorithm>

#include "solver/contact/wrench.h"

namespace voussoir {

namespace {

void store_wrench(const WorldWrench<double>& of, double* wrench) {
  wrench[0] = of.force.x, wrench[1] = of.force.y, wrench[2] = of.force.z;
  wrench[3] = of.moment.x, wrench[4] = of.moment.y, wrench[5] = of.moment.z;
}

PointMemory load_memory(const Patch& patch, int i, const PatchMemory& memory) {
  const std::size_t first = point_index(patch, i, 2, 0), second = point_index(patch, i, 2, 1);
  return {memory.point_rest[first], memory.point[first], memory.point[second], memory.point_rest[second],
          memory.broken[point_index(patch, i, 1, 0)] != 0};
}

void store_memory(const Patch& patch, int i, const PointMemory& point, PatchMemory& memory) {
  const std::size_t first = point_index(patch, i, 2, 0), second = point_index(patch, i, 2, 1);
  memory.point[first] = point.s, memory.point[second] = point.t;
  memory.point_rest[first] = point.n, memory.point_rest[second] = point.softening;
  memory.broken[point_index(patch, i, 1, 0)] = point.broken;
}

/// Additional memory of the composite law.
void load_crushing(const Patch& patch, int i, const PatchMemory& memory, PointMemory& point) {
  point.crushed = memory.point_crush[point_index(patch, i, 3, 0)];
  point.closure = memory.point_crush[point_index(patch, i, 3, 1)];
  point.slip = memory.point_crush[point_index(patch, i, 3, 2)];
}

void store_crushing(const Patch& patch, int i, const PointMemory& point, PatchMemory& memory) {
  memory.point_crush[point_index(patch, i, 3, 0)] = point.crushed;
  memory.point_crush[point_index(patch, i, 3, 1)] = point.closure;
  memory.point_crush[point_index(patch, i, 3, 2)] = point.slip;
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

/// Dissipated energy of a yielding point: the work on its springs over the time step, with the mean of the tractions at
/// both ends, minus the increase of their energy. (With only the traction at the end, the error of the energy balance
/// would be in proportion to the time step.)
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

/// The same of a composite point, whose stiffness goes as it crushes: of jumps in terms of the undamaged stiffness, ½ k
/// jump² over what is left of it is stored. A point that had no bond and did not crush is booked as those of other
/// laws; else what is not friction went with the bond and with crushing.
void book_composite(const Patch& patch, const PointBefore& b, const PointMemory& old, const PointMemory& memory,
                    double kept_then, double kept, PointResult& r) {
  const auto lost = [&](double k, double now, int c) {
    return 0.5 * k * ((now + b.elastic[c]) * b.du[c] - now * now / kept + b.elastic[c] * b.elastic[c] / kept_then);
  };
  const double shear = lost(patch.ks, r.s, 1) + lost(patch.ks, r.t, 2);
  if (old.broken && memory.crushed == old.crushed) {
    r.friction = shear + (r.open ? 0.0 : patch.kn * r.n * (memory.n - old.n));
    r.fracture = 0.0;
  } else {
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
  bool all_plain = true;  // of composite points: without bond, nothing crushed, where they were made
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
    if constexpr (Law::crushes) load_crushing(patch, i, memory, pm);
    PointBefore before = point_before(point, u, change, pm);
    const PointMemory old = pm;
    PointResult r = Law::update(law, patch.kn, patch.ks, u.x, u.y, u.z, pm);
    if constexpr (Law::crushes) {
      const double then = kept_stiffness(law, patch.kn, old.crushed);
      for (double& jump : before.elastic) jump *= then;
      if (!r.elastic) book_composite(patch, before, old, pm, then, kept_stiffness(law, patch.kn, pm.crushed), r);
      store_crushing(patch, i, pm, memory);
      sums.all_plain &= pm.broken && pm.crushed == 0.0 && pm.n == 0.0;
    } else if (!r.elastic) {
      book_losses(patch, before, pm.n - old.n, old.broken, r);
    }
    store_memory(patch, i, pm, memory);
    double damping = 0.0;
    Triple<double> viscous = {0.0, 0.0, 0.0};
    if (branches.count && patch.length == 0.0)  // ties are not damped: they pull no more than they yield at
      viscous = advance_branches(branches, patch, i, r, before, point.weight, memory, damping);
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

/// From the next pass on it may go with brittle joints, whose rows without weight repeat the last point too.
void become_plain(const Model& model, const Patch& patch, PatchMemory& memory) {
  const PointMemory last = load_memory(patch, patch.point_count - 1, memory);
  for (int i = patch.point_count; i < model.batches[std::size_t(patch.batch)].points; ++i)
    store_memory(patch, i, last, memory);
}

}  // namespace

bool past_limits(const Model& model, const Patch& patch, const Jump<double>& j) {
  return j.s * j.s + j.t * j.t > model.slip_limit2(patch.area) ||
         j.rn * j.rn + j.rs * j.rs + j.rt * j.rt > model.turn_limit2();
}

void point_patch(const PatchPass& pass, std::size_t index, double* wrench) {
  const Model& model = *pass.model;
  const Branches& branches = pass.branches;
  const Patch& patch = model.joints[index];
  PatchMemory& memory = pass.state->joint;
  const Jump<double> j = patch_jump(patch, pass.pose_of(patch.a), pass.pose_of(patch.b));
  const LawConstants& law = model.laws[patch.law];
  const double now[6] = {j.n, j.s, j.t, j.rn, j.rs, j.rt};
  double change[6];
  for (int c = 0; c < 6; ++c) {
    float& last = memory.last[last_index(std::size_t(patch.batch), c) + std::size_t(patch.lane)];
    change[c] = double(float(now[c])) - double(last);  // of rounded jumps: the changes add up to the jump
    last = float(now[c]);
  }
  const PointSums sums = with_law(
      law.kind, [&](auto kind) { return sum_points(kind, law, patch, j, model.points, branches, change, memory); });
  store_wrench(WorldWrench<double>(sums.resultant, j), wrench);
  const BatchPlace at = place_of(patch);
  const double lost[3] = {sums.friction, sums.fracture, sums.damping};
  for (std::size_t c = 0; c < 3; ++c) memory.energy[energy_index(at, c)] += lost[c];
  const bool tie = patch.length > 0.0;
  const double reached[2] = {tie ? -j.n : sums.opening, tie ? -sums.resultant.n / patch.area : std::sqrt(sums.slip2)};
  for (std::size_t c = 0; c < 2; ++c) {
    double& most = memory.largest[largest_index(at, c)];
    most = std::max(most, reached[c]);
  }
  std::uint8_t& mode = memory.mode[index];
  if (sums.all_open && sums.all_broken) mode |= mode_broken;
  if (!is_composite(law)) return;
  mode &= std::uint8_t(~mode_plain);
  if (!sums.all_plain || law.tan_dilation > 0.0) return;
  mode |= mode_plain;
  become_plain(model, patch, memory);
}

bool in_tile_energy(const Model& model, const State& state, std::size_t joint) {
  return model.laws[std::size_t(model.joints[joint].law)].kind == JointLaw::Kind::brittle ||
         !(state.joint.mode[joint] & mode_points) || (state.joint.mode[joint] & mode_lanes);
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
  const auto last = [&](int c) {
    return double(state.contact.last[last_index(std::size_t(patch.batch), c) + std::size_t(patch.lane)]);
  };
  for (int i = 0; i < state.contact_batches[std::size_t(patch.batch)].patch.points; ++i) {  // those without weight too
    const PatchPoint at = patch_point(patch, state.contact_points, i);
    store_memory(patch, i, {0.0, last(1) - last(3) * at.t, last(2) + last(3) * at.s, 0.0, true}, state.contact);
  }
}

}  // namespace voussoir
