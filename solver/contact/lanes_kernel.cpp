// Eight joints at a time. Lanes on the intact path are six generalised springs each; the others go point by point, the
// same point of all eight side by side. What is rare (a lane that fails its check, opens, comes back) stands apart from
// what every step does, and reads memory of its own.
#include <algorithm>

#include "solver/contact/patch_kernel.h"
#include "solver/contact/wrench.h"

namespace voussoir {

namespace {

[[gnu::always_inline]] inline Triple<Lanes> load(const Lanes* x) {
  return {x[0], x[1], x[2]};
}

struct LanePoses {
  Triple<Lanes> u;
  Quat<Lanes> q;
};

[[gnu::always_inline]] inline LanePoses gather(const double* pose, const std::int32_t* bodies) {
  Lanes r[lane_count];
  for (int lane = 0; lane < lane_count; ++lane)
    r[lane] = *reinterpret_cast<const Lanes*>(pose + pose_width * std::size_t(bodies[lane]));
  transpose(r);
  return {{r[0], r[1], r[2]}, {r[3], {r[4], r[5], r[6]}}};
}

[[gnu::always_inline]] inline Jump<Lanes> lanes_jump(const JointBatch& batch, const double* pose) {
  const LanePoses a = gather(pose, batch.a), b = gather(pose, batch.b);
  Lanes same = a.q.w * b.q.w + dot(a.q.v, b.q.v);
  const Lanes sign = select(less(same, splat(0.0)), splat(-1.0), splat(1.0));
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
  return local_jump(move_a, move_b, load(batch.place), Triple<Lanes>{zero, zero, zero}, relative, norm, frame);
}

/// Strengths of the eight joints: of the bond, and of what is left when it is lost.
struct LaneStrength {
  Lanes tension, cohesion, tangent, residual_cohesion, residual_tangent, dilation;
  LaneMask brittle;
};

[[gnu::always_inline]] inline LaneStrength strength_of(const LawConstants& law) {
  const bool elastic = law.kind == JointLaw::Kind::elastic;
  LaneStrength s;
  s.tension = splat(elastic ? 1e300 : law.tension);
  s.cohesion = splat(elastic ? 1e300 : law.cohesion);
  s.tangent = splat(elastic ? 0.0 : law.tan_friction);
  s.residual_cohesion = splat(law.residual_cohesion);
  s.residual_tangent = splat(law.residual_tan_friction);
  s.dilation = splat(law.tan_dilation);
  s.brittle = LaneMask::first(law.kind == JointLaw::Kind::brittle ? lane_count : 0);
  return s;
}

[[gnu::noinline]] LaneStrength mixed_strengths(const Model& model, const JointBatch& batch) {
  LaneStrength s = strength_of(model.laws[std::size_t(model.joints[std::size_t(batch.first_joint)].law)]);
  for (int lane = 1; lane < batch.count; ++lane) {
    const LaneMask only = without(LaneMask::first(lane + 1), LaneMask::first(lane));
    const Patch& joint = model.joints[std::size_t(batch.first_joint + lane)];
    const LaneStrength one = strength_of(model.laws[std::size_t(joint.law)]);
    const auto take = [&](Lanes& to, Lanes from) { to = select(only, from, to); };
    take(s.tension, one.tension), take(s.cohesion, one.cohesion), take(s.tangent, one.tangent);
    take(s.residual_cohesion, one.residual_cohesion), take(s.residual_tangent, one.residual_tangent);
    take(s.dilation, one.dilation);
    s.brittle = without(s.brittle, only) | (one.brittle & only);
  }
  return s;
}

[[gnu::always_inline]] inline LaneStrength strengths(const Model& model, const JointBatch& batch) {
  return batch.law >= 0 ? strength_of(model.laws[std::size_t(batch.law)]) : mixed_strengths(model, batch);
}

/// The elastic generalised jump of the intact path.
struct LaneElastic {
  Lanes u[6];  // n, s, t, θn, θs, θt
};

struct LaneCheck {
  LaneMask admissible, open;
};

/// Jump at one place of the joints' planes.
[[gnu::always_inline]] inline Triple<Lanes> jump_at(const LaneElastic& e, Lanes s, Lanes t) {
  return {e.u[0] + e.u[4] * t - e.u[5] * s, e.u[1] - e.u[3] * t, e.u[2] + e.u[3] * s};
}

[[gnu::always_inline]] inline void check_corner(const JointBatch& batch, const LaneElastic& e, Lanes s, Lanes t,
                                                Lanes tension, Lanes cohesion, Lanes tangent, LaneCheck& check) {
  const Triple<Lanes> u = jump_at(e, s, t);
  const Lanes sigma = batch.kn * u.x;
  const Lanes limit = cohesion - sigma * tangent;
  const Lanes shear2 = batch.ks * batch.ks * (u.y * u.y + u.z * u.z);
  const Lanes zero = splat(0.0);
  check.admissible &= at_most(sigma, tension) & at_most(zero, limit) & at_most(shear2, limit * limit);
  check.open &= at_most(zero, u.x);
}

[[gnu::noinline]] LaneCheck check_polygons(const Model& model, const JointBatch& batch, const LaneElastic& e,
                                           Lanes tension, Lanes cohesion, Lanes tangent, LaneMask keep) {
  LaneCheck check = {keep, keep};
  const Lanes* corner = &model.batch_corners[std::size_t(batch.first_corner)];
  for (int c = 0; c < batch.corners; ++c, corner += 2)
    check_corner(batch, e, corner[0], corner[1], tension, cohesion, tangent, check);
  return check;
}

/// The elastic traction field is affine and the admissible set convex: the corners decide for the whole polygon, and
/// those of a rectangle about it are on the safe side.
[[gnu::always_inline]] inline LaneCheck check_corners(const Model& model, const JointBatch& batch, const LaneElastic& e,
                                                      const LaneStrength& strength, LaneMask broken, LaneMask keep) {
  const Lanes tension = select(broken, splat(0.0), strength.tension);
  const Lanes cohesion = select(broken, strength.residual_cohesion, strength.cohesion);
  const Lanes tangent = select(broken, strength.residual_tangent, strength.tangent);
  const Lanes a = batch.half_s, b = batch.half_t;
  LaneCheck check = {keep, keep};
  check_corner(batch, e, a, b, tension, cohesion, tangent, check);
  check_corner(batch, e, -a, b, tension, cohesion, tangent, check);
  check_corner(batch, e, -a, -b, tension, cohesion, tangent, check);
  check_corner(batch, e, a, -b, tension, cohesion, tangent, check);
  if (batch.rectangles || !any(without(keep, check.admissible))) return check;
  return check_polygons(model, batch, e, tension, cohesion, tangent, keep);
}

/// Largest opening and the plastic slip field of patches that are wholly open.
[[gnu::noinline]] void follow_open(const Model& model, const JointBatch& batch, const LaneElastic& e, LaneMask open,
                                   Lanes* slip, std::uint8_t* mode, double* largest) {
  for (int c = 0; c < 3; ++c) slip[c] = select(open, slip[c] + e.u[c + 1], slip[c]);
  Lanes most = splat(0.0);
  const Lanes* corner = &model.batch_corners[std::size_t(batch.first_corner)];
  for (int c = 0; c < batch.corners; ++c, corner += 2) most = larger(jump_at(e, corner[0], corner[1]).x, most);
  for (int lane = 0; lane < batch.count; ++lane)
    if (open[lane]) {
      largest[2 * lane] = std::max(largest[2 * lane], most[lane]);
      mode[lane] |= mode_slid;
    }
}

/// Elastic plus viscous generalised jump; the branches of open lanes relax, those of lanes that close start from
/// nothing. Adds the work done on them, by the mean of their tractions at both ends of the step.
template <int count>
[[gnu::always_inline]] inline LaneElastic advance_lanes(const Branches& branches, const JointBatch& batch,
                                                        const LaneElastic& e, LaneMask closed, LaneMask was_open,
                                                        LaneMask keep, Singles* kept, Lanes& work, const Lanes* du) {
  LaneElastic sum = e;
  const Lanes stiffness[6] = {batch.kn * batch.area, batch.ks * batch.area,
                              batch.ks * batch.area, batch.ks * (batch.ss + batch.tt),
                              batch.kn * batch.tt,   batch.kn * batch.ss};
  const Lanes zero = splat(0.0);
  for (int c = 0; c < 6; ++c) {
    Lanes both = zero;
    const Lanes change = select(was_open, e.u[c], du[c]);
    for (int k = 0; k < count; ++k, ++kept) {
      const Lanes then = widen(*kept);
      const Lanes q = select(closed, branches.e[k] * then + branches.g[k] * change, zero);
      sum.u[c] += q;
      both += then + q;
      *kept = narrow(select(keep, q, then));
    }
    work += select(keep, 0.5 * stiffness[c] * both * du[c], zero);
  }
  return sum;
}

[[gnu::always_inline]] inline Resultant<Lanes> lanes_resultant(const JointBatch& b, const LaneElastic& v) {
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

/// Energy that intact lanes hold, J: of the elastic jump, and of the springs of their branches.
template <int count>
void add_energy(const Branches& branches, const JointBatch& b, const LaneElastic& e, LaneMask closed,
                const Singles* kept, Lanes& elastic, Lanes& stored) {
  const Lanes stiffness[6] = {b.kn * b.area,        b.ks * b.area, b.ks * b.area,
                              b.ks * (b.ss + b.tt), b.kn * b.tt,   b.kn * b.ss};
  Lanes springs = splat(0.0), rest = springs;
  for (int c = 0; c < 6; ++c) {
    springs += 0.5 * stiffness[c] * e.u[c] * e.u[c];
    for (int k = 0; k < count; ++k, ++kept)
      rest += 0.5 * branches.stored[k] * stiffness[c] * widen(*kept) * widen(*kept);
  }
  elastic += select(closed, springs, splat(0.0));
  stored += select(closed, rest, splat(0.0));
}

/// What the point path found of its lanes.
struct LanePoints {
  Resultant<Lanes> resultant;
  Lanes friction, fracture, work, opening, slip2, elastic, stored;
  LaneMask all_open, all_broken;
};

/// Brittle Mohr–Coulomb at one point of eight joints: BrittleLaw (solver/model/laws.h) without branches in the flow.
struct LanePoint {
  Lanes n, s, t;  // elastic jump
  LaneMask elastic, open, broken;
  Lanes friction, fracture;  // J/m2
};

/// Elastic jump (n, s, t) of trial, that of the pass before, and how much the jump has changed since.
struct LaneTrial {
  Triple<Lanes> now, before, du;
};

[[gnu::always_inline]] inline LanePoint brittle_point(const JointBatch& b, const LaneStrength& law, const LaneTrial& e,
                                                      LaneMask was_broken, Lanes& slip, Lanes& keep) {
  const Lanes zero = splat(0.0);
  const auto [n, s, t] = e.now;
  const Lanes sigma = b.kn * n, shear2 = b.ks * b.ks * (s * s + t * t);
  LanePoint p;
  LaneMask breaks{};
  if (!all(was_broken)) {
    const Lanes limit = law.cohesion - sigma * law.tangent;
    const LaneMask holds = at_most(sigma, law.tension) & at_most(zero, limit) & at_most(shear2, limit * limit);
    breaks = ~(was_broken | holds);
  }
  p.broken = was_broken | breaks;
  p.open = p.broken & at_most(zero, n);
  const Lanes limit = law.residual_cohesion - sigma * law.residual_tangent;
  const LaneMask slides = without(p.broken, p.open) & less(limit * limit, shear2);
  slip = zero, keep = splat(1.0);
  if (any(slides)) {
    const Lanes shear = square_root(shear2);
    slip = select(slides, (shear - limit) / (b.ks + b.kn * law.dilation * law.residual_tangent), zero);
    keep = select(slides, 1.0 - b.ks * slip / shear, keep);
  }
  p.elastic = ~(p.open | slides | breaks);
  p.n = select(p.open, zero, n - slip * law.dilation);
  p.s = select(p.open, zero, keep * s);
  p.t = select(p.open, zero, keep * t);
  p.friction = p.fracture = zero;
  if (all(p.elastic)) return p;
  // Work done on the springs by the mean of the tractions at both ends of the step, less what they now hold more: by
  // the traction at the end alone the ledger would leak in proportion to the step.
  const auto [nb, sb, tb] = e.before;
  const Lanes lost_shear =
      0.5 * b.ks * ((p.s + sb) * e.du.y + (p.t + tb) * e.du.z - (p.s * p.s + p.t * p.t) + (sb * sb + tb * tb));
  const Lanes lost_normal = 0.5 * b.kn * ((p.n + nb) * e.du.x - p.n * p.n + nb * nb);
  p.friction = select(without(was_broken, p.elastic), lost_shear + b.kn * p.n * law.dilation * slip, zero);
  p.fracture = select(breaks, lost_shear + lost_normal, zero);
  return p;
}

/// Points of a batch: from its rectangles, or from the table.
struct PointRows {
  const JointBatch& batch;
  const LineRule& rule;
  const Lanes* table;
  int i = 0, along = 0, across = 0;
  Lanes s, t, weight;

  PointRows(const Model& model, const JointBatch& b)
      : batch(b),
        rule(model.rule),
        table(reinterpret_cast<const Lanes*>(model.points.data()) + 3 * std::size_t(b.first_point)) {}
  bool next() {
    if (i == batch.points) return false;
    if (batch.rectangles) {
      s = rule.x[along] * batch.half_s, t = rule.x[across] * batch.half_t;
      weight = rule.w[along] * rule.w[across] * batch.area;
      if (++across == rule.count) across = 0, ++along;
    } else {
      s = table[3 * i], t = table[3 * i + 1], weight = table[3 * i + 2];
    }
    ++i;
    return true;
  }
};

template <int count>
LanePoints points_of_lanes(const Model& model, const JointBatch& b, const LaneStrength& law, const Jump<Lanes>& j,
                           const Branches& branches, LaneMask active, const Lanes* change, bool energies,
                           PatchMemory& memory) {
  const Lanes zero = splat(0.0);
  LanePoints sum{
      {zero, zero, zero, zero, zero, zero, zero, zero, zero}, zero, zero, zero, zero, zero, zero, zero, active, active};
  Resultant<Lanes>& q = sum.resultant;
  auto* plastic = reinterpret_cast<Lanes*>(memory.point.data()) + 4 * std::size_t(b.first_point);
  auto* kept = reinterpret_cast<Singles*>(memory.point_branch.data()) + 3 * count * std::size_t(b.first_point);
  std::uint8_t* broken = &memory.broken[lane_count * std::size_t(b.first_point)];
  for (PointRows at(model, b); at.next(); plastic += 4, broken += lane_count, kept += 3 * count) {
    const Lanes s = at.s, t = at.t, w = at.weight;
    const Triple<Lanes> u = {j.n + j.rs * t - j.rt * s, j.s - j.rn * t, j.t + j.rn * s};
    LaneTrial e;
    e.du = {change[0] + change[4] * t - change[5] * s, change[1] - change[3] * t, change[2] + change[3] * s};
    const Lanes plastic_n = b.dilates ? plastic[0] : zero;
    e.now = {u.x - plastic_n, u.y - plastic[1], u.z - plastic[2]};
    e.before = e.now - e.du;
    const LaneBytes flags = load_bytes(broken);
    const LaneMask was = bytes_with(flags, 1);
    Lanes slip, keep;
    const LanePoint r = brittle_point(b, law, e, was, slip, keep);
    const LaneMask yields = active & (r.open | ~r.elastic);
    if (any(yields)) {  // most points rest, and what is not written need not be written back
      if (b.dilates) plastic[0] = select(yields, select(r.open, zero, plastic_n + slip * law.dilation), plastic_n);
      plastic[1] = select(yields, select(r.open, u.y, plastic[1] + (1.0 - keep) * e.now.y), plastic[1]);
      plastic[2] = select(yields, select(r.open, u.z, plastic[2] + (1.0 - keep) * e.now.z), plastic[2]);
    }
    const LaneMask idle = bytes_with(flags, 2);  // broken, and its branches are empty
    const LaneMask broken_now = (active & r.broken) | without(was, active);
    const LaneMask idle_now = without(active, r.elastic) | without(idle, active);
    if (any((broken_now ^ was) | (idle_now ^ idle))) store_flags(broken_now, idle_now, broken);
    Triple<Lanes> v = {r.n, r.s, r.t};
    if (count > 0 && any(active & (r.elastic | ~idle))) {  // what was and is empty need not be read
      const LaneMask opened = was & less(zero, e.before.x);
      const Triple<Lanes> since = {r.n - select(opened, zero, e.before.x), r.s - e.before.y, r.t - e.before.z};
      const LaneMask live = active & r.elastic;
      const auto advance = [&](int c, Lanes step, Lanes du, Lanes& viscous) {
        Lanes both = zero;
        for (int k = 0; k < count; ++k) {
          Singles& row = kept[3 * k + c];
          const Lanes then = widen(row);
          const Lanes now = select(live, branches.e[k] * then + branches.g[k] * step, zero);
          viscous += now;
          both += then + now;
          row = narrow(select(active, now, then));
        }
        return both * du;
      };
      const Lanes normal = advance(0, since.x, e.du.x, v.x);
      const Lanes shear = advance(1, since.y, e.du.y, v.y) + advance(2, since.z, e.du.z, v.z);
      sum.work += 0.5 * w * (b.kn * normal + b.ks * shear);
    }
    if (energies) {
      sum.elastic += 0.5 * w * (b.kn * r.n * r.n + b.ks * (r.s * r.s + r.t * r.t));
      for (int k = 0; k < count; ++k) {
        const Lanes n = widen(kept[3 * k]), x = widen(kept[3 * k + 1]), y = widen(kept[3 * k + 2]);
        sum.stored += 0.5 * w * branches.stored[k] * (b.kn * n * n + b.ks * (x * x + y * y));
      }
    }
    const Lanes sigma = w * b.kn * v.x, ts = w * b.ks * v.y, tt = w * b.ks * v.z;
    q.n += sigma, q.s += ts, q.t += tt;
    q.sn += s * sigma, q.tn += t * sigma;
    q.ss += s * ts, q.ts += t * ts, q.st += s * tt, q.tt += t * tt;
    sum.friction += w * r.friction;
    sum.fracture += w * r.fracture;
    sum.opening = larger(sum.opening, select(r.broken, u.x, zero));
    const Lanes slipped2 = plastic[1] * plastic[1] + plastic[2] * plastic[2];
    sum.slip2 = larger(sum.slip2, select(r.open, zero, slipped2));
    sum.all_open &= r.open;
    sum.all_broken &= r.broken;
  }
  return sum;
}

/// Energies, largest opening and slip of the lanes that went point by point.
void note_points(const LanePoints& found, LaneMask active, int count, std::size_t first, PatchMemory& memory) {
  const Lanes slip = square_root(found.slip2);
  for (int lane = 0; lane < count; ++lane) {
    if (!active[lane]) continue;
    double* energy = &memory.energy[3 * (first + std::size_t(lane))];
    energy[0] += found.friction[lane], energy[1] += found.fracture[lane], energy[2] += found.work[lane];
    double* most = &memory.largest[2 * (first + std::size_t(lane))];
    most[0] = std::max(most[0], found.opening[lane]);
    most[1] = std::max(most[1], slip[lane]);
  }
}

/// Patches that are wholly open and broken go back to the intact path: their plastic slip is a rigid field again.
void to_intact(const Jump<Lanes>& j, const Branches& branches, LaneMask back, int count, std::uint8_t* mode,
               Lanes* slip, Singles* kept) {
  slip[0] = select(back, j.s, slip[0]);
  slip[1] = select(back, j.t, slip[1]);
  slip[2] = select(back, j.rn, slip[2]);
  for (int c = 0; c < 6 * branches.count; ++c) kept[c] = narrow(select(back, splat(0.0), widen(kept[c])));
  for (int lane = 0; lane < count; ++lane)
    if (back[lane]) mode[lane] = std::uint8_t((mode[lane] & ~mode_points) | mode_broken | mode_open | mode_slid);
}

Resultant<Lanes> merge(LaneMask first, const Resultant<Lanes>& a, LaneMask second, const Resultant<Lanes>& b) {
  const Lanes zero = splat(0.0);
  const auto pick = [&](Lanes x, Lanes y) { return select(first, x, select(second, y, zero)); };
  return {pick(a.n, b.n),   pick(a.s, b.s),   pick(a.t, b.t),   pick(a.sn, b.sn), pick(a.tn, b.tn),
          pick(a.st, b.st), pick(a.ts, b.ts), pick(a.ss, b.ss), pick(a.tt, b.tt)};
}

/// What a tile finds of its joints.
struct TileFindings {
  int intact = 0, points = 0;
  LaneMask reclip;
  Lanes work = splat(0.0);                          // J, done on the branches of the intact path
  Lanes elastic = splat(0.0), stored = splat(0.0);  // J, where energies are wanted
};

/// One batch, from its pose to its wrenches, with `count` branches.
template <int count>
struct BatchPass {
  const PatchPass& pass;
  const JointBatch& batch;
  std::size_t k, first;
  std::uint8_t* mode;
  LaneBytes modes;
  Jump<Lanes> jump;
  LaneStrength strength;
  Lanes* slip;
  Singles* kept;    // branches of the intact path
  Lanes change[6];  // of the jump since the pass before
  alignas(64) double rows[lane_count * wrench_width];

  [[gnu::always_inline]] BatchPass(const PatchPass& p, std::size_t index)
      : pass(p),
        batch(p.model->batches[index]),
        k(index),
        first(std::size_t(batch.first_joint)),
        mode(&p.state->joint.mode[first]),
        modes(load_bytes(mode, batch.count)),
        jump(lanes_jump(batch, p.state->pose.data())),
        strength(strengths(*p.model, batch)),
        slip(reinterpret_cast<Lanes*>(p.state->slip.data()) + 3 * index),
        kept(reinterpret_cast<Singles*>(p.state->branch.data()) + 6 * count * index) {}

  /// Intact lanes: checked at the corners, advanced if they stay; returns which did, and which of those carry load.
  struct Intact {
    LaneMask stays, closed;
    Resultant<Lanes> resultant;
  };
  [[gnu::always_inline]] Intact intact_lanes(LaneMask keep, TileFindings& findings) {
    LaneElastic e = {{jump.n, jump.s, jump.t, jump.rn, jump.rs, jump.rt}};
    if (any(bytes_with(modes, mode_slid)))
      for (int c = 0; c < 3; ++c) e.u[c + 1] -= slip[c];
    const LaneMask broken = bytes_with(modes, mode_broken);
    const LaneCheck check = check_corners(*pass.model, batch, e, strength, broken, keep);
    const LaneMask open = broken & check.open, closed = without(check.admissible, open);
    if (any(open)) follow_open(*pass.model, batch, e, open, slip, mode, &pass.state->joint.largest[2 * first]);
    const LaneMask was_open = keep & bytes_with(modes, mode_open);
    if (any(open ^ was_open))
      for (int lane = 0; lane < batch.count; ++lane)
        if (keep[lane]) mode[lane] = std::uint8_t((mode[lane] & ~mode_open) | (open[lane] ? mode_open : 0));
    const LaneMask stays = open | closed;
    const LaneElastic elastic = e;
    if constexpr (count > 0)
      e = advance_lanes<count>(pass.branches, batch, e, closed, was_open, stays, kept, findings.work, change);
    if (pass.energies)
      add_energy<count>(pass.branches, batch, elastic, closed, kept, findings.elastic, findings.stored);
    return {stays, closed, lanes_resultant(batch, e)};
  }

  /// Lanes point by point; the few whose law has no lane form are left to point_patch().
  Resultant<Lanes> point_lanes(LaneMask active, TileFindings& findings) {
    const LanePoints found = points_of_lanes<count>(*pass.model, batch, strength, jump, pass.branches, active, change,
                                                    pass.energies, pass.state->joint);
    note_points(found, active, batch.count, first, pass.state->joint);
    findings.elastic += select(active, found.elastic, splat(0.0));
    findings.stored += select(active, found.stored, splat(0.0));
    const LaneMask back = active & found.all_open & found.all_broken;
    if (pass.shortcut && any(back)) to_intact(jump, pass.branches, back, batch.count, mode, slip, kept);
    return found.resultant;
  }

  /// The change since the pass before, of jumps rounded to single precision, so that the changes add up to the jump;
  /// point_patch() keeps the last jump of its lanes itself.
  [[gnu::always_inline]] void note_change(LaneMask others) {
    auto* last = reinterpret_cast<Singles*>(&pass.state->joint.last[last_index(k, 0)]);
    const Lanes now[6] = {jump.n, jump.s, jump.t, jump.rn, jump.rs, jump.rt};
    for (int c = 0; c < 6; ++c) {
      const Singles rounded = narrow(now[c]);
      const Lanes before = widen(last[c]), after = widen(rounded);
      change[c] = after - before;
      last[c] = any(others) ? narrow(select(others, before, after)) : rounded;
    }
  }

  void leave_intact(LaneMask points) {
    for (int lane = 0; lane < batch.count; ++lane)
      if (points[lane] && !(mode[lane] & mode_points))
        joint_to_points(*pass.model, *pass.state, pass.branches, first + std::size_t(lane));
  }

  [[gnu::always_inline]] void store_rows(const Triple<Lanes>& f, const Triple<Lanes>& m) {
    Lanes r[lane_count] = {f.x, f.y, f.z, m.x, m.y, m.z, Lanes{}, Lanes{}};
    transpose(r);
    for (int lane = 0; lane < lane_count; ++lane) reinterpret_cast<Lanes*>(rows)[lane] = r[lane];
  }

  /// Adds the wrenches to the sums of their bodies, joint by joint.
  [[gnu::always_inline]] void add_up() const {
    auto* sums = reinterpret_cast<Lanes*>(pass.sums);
    for (int lane = 0; lane < batch.count; ++lane) {
      const Lanes row = reinterpret_cast<const Lanes*>(rows)[lane];
      sums[batch.sum_a[lane]] += row;
      sums[batch.sum_b[lane]] -= row;
    }
    if (pass.wrenches) std::copy_n(rows, wrench_width * batch.count, pass.wrenches + wrench_width * first);
  }

  [[gnu::always_inline]] void run(TileFindings& findings) {
    const LaneMask live = without(LaneMask::first(batch.count), bytes_with(modes, mode_gone));
    const LaneMask keep = pass.shortcut ? without(live, bytes_with(modes, mode_points)) : LaneMask{};
    note_change(without(live, keep | strength.brittle));
    Intact intact{};
    if (any(keep)) intact = intact_lanes(keep, findings);
    const LaneMask points = without(live, intact.stays);
    Triple<Lanes> force, moment;
    if (all(intact.closed)) {
      world_wrench(intact.resultant, jump, force, moment);
      store_rows(force, moment);
    } else {
      mixed(intact, points, findings);
    }
    add_up();
    const Lanes slip2 = jump.s * jump.s + jump.t * jump.t;
    const Lanes turn2 = jump.rn * jump.rn + jump.rs * jump.rs + jump.rt * jump.rt;
    findings.reclip |=
        live & (less(pass.model->slip_limit2(batch.area), slip2) | less(splat(pass.model->turn_limit2()), turn2));
    findings.intact += count_of(intact.stays);
    findings.points += count_of(points);
  }

  /// A batch in which some lanes are open, gone or go point by point: those that fail the check from here on.
  [[gnu::noinline]] void mixed(const Intact& intact, LaneMask points, TileFindings& findings) {
    Resultant<Lanes> by_points{};
    const LaneMask brittle = points & strength.brittle, others = without(points, brittle);
    if (any(points)) leave_intact(points);
    if (any(brittle)) by_points = point_lanes(brittle, findings);
    Triple<Lanes> force, moment;
    world_wrench(merge(intact.closed, intact.resultant, brittle, by_points), jump, force, moment);
    store_rows(force, moment);
    if (!any(others)) return;
    for (int lane = 0; lane < batch.count; ++lane)
      if (others[lane])
        point_patch(*pass.model, pass.model->joints[first + std::size_t(lane)], first + std::size_t(lane),
                    pass.model->points, pass.state->pose.data(), pass.branches, pass.state->joint,
                    rows + wrench_width * lane);
  }
};

double sum_of(Lanes x) {
  double sum = 0.0;
  for (int lane = 0; lane < lane_count; ++lane) sum += x[lane];
  return sum;
}

template <int count>
PassReport joints_of(const PatchPass& pass, std::size_t index) {
  const Tile& tile = pass.model->tiles[index];
  std::fill(pass.sums + wrench_width * std::size_t(tile.first_sum),
            pass.sums + wrench_width * std::size_t(tile.end_sum), 0.0);
  TileFindings found;
  for (std::int32_t k = tile.first_batch; k < tile.end_batch; ++k) BatchPass<count>(pass, std::size_t(k)).run(found);
  if constexpr (count > 0) *reinterpret_cast<Lanes*>(&pass.state->branch_work[lane_count * index]) += found.work;
  if (pass.energies) pass.energies[index] = {sum_of(found.elastic), sum_of(found.stored)};
  PassReport report;
  report.reclip = any(found.reclip);
  report.intact = found.intact, report.points = found.points;
  return report;
}

}  // namespace

PassReport PatchPass::joints(std::size_t tile) const {
  static_assert(most_branches == 4);
  switch (branches.count) {
    case 0:
      return joints_of<0>(*this, tile);
    case 1:
      return joints_of<1>(*this, tile);
    case 2:
      return joints_of<2>(*this, tile);
    case 3:
      return joints_of<3>(*this, tile);
    default:
      return joints_of<4>(*this, tile);
  }
}

}  // namespace voussoir
