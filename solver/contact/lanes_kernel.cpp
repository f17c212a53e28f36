// Eight joints at a time. Lanes on the intact path are six generalised springs each; the others go point by point, the
// same point of all eight side by side.
#include <algorithm>

#include "solver/contact/patch_kernel.h"
#include "solver/contact/wrench.h"

namespace voussoir {

namespace {

Triple<Lanes> load(const Lanes* x) {
  return {x[0], x[1], x[2]};
}

struct LanePoses {
  Triple<Lanes> u;
  Quat<Lanes> q;
};

LanePoses gather(const double* pose, const std::int32_t* bodies) {
  Lanes r[lane_count];
  for (int lane = 0; lane < lane_count; ++lane)
    r[lane] = *reinterpret_cast<const Lanes*>(pose + pose_width * std::size_t(bodies[lane]));
  transpose(r);
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

/// Strengths of the eight joints: of the bond, and of what is left when it is lost.
struct LaneStrength {
  Lanes tension, cohesion, tangent, residual_cohesion, residual_tangent, dilation;
  LaneMask brittle;
};

LaneStrength strengths(const Model& model, const JointBatch& batch) {
  LaneStrength s;
  for (int lane = 0; lane < lane_count; ++lane) {
    const LawConstants& law = model.laws[batch.law[lane]];
    const bool elastic = law.kind == JointLaw::Kind::elastic;
    s.tension[lane] = elastic ? 1e300 : law.tension;
    s.cohesion[lane] = elastic ? 1e300 : law.cohesion;
    s.tangent[lane] = elastic ? 0.0 : law.tan_friction;
    s.residual_cohesion[lane] = law.residual_cohesion;
    s.residual_tangent[lane] = law.residual_tan_friction;
    s.dilation[lane] = law.tan_dilation;
    s.brittle[lane] = law.kind == JointLaw::Kind::brittle ? -1 : 0;
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
LaneCheck check_corners(const JointBatch& batch, const Lanes* corners, const LaneElastic& e,
                        const LaneStrength& strength, LaneMask broken) {
  LaneMask admissible = batch.kn == batch.kn, open = admissible;
  const Lanes tension = broken ? splat(0.0) : strength.tension;
  const Lanes cohesion = broken ? strength.residual_cohesion : strength.cohesion;
  const Lanes tangent = broken ? strength.residual_tangent : strength.tangent;
  for (int c = 0; c < batch.corners; ++c) {
    const Lanes s = corners[2 * c], t = corners[2 * c + 1];
    const Lanes n = e.u[0] + e.u[4] * t - e.u[5] * s;
    const Lanes us = e.u[1] - e.u[3] * t, ut = e.u[2] + e.u[3] * s;
    const Lanes sigma = batch.kn * n;
    const Lanes limit = cohesion - sigma * tangent;
    const Lanes shear2 = batch.ks * batch.ks * (us * us + ut * ut);
    admissible &= (sigma <= tension) & (limit >= 0.0) & (shear2 <= limit * limit);
    open &= n >= 0.0;
  }
  return {admissible, open};
}

/// Largest opening and the plastic slip field of patches that are wholly open.
void follow_open(const JointBatch& batch, const Lanes* corners, const LaneElastic& e, LaneMask open, Lanes* slip,
                 double* largest) {
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

/// Twice the loss of a branch over the step, per unit stiffness: the work done on it by the mean of its tractions at
/// both ends, less what its spring now holds more, (q₀ + q)(Δu − s (q − q₀)); for a dashpot alone (Rayleigh) 2 q²/g.
inline Lanes branch_loss(const Branches& branches, int k, Lanes then, Lanes q, Lanes du) {
  if (branches.e[k] == 0.0) return 2.0 * branches.loss[k] * q * q;
  return (then + q) * (du - branches.stored[k] * (q - then));
}

/// Elastic plus viscous generalised jump; the branches of open lanes relax, those of lanes that close start from
/// nothing.
LaneElastic advance_lanes(const Branches& branches, const JointBatch& batch, const LaneElastic& e, LaneMask closed,
                          LaneMask was_open, LaneMask keep, Singles* kept, Lanes& loss, const Lanes* du) {
  LaneElastic sum = e;
  const Lanes stiffness[6] = {batch.kn * batch.area, batch.ks * batch.area,
                              batch.ks * batch.area, batch.ks * (batch.ss + batch.tt),
                              batch.kn * batch.tt,   batch.kn * batch.ss};
  for (int c = 0; c < 6; ++c) {
    Lanes twice = splat(0.0);
    const Lanes change = was_open ? e.u[c] : du[c];
    for (int k = 0; k < branches.count; ++k, ++kept) {
      const Lanes then = widen(*kept);
      const Lanes q = closed ? branches.e[k] * then + branches.g[k] * change : splat(0.0);
      sum.u[c] += q;
      twice += branch_loss(branches, k, then, q, du[c]);
      *kept = narrow(keep ? q : then);
    }
    loss += 0.5 * stiffness[c] * twice;
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

void store_lanes(const Triple<Lanes>& f, const Triple<Lanes>& m, const JointBatch& batch, double* wrench) {
  Lanes rows[lane_count] = {f.x, f.y, f.z, m.x, m.y, m.z, Lanes{}, Lanes{}};
  transpose(rows);
  for (int lane = 0; lane < batch.count; ++lane) *reinterpret_cast<Lanes*>(wrench + wrench_width * lane) = rows[lane];
}

/// What the point path found of its lanes.
struct LanePoints {
  Resultant<Lanes> resultant;
  Lanes friction, fracture, damping, opening, slip2;
  LaneMask all_open, all_broken;
};

Lanes largest(Lanes a, Lanes b) {
  return a > b ? a : b;
}

/// Brittle Mohr–Coulomb at one point of eight joints: BrittleLaw (solver/model/laws.h) without branches in the flow.
struct LanePoint {
  Lanes n, s, t;  // elastic jump
  LaneMask elastic, open, broken;
  Lanes friction, fracture;  // J/m2
};

LanePoint brittle_point(const JointBatch& b, const LaneStrength& law, Lanes un, Lanes us, Lanes ut, const Lanes* du,
                        LaneMask active, Lanes* memory, LaneMask was_broken) {
  const Lanes zero = splat(0.0);
  const Lanes n = un - memory[0], s = us - memory[1], t = ut - memory[2];
  const Lanes sigma = b.kn * n, shear2 = b.ks * b.ks * (s * s + t * t);
  const Lanes bonded_limit = law.cohesion - sigma * law.tangent;
  LanePoint p;
  const LaneMask holds =
      ~was_broken & (sigma <= law.tension) & (bonded_limit >= 0.0) & (shear2 <= bonded_limit * bonded_limit);
  const LaneMask breaks = ~was_broken & ~holds;
  p.broken = was_broken | breaks;
  p.open = p.broken & (n >= zero);
  const Lanes limit = law.residual_cohesion - sigma * law.residual_tangent;
  const LaneMask slides = p.broken & ~p.open & (shear2 > limit * limit);
  Lanes slip = zero, keep = splat(1.0);
  if (any(slides)) {
    const Lanes shear = square_root(shear2);
    slip = slides ? (shear - limit) / (b.ks + b.kn * law.dilation * law.residual_tangent) : zero;
    keep = slides ? 1.0 - b.ks * slip / shear : splat(1.0);
  }
  p.elastic = ~(p.open | slides | breaks);
  const Lanes plastic_n = p.open ? zero : memory[0] + slip * law.dilation;
  p.n = p.open ? zero : un - plastic_n;
  p.s = p.open ? zero : keep * s;
  p.t = p.open ? zero : keep * t;
  // Work done on the springs by the mean of the tractions at both ends of the step, less what they now hold more: by
  // the traction at the end alone the ledger would leak in proportion to the step.
  const Lanes sb = s - du[1], tb = t - du[2], nb = n - du[0];
  p.friction = p.fracture = zero;
  if (!any(active & ~p.elastic)) return p;
  const Lanes lost_shear =
      0.5 * b.ks * ((p.s + sb) * du[1] + (p.t + tb) * du[2] - (p.s * p.s + p.t * p.t) + (sb * sb + tb * tb));
  const Lanes lost_normal = 0.5 * b.kn * ((p.n + nb) * du[0] - p.n * p.n + nb * nb);
  p.friction = (was_broken & ~p.elastic) ? lost_shear + b.kn * p.n * law.dilation * slip : zero;
  p.fracture = breaks ? lost_shear + lost_normal : zero;
  const LaneMask moves = active & (p.open | slides);
  if (any(moves)) {  // most points rest, and what is not written need not be written back
    memory[0] = moves ? plastic_n : memory[0];
    memory[1] = moves ? (p.open ? us : memory[1] + (1.0 - keep) * s) : memory[1];
    memory[2] = moves ? (p.open ? ut : memory[2] + (1.0 - keep) * t) : memory[2];
  }
  return p;
}

LanePoints points_of_lanes(const Model& model, const JointBatch& b, const LaneStrength& law, const Jump<Lanes>& j,
                           const Branches& branches, LaneMask active, const Lanes* change, PatchMemory& memory) {
  const Lanes zero = splat(0.0);
  LanePoints sum{{zero, zero, zero, zero, zero, zero, zero, zero, zero}, zero, zero, zero, zero, zero, active, active};
  Resultant<Lanes>& q = sum.resultant;
  const auto* point = reinterpret_cast<const Lanes*>(model.points.data()) + 3 * std::size_t(b.first_point);
  auto* plastic = reinterpret_cast<Lanes*>(memory.point.data()) + 4 * std::size_t(b.first_point);
  auto* kept = reinterpret_cast<Singles*>(memory.point_branch.data()) + 3 * branches.count * std::size_t(b.first_point);
  std::uint8_t* broken = &memory.broken[lane_count * std::size_t(b.first_point)];
  for (int i = 0; i < b.points; ++i, point += 3, plastic += 4, broken += lane_count) {
    const Lanes s = point[0], t = point[1], w = point[2];
    const Lanes un = j.n + j.rs * t - j.rt * s, us = j.s - j.rn * t, ut = j.t + j.rn * s;
    const Lanes du[3] = {change[0] + change[4] * t - change[5] * s, change[1] - change[3] * t,
                         change[2] + change[3] * s};
    const LaneMask flags = load_bytes(broken), was = (flags & 1) != 0, idle = (flags & 2) != 0;
    const Lanes normal = un - plastic[0] - du[0];  // elastic jump at the pass before
    const Lanes ub[3] = {(was & (normal > zero)) ? zero : normal, us - plastic[1] - du[1], ut - plastic[2] - du[2]};
    const LanePoint r = brittle_point(b, law, un, us, ut, du, active, plastic, was);
    store_bytes(active ? (r.broken & 1) | (~r.elastic & 2) : flags, broken);
    Lanes v[3] = {r.n, r.s, r.t};
    const Lanes u[3] = {r.n, r.s, r.t};
    Lanes twice[3] = {zero, zero, zero};
    Singles* row = kept + 3 * branches.count * i;
    const int count = any(active & (r.elastic | ~idle)) ? branches.count : 0;  // what was and is empty need not be read
    for (int k = 0; k < count; ++k)
      for (int c = 0; c < 3; ++c, ++row) {
        const Lanes then = widen(*row);
        const Lanes viscous = r.elastic ? branches.e[k] * then + branches.g[k] * (u[c] - ub[c]) : zero;
        v[c] += viscous;
        twice[c] += branch_loss(branches, k, then, viscous, du[c]);
        *row = narrow(active ? viscous : then);
      }
    sum.damping += 0.5 * w * (b.kn * twice[0] + b.ks * (twice[1] + twice[2]));
    const Lanes sigma = w * b.kn * v[0], ts = w * b.ks * v[1], tt = w * b.ks * v[2];
    q.n += sigma, q.s += ts, q.t += tt;
    q.sn += s * sigma, q.tn += t * sigma;
    q.ss += s * ts, q.ts += t * ts, q.st += s * tt, q.tt += t * tt;
    sum.friction += w * r.friction;
    sum.fracture += w * r.fracture;
    sum.opening = largest(sum.opening, r.broken ? un : zero);
    sum.slip2 = largest(sum.slip2, r.open ? zero : plastic[1] * plastic[1] + plastic[2] * plastic[2]);
    sum.all_open &= r.open;
    sum.all_broken &= r.broken;
  }
  return sum;
}

/// Energies, largest opening and slip of the lanes that went point by point.
void note_points(const LanePoints& found, LaneMask active, int count, std::size_t first, PatchMemory& memory) {
  for (int lane = 0; lane < count; ++lane) {
    if (!active[lane]) continue;
    double* energy = &memory.energy[3 * (first + lane)];
    energy[0] += found.friction[lane], energy[1] += found.fracture[lane], energy[2] += found.damping[lane];
    double* most = &memory.largest[2 * (first + lane)];
    most[0] = std::max(most[0], found.opening[lane]);
    most[1] = std::max(most[1], std::sqrt(found.slip2[lane]));
  }
}

/// Patches that are wholly open and broken go back to the intact path: their plastic slip is a rigid field again.
void to_intact(const Jump<Lanes>& j, const Branches& branches, LaneMask back, int count, std::uint8_t* mode,
               Lanes* slip, Singles* kept) {
  slip[0] = back ? j.s : slip[0];
  slip[1] = back ? j.t : slip[1];
  slip[2] = back ? j.rn : slip[2];
  for (int c = 0; c < 6 * branches.count; ++c) kept[c] = narrow(back ? splat(0.0) : widen(kept[c]));
  for (int lane = 0; lane < count; ++lane)
    if (back[lane]) mode[lane] = std::uint8_t((mode[lane] & ~mode_points) | mode_broken | mode_open);
}

LaneMask mode_mask(const std::uint8_t* mode, int count, int bit) {
  if (count == lane_count) return (load_bytes(mode) & bit) != 0;
  LaneMask m{};
  for (int lane = 0; lane < count; ++lane) m[lane] = (mode[lane] & bit) ? -1 : 0;
  return m;
}

Resultant<Lanes> merge(LaneMask first, const Resultant<Lanes>& a, LaneMask second, const Resultant<Lanes>& b) {
  const Lanes zero = splat(0.0);
  const auto pick = [&](Lanes x, Lanes y) { return first ? x : (second ? y : zero); };
  return {pick(a.n, b.n),   pick(a.s, b.s),   pick(a.t, b.t),   pick(a.sn, b.sn), pick(a.tn, b.tn),
          pick(a.st, b.st), pick(a.ts, b.ts), pick(a.ss, b.ss), pick(a.tt, b.tt)};
}

/// One batch, from its pose to its wrenches.
struct BatchPass {
  /// Minus the number of patches on either path, lane by lane.
  struct Counts {
    LaneMask intact{}, points{};
  };
  const PatchPass& pass;
  std::size_t k;
  const JointBatch& batch;
  std::size_t first;
  std::uint8_t* mode;
  Jump<Lanes> jump;
  LaneStrength strength;
  Lanes* slip;
  Singles* kept;         // branches of the intact path
  Lanes change[6] = {};  // of the jump since the pass before

  /// Intact lanes: checked at the corners, advanced if they stay; returns which did, and which of those carry load.
  struct Intact {
    LaneMask stays, closed;
    Resultant<Lanes> resultant;
  };
  Intact intact_lanes(LaneMask keep) {
    const Jump<Lanes>& j = jump;
    const LaneElastic e = {{j.n, j.s - slip[0], j.t - slip[1], j.rn - slip[2], j.rs, j.rt}};
    const Lanes* corners = &pass.model->batch_corners[batch.first_corner];
    const LaneMask broken = mode_mask(mode, batch.count, mode_broken);
    const LaneCheck check = check_corners(batch, corners, e, strength, broken);
    const LaneMask open = keep & broken & check.open, closed = keep & check.admissible & ~open;
    if (any(open)) follow_open(batch, corners, e, open, slip, &pass.state->joint.largest[2 * first]);
    const LaneMask was_open = keep & mode_mask(mode, batch.count, mode_open);
    if (any(open ^ was_open))
      for (int lane = 0; lane < batch.count; ++lane)
        if (keep[lane]) mode[lane] = std::uint8_t((mode[lane] & ~mode_open) | (open[lane] ? mode_open : 0));
    Lanes loss = splat(0.0);
    const LaneElastic v = pass.branches.count ? advance_lanes(pass.branches, batch, e, closed, was_open, open | closed,
                                                              kept, loss, change)
                                              : e;
    if (pass.branches.count)
      for (int lane = 0; lane < batch.count; ++lane)
        if (closed[lane]) pass.state->joint.energy[3 * (first + lane) + 2] += loss[lane];
    return {open | closed, closed, lanes_resultant(batch, v)};
  }

  /// Lanes point by point; the few whose law has no lane form are left to point_patch().
  Resultant<Lanes> point_lanes(LaneMask active) {
    const LanePoints found =
        points_of_lanes(*pass.model, batch, strength, jump, pass.branches, active, change, pass.state->joint);
    note_points(found, active, batch.count, first, pass.state->joint);
    const LaneMask back = active & found.all_open & found.all_broken;
    if (pass.shortcut && any(back)) to_intact(jump, pass.branches, back, batch.count, mode, slip, kept);
    return found.resultant;
  }

  /// The change since the pass before; point_patch() keeps the last jump of its lanes itself.
  void note_change(LaneMask others) {
    auto* last = reinterpret_cast<Lanes*>(pass.state->joint.last.data()) + 6 * k;
    const Lanes now[6] = {jump.n, jump.s, jump.t, jump.rn, jump.rs, jump.rt};
    for (int c = 0; c < 6; ++c) {
      change[c] = now[c] - last[c];
      last[c] = others ? last[c] : now[c];
    }
  }

  void run(PassReport& report, Counts& counts) {
    const LaneMask gone = mode_mask(mode, batch.count, mode_gone);
    LaneMask live = ~gone, keep{};
    for (int lane = 0; lane < lane_count; ++lane) {
      if (lane >= batch.count)
        live[lane] = 0;
      else if (live[lane] && pass.shortcut && !(mode[lane] & mode_points))
        keep[lane] = -1;
    }
    note_change(live & ~keep & ~strength.brittle);
    Intact intact{};
    if (any(keep)) intact = intact_lanes(keep);
    // Lanes that fail the check go point by point from here on.
    const LaneMask points = live & ~intact.stays;
    Resultant<Lanes> by_points{};
    if (any(points)) {
      for (int lane = 0; lane < batch.count; ++lane)
        if (points[lane] && !(mode[lane] & mode_points))
          joint_to_points(*pass.model, *pass.state, pass.branches, first + lane);
      const LaneMask active = points & strength.brittle;
      if (any(active)) by_points = point_lanes(active);
    }
    Triple<Lanes> force, moment;
    world_wrench(merge(intact.closed, intact.resultant, points, by_points), jump, force, moment);
    double* wrench = pass.wrenches + wrench_width * first;
    store_lanes(force, moment, batch, wrench);
    const LaneMask others = points & ~strength.brittle;
    if (any(others))
      for (int lane = 0; lane < batch.count; ++lane)
        if (others[lane])
          point_patch(*pass.model, pass.model->joints[first + lane], first + lane, pass.model->points,
                      pass.state->pose.data(), pass.branches, pass.state->joint, wrench + wrench_width * lane);
    report.reclip |=
        any(live & ((jump.s * jump.s + jump.t * jump.t > pass.model->slip_limit2(batch.area)) |
                    (jump.rn * jump.rn + jump.rs * jump.rs + jump.rt * jump.rt > pass.model->turn_limit2())));
    counts.intact += intact.stays;
    counts.points += points;
  }
};

}  // namespace

PassReport PatchPass::batches(std::size_t begin, std::size_t end) const {
  PassReport report;
  BatchPass::Counts counts;
  auto* slip = reinterpret_cast<Lanes*>(state->slip.data());
  auto* branch = reinterpret_cast<Singles*>(state->branch.data());
  for (std::size_t k = begin; k < end; ++k) {
    const JointBatch& batch = model->batches[k];
    const std::size_t first = lane_count * k;
    BatchPass{*this,
              k,
              batch,
              first,
              &state->joint.mode[first],
              lanes_jump(batch, state->pose.data()),
              strengths(*model, batch),
              slip + 3 * k,
              branch + 6 * branches.count * k}
        .run(report, counts);
  }
  for (int lane = 0; lane < lane_count; ++lane)
    report.intact -= counts.intact[lane], report.points -= counts.points[lane];
  return report;
}

}  // namespace voussoir
