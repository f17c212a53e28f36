// The point-by-point path of eight patches side by side, joints or contacts, and what else both kinds need.
#pragma once
#include <algorithm>

#include "solver/contact/patch_kernel.h"
#include "solver/contact/wrench.h"

namespace voussoir {

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

/// Strengths of eight patches: of the bond, and of what is left when it is lost.
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

[[gnu::noinline]] inline LaneStrength mixed_strengths(const Model& model, const Patch* patches, int count) {
  LaneStrength s = strength_of(model.laws[std::size_t(patches[0].law)]);
  for (int lane = 1; lane < count; ++lane) {
    const LaneMask only = without(LaneMask::first(lane + 1), LaneMask::first(lane));
    const LaneStrength one = strength_of(model.laws[std::size_t(patches[lane].law)]);
    const auto take = [&](Lanes& to, Lanes from) { to = select(only, from, to); };
    take(s.tension, one.tension), take(s.cohesion, one.cohesion), take(s.tangent, one.tangent);
    take(s.residual_cohesion, one.residual_cohesion), take(s.residual_tangent, one.residual_tangent);
    take(s.dilation, one.dilation);
    s.brittle = without(s.brittle, only) | (one.brittle & only);
  }
  return s;
}

/// Of a batch whose patches, eight or fewer, are these.
[[gnu::always_inline]] inline LaneStrength strengths(const Model& model, const JointBatch& batch,
                                                     const Patch* patches) {
  return batch.law >= 0 ? strength_of(model.laws[std::size_t(batch.law)])
                        : mixed_strengths(model, patches, batch.count);
}

/// What the point path found of its lanes.
struct LanePoints {
  Resultant<Lanes> resultant{};
  Lanes friction{}, fracture{}, work{}, opening{}, slip2{}, elastic{}, stored{};
  LaneMask all_open, all_broken;
};

/// Points of a batch: from its rectangles, or from the table.
struct PointRows {
  const JointBatch& batch;
  const LineRule& rule;
  const Lanes* table;
  int i = 0, along = 0, across = 0;
  Lanes s, t, weight;

  PointRows(const LineRule& of_rectangles, const Array<double>& points, const JointBatch& b)
      : batch(b),
        rule(of_rectangles),
        table(reinterpret_cast<const Lanes*>(points.data()) + 3 * std::size_t(b.first_point)) {}
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

/// What brittle Mohr–Coulomb (BrittleLaw, solver/model/laws.h) asks of one point of eight patches before anything is
/// changed.
struct LaneTrial {
  Triple<Lanes> now, du;  // elastic jump of trial; change of the jump since the pass before
  Lanes plastic_n, plastic_s, plastic_t, shear2, limit;
  LaneMask was_broken, was_idle, breaks, open, slides;
};

/// The points of eight patches whose jump, gaps included, is `jump`, and has changed by `change` since the pass before.
/// Lanes that are `following` were wholly open in it: their plastic slip was the jump. Every point computes all it
/// might need but a root and a quotient: a step that asked at every point what it is about to do would mostly guess
/// wrong.
template <int count>
struct PointsPass {
  const LaneStrength& law;
  const Jump<Lanes>& jump;
  const Branches& branches;
  LaneMask active, following;
  const Lanes* change;
  bool energies;
  Lanes kn, ks, ease;  // 1/(what shear and compression give way to slip)
  bool dilates;
  Lanes *plastic, *rest;
  Singles* kept;
  std::uint8_t* broken;

  PointsPass(const JointBatch& b, const LaneStrength& strength, const Jump<Lanes>& j, const Branches& of,
             LaneMask which, LaneMask follow, const Lanes* since, bool with_energies, PatchMemory& memory)
      : law(strength),
        jump(j),
        branches(of),
        active(which),
        following(follow),
        change(since),
        energies(with_energies),
        kn(b.kn),
        ks(b.ks),
        ease(1.0 / (b.ks + b.kn * strength.dilation * strength.residual_tangent)),
        dilates(any(less(splat(0.0), strength.dilation))),
        plastic(reinterpret_cast<Lanes*>(memory.point.data()) + 2 * std::size_t(b.first_point)),
        rest(reinterpret_cast<Lanes*>(memory.point_rest.data()) + 2 * std::size_t(b.first_point)),
        kept(reinterpret_cast<Singles*>(memory.point_branch.data()) + 3 * count * std::size_t(b.first_point)),
        broken(&memory.broken[lane_count * std::size_t(b.first_point)]) {}

  LanePoints run(PointRows at) {
    LanePoints sum;
    sum.all_open = sum.all_broken = active;
    for (int i = 0; at.next(); ++i) {
      const LaneTrial trial = try_point(i, at.s, at.t);
      if (any(active & trial.slides))
        enter<true>(i, at, trial, sum);
      else
        enter<false>(i, at, trial, sum);
    }
    return sum;
  }

 private:
  [[gnu::always_inline]] LaneTrial try_point(int i, Lanes s, Lanes t) const {
    const Lanes zero = splat(0.0);
    LaneTrial e;
    const Triple<Lanes> u = {jump.n + jump.rs * t - jump.rt * s, jump.s - jump.rn * t, jump.t + jump.rn * s};
    e.du = {change[0] + change[4] * t - change[5] * s, change[1] - change[3] * t, change[2] + change[3] * s};
    e.plastic_n = dilates ? rest[2 * i] : zero;
    e.plastic_s = select(following, u.y - e.du.y, plastic[2 * i]);
    e.plastic_t = select(following, u.z - e.du.z, plastic[2 * i + 1]);
    e.now = {u.x - e.plastic_n, u.y - e.plastic_s, u.z - e.plastic_t};
    const LaneBytes flags = load_bytes(broken + lane_count * i);
    e.was_broken = bytes_with(flags, 1), e.was_idle = bytes_with(flags, 2);
    const Lanes sigma = kn * e.now.x;
    e.shear2 = ks * ks * (e.now.y * e.now.y + e.now.z * e.now.z);
    const Lanes bond = law.cohesion - sigma * law.tangent;
    const LaneMask holds = at_most(sigma, law.tension) & at_most(zero, bond) & at_most(e.shear2, bond * bond);
    e.breaks = ~(e.was_broken | holds);
    e.open = (e.was_broken | e.breaks) & at_most(zero, e.now.x);
    e.limit = law.residual_cohesion - sigma * law.residual_tangent;
    e.slides = without(e.was_broken | e.breaks, e.open) & less(e.limit * e.limit, e.shear2);
    return e;
  }

  template <bool slides>
  [[gnu::always_inline]] void enter(int i, const PointRows& at, const LaneTrial& e, LanePoints& sum) const {
    const Lanes zero = splat(0.0), s = at.s, t = at.t, w = at.weight;
    const auto [n0, s0, t0] = e.now;
    const LaneMask is_broken = e.was_broken | e.breaks;
    const LaneMask elastic = ~(e.open | e.slides | e.breaks);
    Lanes slip = zero, keep = splat(1.0);
    if constexpr (slides) {
      const Lanes shear = square_root(e.shear2);
      slip = select(e.slides, (shear - e.limit) * ease, zero);
      keep = select(e.slides, 1.0 - ks * slip / shear, keep);
    }
    const Triple<Lanes> now = {select(e.open, zero, n0 - slip * law.dilation), select(e.open, zero, keep * s0),
                               select(e.open, zero, keep * t0)};
    const Triple<Lanes> before = e.now - e.du;
    const LaneMask changes = active & (e.open | e.slides | e.breaks | following);
    const Lanes moved_s = e.plastic_s + select(e.open, s0, (1.0 - keep) * s0);
    const Lanes moved_t = e.plastic_t + select(e.open, t0, (1.0 - keep) * t0);
    if (any(changes)) {  // most points rest, and what is not written need not be written back
      if (dilates) store_lanes(changes, select(e.open, zero, e.plastic_n + slip * law.dilation), rest[2 * i]);
      store_lanes(changes, moved_s, plastic[2 * i]);
      store_lanes(changes, moved_t, plastic[2 * i + 1]);
    }
    // Work done on the springs by the mean of the tractions at both ends of the step, less what they now hold more: by
    // the traction at the end alone the ledger would leak in proportion to the step.
    const Lanes lost_shear = 0.5 * ks *
                             ((now.y + before.y) * e.du.y + (now.z + before.z) * e.du.z -
                              (now.y * now.y + now.z * now.z) + (before.y * before.y + before.z * before.z));
    const Lanes lost_normal = 0.5 * kn * ((now.x + before.x) * e.du.x - now.x * now.x + before.x * before.x);
    sum.friction += select(without(e.was_broken, elastic), w * (lost_shear + kn * now.x * law.dilation * slip), zero);
    sum.fracture += select(e.breaks, w * (lost_shear + lost_normal), zero);
    // Broken, and broken with empty branches.
    const LaneMask broken_now = (active & is_broken) | without(e.was_broken, active);
    const LaneMask idle_now = without(active, elastic) | without(e.was_idle, active);
    if (any((broken_now ^ e.was_broken) | (idle_now ^ e.was_idle)))
      store_flags(broken_now, idle_now, broken + lane_count * i);
    Triple<Lanes> v = now;
    if constexpr (count > 0) {
      const LaneMask opened = e.was_broken & less(zero, before.x), live = active & elastic;
      const Triple<Lanes> since = {now.x - select(opened, zero, before.x), now.y - before.y, now.z - before.z};
      Singles* row = kept + 3 * count * i;
      const Lanes normal = advance(row, live, since.x, e.du.x, v.x);
      const Lanes shear = advance(row + 1, live, since.y, e.du.y, v.y) + advance(row + 2, live, since.z, e.du.z, v.z);
      sum.work += 0.5 * w * (kn * normal + ks * shear);
      if (energies) sum.stored += 0.5 * w * stored(row);
    }
    if (energies) sum.elastic += 0.5 * w * (kn * now.x * now.x + ks * (now.y * now.y + now.z * now.z));
    add_tractions(s, t, w * kn * v.x, w * ks * v.y, w * ks * v.z, sum.resultant);
    sum.opening = larger(sum.opening, select(is_broken, n0 + e.plastic_n, zero));
    sum.slip2 = larger(sum.slip2, select(e.open, zero, moved_s * moved_s + moved_t * moved_t));
    sum.all_open &= e.open;
    sum.all_broken &= is_broken;
  }

  /// One component of a point's branches by an elastic move of `step`; returns Σ (then + now) du, of which half is the
  /// work done on them per stiffness.
  [[gnu::always_inline]] Lanes advance(Singles* row, LaneMask live, Lanes step, Lanes du, Lanes& viscous) const {
    Lanes all = splat(0.0);
    for (int k = 0; k < count; ++k) {
      const Lanes then = widen(row[3 * k]);
      const Lanes now = select(live, branches.e[k] * then + branches.g[k] * step, splat(0.0));
      viscous += now;
      all += then + now;
      store_lanes(active, now, row[3 * k]);
    }
    return all * du;
  }

  [[gnu::always_inline]] Lanes stored(const Singles* row) const {
    Lanes sum = splat(0.0);
    for (int k = 0; k < count; ++k) {
      const Lanes n = widen(row[3 * k]), x = widen(row[3 * k + 1]), y = widen(row[3 * k + 2]);
      sum += branches.stored[k] * (kn * n * n + ks * (x * x + y * y));
    }
    return sum;
  }

  [[gnu::always_inline]] static void add_tractions(Lanes s, Lanes t, Lanes sigma, Lanes ts, Lanes tt,
                                                   Resultant<Lanes>& q) {
    q.n += sigma, q.s += ts, q.t += tt;
    q.sn += s * sigma, q.tn += t * sigma;
    q.ss += s * ts, q.ts += t * ts, q.st += s * tt, q.tt += t * tt;
  }
};

/// Energies, largest opening and slip of the lanes that went point by point.
inline void note_points(const LanePoints& found, LaneMask active, int count, std::size_t first, PatchMemory& memory) {
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

[[gnu::always_inline]] inline Resultant<Lanes> select(LaneMask m, const Resultant<Lanes>& a,
                                                      const Resultant<Lanes>& b) {
  return {select(m, a.n, b.n),   select(m, a.s, b.s),   select(m, a.t, b.t),
          select(m, a.sn, b.sn), select(m, a.tn, b.tn), select(m, a.st, b.st),
          select(m, a.ts, b.ts), select(m, a.ss, b.ss), select(m, a.tt, b.tt)};
}

/// Wrenches as rows of wrench_width numbers.
[[gnu::always_inline]] inline void store_wrenches(const Triple<Lanes>& f, const Triple<Lanes>& m, double* rows) {
  Lanes r[lane_count] = {f.x, f.y, f.z, m.x, m.y, m.z, Lanes{}, Lanes{}};
  transpose(r);
  for (int lane = 0; lane < lane_count; ++lane) reinterpret_cast<Lanes*>(rows)[lane] = r[lane];
}

/// Puts `now` in the place of the last jump and returns how it has changed, of jumps rounded to single precision, so
/// that the changes add up to the jump; lanes of `others` keep their last jump.
[[gnu::always_inline]] inline void note_change(const Jump<Lanes>& j, LaneMask others, Singles* last, Lanes* change) {
  const Lanes now[6] = {j.n, j.s, j.t, j.rn, j.rs, j.rt};
  for (int c = 0; c < 6; ++c) {
    const Singles rounded = narrow(now[c]);
    const Lanes before = widen(last[c]), after = widen(rounded);
    change[c] = after - before;
    last[c] = any(others) ? narrow(select(others, before, after)) : rounded;
  }
}

/// Lanes that have slid or turned past their limits.
[[gnu::always_inline]] inline LaneMask past_limits(const Model& model, const JointBatch& batch, const Jump<Lanes>& j) {
  const Lanes slip2 = j.s * j.s + j.t * j.t;
  const Lanes turn2 = j.rn * j.rn + j.rs * j.rs + j.rt * j.rt;
  return less(model.slip_limit2(batch.area), slip2) | less(splat(model.turn_limit2()), turn2);
}

inline double sum_of(Lanes x) {
  double sum = 0.0;
  for (int lane = 0; lane < lane_count; ++lane) sum += x[lane];
  return sum;
}

}  // namespace voussoir
