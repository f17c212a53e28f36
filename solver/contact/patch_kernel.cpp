#include "solver/contact/patch_kernel.h"

#include <algorithm>

namespace voussoir {

namespace {

/// Sums of traction over a patch in local axes: resultant, and the moments of second order that turn with the bodies.
template <class T>
struct Resultant {
  T n, s, t;               // ∫ σ, τs, τt
  T sn, tn, st, ts;        // ∫ s σ, t σ, s τt, t τs
  T ss, tt;                // ∫ s τs, t τt (zero on the intact path)
};

/// Force and moment about the world's origin on body a, with the exact arms H Q r.
template <class T>
inline void world_wrench(const Resultant<T>& q, const Jump<T>& j, Triple<T>& force, Triple<T>& moment) {
  const Triple<T> m0 = {q.st - q.ts, q.tn, -q.sn};
  const Triple<T> turn_vector = {j.rn, j.rs, j.rt};
  const Triple<T> g = {j.rs * q.sn + j.rt * q.tn, j.rs * q.ss + j.rt * q.ts, j.rs * q.st + j.rt * q.tt};
  const T share = 0.25 / (1.0 + j.cosine);
  const Triple<T> local = j.cosine * m0 + share * cross(turn_vector, g);
  force = turn(j.frame, Triple<T>{q.n, q.s, q.t});
  moment = turn(j.frame, local) + cross(j.place, force);
}

void store_wrench(const Triple<double>& f, const Triple<double>& m, double* wrench) {
  wrench[0] = f.x, wrench[1] = f.y, wrench[2] = f.z;
  wrench[3] = m.x, wrench[4] = m.y, wrench[5] = m.z;
}

/// Viscous jump of one point's branches after an elastic move to (n, s, t); the branches are emptied when the point yields.
inline Triple<double> advance_branches(const Branches& branches, const PointResult& r, double* p, double kn, double ks,
                                       double weight, double& loss) {
  Triple<double> viscous = {0.0, 0.0, 0.0};
  const double u[3] = {r.n, r.s, r.t};
  double* v = &viscous.x;
  for (int k = 0; k < branches.count; ++k)
    for (int c = 0; c < 3; ++c, ++p) {
      const double g = branches.g[k];
      const double q = r.elastic ? *p + g * u[c] : 0.0;
      v[c] += q;
      *p = branches.e[k] * q - g * u[c];
      loss += branches.loss[k] * weight * (c == 0 ? kn : ks) * q * q;
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
PointSums sum_points(Law, const LawConstants& law, const Patch& patch, const Jump<double>& j, const PatchPoint* points,
                     const Branches& branches, PatchMemory& memory) {
  PointSums sums;
  Resultant<double>& q = sums.resultant;
  for (int i = 0; i < patch.point_count; ++i) {
    const std::size_t at = std::size_t(patch.first_point) + i;
    const PatchPoint& point = points[at];
    const Triple<double> u = point_jump(patch, j, point.s, point.t);
    double* stored = &memory.point[4 * at];
    PointMemory pm{stored[0], stored[1], stored[2], stored[3], memory.broken[at] != 0};
    const PointResult r = Law::update(law, patch.kn, patch.ks, u.x, u.y, u.z, pm);
    stored[0] = pm.n, stored[1] = pm.s, stored[2] = pm.t, stored[3] = pm.softening;
    memory.broken[at] = pm.broken;
    double damping = 0.0;
    Triple<double> viscous = {0.0, 0.0, 0.0};
    if (branches.count)
      viscous = advance_branches(branches, r, &memory.point_branch[3 * branches.count * at], patch.kn, patch.ks, point.weight, damping);
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

bool point_patch(const Model& model, const Patch& patch, std::size_t index, const PatchPoint* points, const double* pose,
                 const Branches& branches, PatchMemory& memory, double* wrench) {
  const Jump<double> j = patch_jump(patch, pose + pose_width * patch.a, pose + pose_width * patch.b);
  const LawConstants& law = model.laws[patch.law];
  const PointSums sums = with_law(law.kind, [&](auto kind) { return sum_points(kind, law, patch, j, points, branches, memory); });
  Triple<double> force, moment;
  world_wrench(sums.resultant, j, force, moment);
  store_wrench(force, moment, wrench);
  double* energy = &memory.energy[3 * index];
  energy[0] += sums.friction, energy[1] += sums.fracture, energy[2] += sums.damping;
  double* largest = &memory.largest[2 * index];
  largest[0] = std::max(largest[0], sums.opening);
  largest[1] = std::max(largest[1], std::sqrt(sums.slip2));
  if (sums.all_open && sums.all_broken) memory.mode[index] |= mode_broken;
  const double limit_slip2 = model.contact.reclip_slip * model.contact.reclip_slip * patch.area;
  const double limit_turn2 = model.contact.reclip_angle * model.contact.reclip_angle;
  return j.s * j.s + j.t * j.t > limit_slip2 || j.rn * j.rn + j.rs * j.rs + j.rt * j.rt > limit_turn2;
}

namespace {

Triple<Lanes> load(const Lanes* x) { return {x[0], x[1], x[2]}; }

struct LanePoses {
  Triple<Lanes> u;
  Quat<Lanes> q;
};

LanePoses gather(const double* pose, const std::int32_t* bodies) {
  alignas(64) double rows[7][lane_count];
  for (int lane = 0; lane < lane_count; ++lane) {
    const double* p = pose + pose_width * std::size_t(bodies[lane]);
    for (int c = 0; c < 7; ++c) rows[c][lane] = p[c];
  }
  const auto* r = reinterpret_cast<const Lanes*>(rows);
  return {{r[0], r[1], r[2]}, {r[3], {r[4], r[5], r[6]}}};
}

Jump<Lanes> lanes_jump(const JointBatch& batch, const double* pose) {
  const LanePoses a = gather(pose, batch.a), b = gather(pose, batch.b);
  Lanes same = a.q.w * b.q.w + dot(a.q.v, b.q.v);
  const Lanes sign = same < 0.0 ? splat(-1.0) : splat(1.0);
  same *= sign;
  const Quat<Lanes> qb = {sign * b.q.w, sign * b.q.v};
  const Triple<Lanes> c = cross(a.q.v, qb.v);
  const Quat<Lanes> relative = {same,
                                {a.q.w * qb.v.x - qb.w * a.q.v.x + c.x, a.q.w * qb.v.y - qb.w * a.q.v.y + c.y,
                                 a.q.w * qb.v.z - qb.w * a.q.v.z + c.z}};
  const Lanes norm = 1.0 / square_root(2.0 + 2.0 * same);
  const Quat<Lanes> half = {norm * (a.q.w + qb.w), norm * (a.q.v + qb.v)};
  const Quat<Lanes> frame = half * Quat<Lanes>{batch.frame[0], load(batch.frame + 1)};
  const Triple<Lanes> move_a = a.u + turn_change(a.q, load(batch.arm_a));
  const Triple<Lanes> move_b = b.u + turn_change(b.q, load(batch.arm_b));
  const Lanes zero = splat(0.0);
  return local_jump(move_a, move_b, load(batch.place), Triple<Lanes>{zero, zero, zero}, relative, frame);
}

/// Strengths of the eight joints as their bonds now are.
struct LaneStrength {
  Lanes tension, cohesion, tangent;
};

LaneStrength strengths(const Model& model, const std::uint8_t* mode, std::size_t first, int count) {
  LaneStrength s;
  for (int lane = 0; lane < lane_count; ++lane) {
    const int i = std::min(lane, count - 1);
    const LawConstants& law = model.laws[model.joints[first + i].law];
    const bool broken = mode[i] & mode_broken;
    const bool elastic = law.kind == JointLaw::Kind::elastic;
    s.tension[lane] = elastic ? 1e300 : broken ? 0.0 : law.tension;
    s.cohesion[lane] = elastic ? 1e300 : broken ? law.residual_cohesion : law.cohesion;
    s.tangent[lane] = elastic ? 0.0 : broken ? law.residual_tan_friction : law.tan_friction;
  }
  return s;
}

/// The elastic generalised jump of the intact path.
struct LaneElastic {
  Lanes u[6];  // n, s, t, θn, θs, θt
};

struct LaneCheck {
  LaneMask admissible, open;
};

/// The elastic traction field is affine and the admissible set convex: the corners decide for the whole polygon.
LaneCheck check_corners(const JointBatch& batch, const Lanes* corners, const LaneElastic& e, const LaneStrength& strength) {
  LaneMask admissible = batch.kn == batch.kn, open = admissible;
  for (int c = 0; c < batch.corners; ++c) {
    const Lanes s = corners[2 * c], t = corners[2 * c + 1];
    const Lanes n = e.u[0] + e.u[4] * t - e.u[5] * s;
    const Lanes us = e.u[1] - e.u[3] * t, ut = e.u[2] + e.u[3] * s;
    const Lanes sigma = batch.kn * n;
    const Lanes limit = strength.cohesion - sigma * strength.tangent;
    const Lanes shear2 = batch.ks * batch.ks * (us * us + ut * ut);
    admissible &= (sigma <= strength.tension) & (limit >= 0.0) & (shear2 <= limit * limit);
    open &= n >= 0.0;
  }
  return {admissible, open};
}

/// Largest opening and the plastic slip field of patches that are wholly open.
void follow_open(const JointBatch& batch, const Lanes* corners, const LaneElastic& e, LaneMask open, Lanes* slip, double* largest) {
  for (int c = 0; c < 3; ++c) {
    const Lanes now = slip[c] + e.u[c + 1];
    slip[c] = open ? now : slip[c];
  }
  Lanes most = splat(0.0);
  for (int c = 0; c < batch.corners; ++c) {
    const Lanes n = e.u[0] + e.u[4] * corners[2 * c + 1] - e.u[5] * corners[2 * c];
    most = n > most ? n : most;
  }
  for (int lane = 0; lane < batch.count; ++lane)
    if (open[lane]) largest[2 * lane] = std::max(largest[2 * lane], most[lane]);
}

/// Elastic plus viscous generalised jump; the branches of open lanes relax.
LaneElastic advance_lanes(const Branches& branches, const JointBatch& batch, const LaneElastic& e, LaneMask open, LaneMask keep,
                          Lanes* p, Lanes& loss) {
  LaneElastic sum = e;
  const Lanes stiffness[6] = {batch.kn * batch.area,                batch.ks * batch.area, batch.ks * batch.area,
                              batch.ks * (batch.ss + batch.tt), batch.kn * batch.tt,   batch.kn * batch.ss};
  for (int k = 0; k < branches.count; ++k) {
    Lanes power = splat(0.0);
    for (int c = 0; c < 6; ++c, ++p) {
      const Lanes q = *p + branches.g[k] * e.u[c];
      sum.u[c] += q;
      power += stiffness[c] * q * q;
      const Lanes next = open ? splat(0.0) : branches.e[k] * q - branches.g[k] * e.u[c];
      *p = keep ? next : *p;
    }
    loss += branches.loss[k] * power;
  }
  return sum;
}

Resultant<Lanes> lanes_resultant(const JointBatch& b, const LaneElastic& v) {
  const Lanes zero = splat(0.0);
  Resultant<Lanes> q;
  q.n = b.kn * b.area * v.u[0];
  q.s = b.ks * b.area * v.u[1];
  q.t = b.ks * b.area * v.u[2];
  q.sn = -(b.kn * b.ss) * v.u[5];
  q.tn = b.kn * b.tt * v.u[4];
  q.st = b.ks * b.ss * v.u[3];
  q.ts = -(b.ks * b.tt) * v.u[3];
  q.ss = zero;
  q.tt = zero;
  return q;
}

void store_lanes(const Triple<Lanes>& f, const Triple<Lanes>& m, const JointBatch& batch, LaneMask carries, double* wrench) {
  const Lanes zero = splat(0.0);
  const Lanes rows[6] = {carries ? f.x : zero, carries ? f.y : zero, carries ? f.z : zero,
                         carries ? m.x : zero, carries ? m.y : zero, carries ? m.z : zero};
  for (int lane = 0; lane < batch.count; ++lane)
    for (int c = 0; c < 6; ++c) wrench[wrench_width * lane + c] = rows[c][lane];
}

/// A patch that is wholly open and broken goes back to the intact path: its plastic slip is a rigid field again.
void to_intact(const Model& model, State& state, const Branches& branches, std::size_t batch, int lane, std::size_t index) {
  const Patch& patch = model.joints[index];
  const Jump<double> j = patch_jump(patch, &state.pose[pose_width * patch.a], &state.pose[pose_width * patch.b]);
  double* slip = &state.slip[3 * lane_count * batch + lane];
  slip[0] = j.s, slip[lane_count] = j.t, slip[2 * lane_count] = j.rn;
  for (int c = 0; c < 6 * branches.count; ++c) state.branch[lane_count * (6 * branches.count * batch + c) + lane] = 0.0;
  state.joint.mode[index] &= std::uint8_t(~mode_points);
}

}  // namespace

void joint_to_points(const Model& model, State& state, const Branches& branches, std::size_t index) {
  const std::size_t batch = index / lane_count, lane = index % lane_count;
  const Patch& patch = model.joints[index];
  const double* slip = &state.slip[3 * lane_count * batch + lane];
  const double a = slip[0], b = slip[lane_count], r = slip[2 * lane_count];
  const bool broken = state.joint.mode[index] & mode_broken;
  for (int i = 0; i < patch.point_count; ++i) {
    const std::size_t at = std::size_t(patch.first_point) + i;
    const PatchPoint& point = model.points[at];
    double* memory = &state.joint.point[4 * at];
    memory[0] = 0.0;
    memory[1] = a - r * point.t;
    memory[2] = b + r * point.s;
    memory[3] = broken ? 1.0 : 0.0;
    state.joint.broken[at] = broken;
    for (int k = 0; k < branches.count; ++k) {
      const double* p = &state.branch[lane_count * 6 * (branches.count * batch + k) + lane];
      const auto row = [&](int c) { return p[lane_count * c]; };
      double* q = &state.joint.point_branch[3 * (branches.count * at + k)];
      q[0] = row(0) + row(4) * point.t - row(5) * point.s;
      q[1] = row(1) - row(3) * point.t;
      q[2] = row(2) + row(3) * point.s;
    }
  }
  state.joint.mode[index] |= mode_points;
  state.joint.mode[index] &= std::uint8_t(~mode_broken);
}

PassReport PatchPass::batches(std::size_t begin, std::size_t end) const {
  PassReport report;
  const double* pose = state->pose.data();
  for (std::size_t k = begin; k < end; ++k) {
    const JointBatch& batch = model->batches[k];
    const std::size_t first = lane_count * k;
    std::uint8_t* mode = &state->joint.mode[first];
    // 1. Lanes that are on the intact path.
    LaneMask keep{};
    int candidates = 0;
    for (int lane = 0; lane < batch.count; ++lane)
      if (!(mode[lane] & (mode_points | mode_gone)) && shortcut) keep[lane] = -1, ++candidates;
    if (candidates > 0) {
      // 2. Elastic jump, admissibility at the corners, excursions that ask for a new clipping.
      const Jump<Lanes> j = lanes_jump(batch, pose);
      auto* slip = reinterpret_cast<Lanes*>(&state->slip[3 * lane_count * k]);
      const LaneElastic e = {{j.n, j.s - slip[0], j.t - slip[1], j.rn - slip[2], j.rs, j.rt}};
      const Lanes* corners = &model->batch_corners[batch.first_corner];
      const LaneStrength strength = strengths(*model, mode, first, batch.count);
      LaneCheck check = check_corners(batch, corners, e, strength);
      LaneMask broken{};
      for (int lane = 0; lane < batch.count; ++lane) broken[lane] = (mode[lane] & mode_broken) ? -1 : 0;
      const LaneMask open = keep & broken & check.open;
      const LaneMask closed = keep & check.admissible & ~open;
      const LaneMask stays = open | closed;
      const LaneMask far = stays & ((j.s * j.s + j.t * j.t > batch.limit_slip2) |
                                    (j.rn * j.rn + j.rs * j.rs + j.rt * j.rt > batch.limit_turn2));
      report.reclip |= any(far);
      if (any(open)) follow_open(batch, corners, e, open, slip, &state->joint.largest[2 * first]);
      // 3. Damping branches and the wrench.
      Lanes loss = splat(0.0);
      auto* p = reinterpret_cast<Lanes*>(state->branch.data()) + 6 * branches.count * k;
      const LaneElastic v = branches.count ? advance_lanes(branches, batch, e, open, stays, p, loss) : e;
      Triple<Lanes> force, moment;
      world_wrench(lanes_resultant(batch, v), j, force, moment);
      store_lanes(force, moment, batch, closed, wrenches + wrench_width * first);
      if (branches.count)
        for (int lane = 0; lane < batch.count; ++lane)
          if (closed[lane]) state->joint.energy[3 * (first + lane) + 2] += loss[lane];
      // 4. Lanes that failed the check go point by point from here on.
      const LaneMask fails = keep & ~stays;
      for (int lane = 0; lane < batch.count; ++lane) {
        if (fails[lane]) joint_to_points(*model, *state, branches, first + lane);
        if (stays[lane]) ++report.intact;
      }
    }
    // 5. Point by point.
    for (int lane = 0; lane < batch.count; ++lane) {
      const std::size_t index = first + lane;
      if ((mode[lane] & mode_gone) || (shortcut && !(mode[lane] & mode_points))) continue;
      if (!(mode[lane] & mode_points)) joint_to_points(*model, *state, branches, index);
      report.reclip |= point_patch(*model, model->joints[index], index, model->points.data(), pose, branches, state->joint,
                                   wrenches + wrench_width * index);
      ++report.points;
      if ((mode[lane] & mode_broken) && shortcut) to_intact(*model, *state, branches, k, lane, index);
    }
  }
  return report;
}

PassReport PatchPass::loose_joints(std::size_t begin, std::size_t end) const {
  PassReport report;
  for (std::size_t i = begin + model->batched_joints; i < end + model->batched_joints; ++i) {
    if (state->joint.mode[i] & mode_gone) continue;
    report.reclip |= point_patch(*model, model->joints[i], i, model->points.data(), state->pose.data(), branches, state->joint,
                                 wrenches + wrench_width * i);
    ++report.points;
  }
  return report;
}

PassReport PatchPass::contacts(std::size_t begin, std::size_t end) const {
  PassReport report;
  for (std::size_t i = begin; i < end; ++i) {
    report.reclip |= point_patch(*model, state->contacts[i], i, state->contact_points.data(), state->pose.data(), branches,
                                 state->contact, wrenches + wrench_width * (model->joints.size() + i));
    ++report.points;
  }
  return report;
}

}  // namespace voussoir
