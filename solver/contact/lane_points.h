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

/// `places`: where the eight poses begin.
[[gnu::always_inline]] inline LanePoses gather(const double* pose, const std::int32_t* places) {
  Lanes r[lane_count];
  for (int lane = 0; lane < lane_count; ++lane) r[lane] = *reinterpret_cast<const Lanes*>(pose + places[lane]);
  transpose(r);
  return {{r[0], r[1], r[2]}, {r[3], {r[4], r[5], r[6]}}};
}

/// Asks for eight poses, see fetch().
[[gnu::always_inline]] inline void fetch_poses(const double* pose, const std::int32_t* places) {
  for (int lane = 0; lane < lane_count; ++lane) fetch(pose + places[lane], pose_width * sizeof(double));
}

/// Asks for one of so many parts of a record, see fetch().
template <std::size_t parts, class Record>
[[gnu::always_inline]] inline void fetch_part(const Record& record, std::size_t part) {
  constexpr std::size_t size = (sizeof(Record) / cache_line + parts - 1) / parts * cache_line;
  fetch(reinterpret_cast<const char*>(&record) + part * size, size);
}

/// Strengths of eight patches: of the bond, whose tension ends at the apex of its cone, and of what is left when it is
/// lost.
struct LaneStrength {
  Lanes tension, cohesion, tangent, residual_cohesion, residual_tangent, dilation;
  LaneMask brittle;
  LaneMask tie;
};

[[gnu::always_inline]] inline LaneStrength strength_of(const LawConstants& law) {
  LaneStrength s;
  s.tension = splat(law.most_tension);
  s.cohesion = splat(law.most_cohesion);
  s.tangent = splat(law.slope);
  s.residual_cohesion = splat(law.residual_cohesion);
  s.residual_tangent = splat(law.residual_tan_friction);
  s.dilation = splat(law.tan_dilation);
  s.brittle = LaneMask::first(law.kind == JointLaw::Kind::brittle ? lane_count : 0);
  s.tie = LaneMask::first(law.kind == JointLaw::Kind::tie ? lane_count : 0);
  return s;
}

[[gnu::noinline]] inline LaneStrength mixed_strengths(const Model& model, const PatchBatch& batch) {
  LaneStrength s = strength_of(model.laws[std::size_t(batch.law_of[0])]);
  for (int lane = 1; lane < lane_count; ++lane) {
    if (batch.law_of[lane] == batch.law_of[lane - 1]) continue;  // laws come in runs: take this one to the end
    const LaneMask only = ~LaneMask::first(lane);
    const LaneStrength one = strength_of(model.laws[std::size_t(batch.law_of[lane])]);
    const auto take = [&](Lanes& to, Lanes from) { to = select(only, from, to); };
    take(s.tension, one.tension), take(s.cohesion, one.cohesion), take(s.tangent, one.tangent);
    take(s.residual_cohesion, one.residual_cohesion), take(s.residual_tangent, one.residual_tangent);
    take(s.dilation, one.dilation);
    s.brittle = without(s.brittle, only) | (one.brittle & only);
    s.tie = without(s.tie, only) | (one.tie & only);
  }
  return s;
}

[[gnu::always_inline]] inline LaneStrength strengths(const Model& model, const PatchBatch& batch) {
  return batch.law >= 0 ? strength_of(model.laws[std::size_t(batch.law)]) : mixed_strengths(model, batch);
}

/// What the point path found of its lanes.
struct LanePoints {
  Resultant<Lanes> resultant{};
  Lanes friction{}, fracture{}, work{}, opening{}, slip2{}, elastic{}, stored{};
  LaneMask all_open, all_broken;
  bool yields = false;  // some point of some lane: without it there is no friction, fracture or new slip
};

constexpr int rows_ahead = 6;  // what is kept of a row is asked for so much earlier, see fetch()

/// One point of eight patches, and its share of PointRows::area().
struct RowPlace {
  Lanes s, t, weight;
};

/// Points of a batch: from its rectangles, or from the table.
struct PointRows {
  const JointBatch& batch;
  const LineRule& rule;
  const Lanes* table;

  PointRows(const LineRule& of_rectangles, const Array<double>& points, const JointBatch& b)
      : batch(b),
        rule(of_rectangles),
        table(reinterpret_cast<const Lanes*>(points.data()) + 3 * std::size_t(b.first_point)) {}

  Lanes area() const { return batch.rectangles ? batch.area : splat(1.0); }

  /// visit(row, place, jump there, its change)
  template <class Field>
  [[gnu::always_inline]] void each(const Field& jump, const Field& change, const auto& visit) const {
    if (batch.rectangles) {
      for (int i = 0, along = 0; along < rule.count; ++along) {
        const Lanes s = rule.x[along] * batch.half_s;
        const auto u = jump.line(s), du = change.line(s);
        for (int across = 0; across < rule.count; ++across, ++i) {
          const Lanes t = rule.x[across] * batch.half_t;
          visit(i, RowPlace{s, t, splat(rule.w[along] * rule.w[across])}, u.at(t), du.at(t));
        }
      }
    } else {
      for (int i = 0; i < batch.points; ++i) {
        fetch(table + 3 * (i + rows_ahead), 3 * sizeof(Lanes));
        const RowPlace at = {table[3 * i], table[3 * i + 1], table[3 * i + 2]};
        visit(i, at, jump.at(at.s, at.t), change.at(at.s, at.t));
      }
    }
  }
};

/// What brittle Mohr–Coulomb (BrittleLaw, solver/model/laws.h) asks of one point of eight patches before anything is
/// changed.
struct LaneTrial {
  Triple<Lanes> u, du;  // jump, and its change since the pass before
  Triple<Lanes> now;    // elastic jump of trial
  Lanes plastic_n, plastic_s, plastic_t;
  Lanes shear2, limit;  // m², m: square of its shear, and what of it friction holds
  LaneMask was_broken, was_open, breaks, open, slides;
  LaneMask yields;  // in these the state of the point changes: it slides, breaks, opens or closes
};

/// How eight rigid patches move over their planes: what they displace at a point of them, gaps included.
struct RigidField {
  Lanes n, s, t, rn, rs, rt;
  explicit RigidField(const Jump<Lanes>& j) : n(j.n), s(j.s), t(j.t), rn(j.rn), rs(j.rs), rt(j.rt) {}
  explicit RigidField(const Lanes* change)
      : n(change[0]), s(change[1]), t(change[2]), rn(change[3]), rs(change[4]), rt(change[5]) {}
  [[gnu::always_inline]] Triple<Lanes> at(Lanes x, Lanes y) const { return line(x).at(y); }

  struct Line {
    Lanes n, s, t, rn, rs;
    [[gnu::always_inline]] Triple<Lanes> at(Lanes y) const { return {n + rs * y, s - rn * y, t}; }
  };
  [[gnu::always_inline]] Line line(Lanes x) const { return {n - rt * x, s, t + rn * x, rn, rs}; }
};

/// Several branches are a correction of some per cent: in single precision, as they are kept. They lose 1 − e of
/// themselves, because e itself, near one, would be rounded to another relaxation time.
template <int count>
struct SingleBranches {
  Singles fade[count + 1], gain[count + 1];  // of each
  explicit SingleBranches(const Branches& of) {
    for (int k = 0; k < count; ++k) fade[k] = singles(1.0 - of.e[k]), gain[k] = singles(of.g[k]);
  }
  [[gnu::always_inline]] Singles next(int k, Singles then, Singles step) const {
    return then + (gain[k] * step - fade[k] * then);
  }
};

/// The points of eight patches whose jump is `jump`, and has changed by `change` since the pass before: any field that
/// is affine over the patch. Most points stay as they were, closed and elastic or open: only a row in which some lane
/// does not asks for more. `contacts`: lanes may be `following`, which were wholly open in the pass before: their
/// plastic slip was the jump.
template <int count, bool contacts, class Field = RigidField>
struct PointsPass {
  const Branches& branches;
  LaneStrength law;
  Field jump, change;
  LaneMask active, following;
  bool energies, dilates;
  Lanes kn, ks;
  Lanes opens, bond, bond_slope, grip, grip_slope;  // of the law, as jumps: see set_limits()
  Lanes ease;                                       // slip for each metre of shear beyond its limit
  Lanes *plastic, *rest;
  Singles* kept;
  std::uint8_t* broken;
  SingleBranches<count> several;

  [[gnu::always_inline]] PointsPass(const PatchBatch& b, const LaneStrength& strength, const Field& now,
                                    const Branches& of, LaneMask which, LaneMask follow, const Field& since,
                                    bool with_energies, PatchMemory& memory)
      : branches(of),
        law(strength),
        jump(now),
        change(since),
        active(which),
        following(follow),
        energies(with_energies),
        dilates(any(less(splat(0.0), strength.dilation))),
        kn(b.kn),
        ks(b.ks),
        plastic(reinterpret_cast<Lanes*>(memory.point.data()) + 2 * std::size_t(b.first_point)),
        rest(reinterpret_cast<Lanes*>(memory.point_rest.data()) + 2 * std::size_t(b.first_point)),
        kept(reinterpret_cast<Singles*>(memory.point_branch.data()) + 3 * count * std::size_t(b.first_point)),
        broken(&memory.broken[lane_count * std::size_t(b.first_point)]),
        several(of) {
    set_limits();
  }

  [[gnu::always_inline]] LanePoints run(const auto& rows) const {
    Sums sum;
    sum.all_open = sum.all_broken = active;
    rows.each(
        jump, change,
        [&](int i, const RowPlace& at, const Triple<Lanes>& u, const Triple<Lanes>& du) __attribute__((always_inline)) {
          fetch_row(i + rows_ahead);
          const LaneTrial trial = try_point(i, u, du);
          if (any(trial.yields))
            sum.yields = true, yield(i, at, trial, sum);
          else
            stay(i, at, trial, sum);
        });
    return total(sum, rows.area());
  }

 private:
  /// Sums over the points, of jumps and without what all points of a patch have in common.
  struct Sums : LanePoints {
    Lanes work_n{}, work_s{}, elastic_n{}, elastic_s{};
  };
  [[gnu::always_inline]] LanePoints total(Sums& sum, Lanes area) const {
    const Lanes n = kn * area, s = ks * area;
    Resultant<Lanes>& q = sum.resultant;
    q.n *= n, q.sn *= n, q.tn *= n;
    q.s *= s, q.ss *= s, q.ts *= s;
    q.t *= s, q.st *= s, q.tt *= s;
    if constexpr (count > 0) sum.work = 0.5 * (n * sum.work_n + s * sum.work_s);
    if (energies) sum.elastic = 0.5 * (n * sum.elastic_n + s * sum.elastic_s), sum.stored *= 0.5 * area;
    if (sum.yields) sum.friction *= area, sum.fracture *= area;
    return sum;
  }

  /// The law in elastic jumps: a bond breaks beyond the opening `opens`, and beyond the shear `bond` − `bond_slope` n;
  /// what is left slides beyond `grip` − `grip_slope` n.
  [[gnu::always_inline]] void set_limits() {
    const Lanes soft = 1.0 / ks, softer = kn * soft;
    opens = law.tension / kn;
    bond = soft * law.cohesion, bond_slope = softer * law.tangent;
    grip = soft * law.residual_cohesion, grip_slope = softer * law.residual_tangent;
    ease = dilates ? 1.0 / (1.0 + grip_slope * law.dilation) : splat(1.0);
  }

  /// Asks for what is kept of a row to come, of this batch or of the next.
  [[gnu::always_inline]] void fetch_row(int i) const {
    fetch(plastic + 2 * i, 2 * sizeof(Lanes));
    fetch(kept + 3 * count * i, 3 * count * sizeof(Singles));
    fetch(broken + lane_count * i, lane_count);
  }

  [[gnu::always_inline]] LaneTrial try_point(int i, const Triple<Lanes>& u, const Triple<Lanes>& du) const {
    const Lanes zero = splat(0.0);
    LaneTrial e;
    e.u = u;
    e.du = du;
    e.plastic_n = dilates ? rest[2 * i] : zero;
    e.plastic_s = plastic[2 * i], e.plastic_t = plastic[2 * i + 1];
    if constexpr (contacts) {
      e.plastic_s = select(following, e.u.y - e.du.y, e.plastic_s);
      e.plastic_t = select(following, e.u.z - e.du.z, e.plastic_t);
    }
    e.now = {e.u.x - e.plastic_n, e.u.y - e.plastic_s, e.u.z - e.plastic_t};
    const LaneBytes flags = load_bytes(broken + lane_count * i);
    e.was_broken = bytes_with(flags, 1), e.was_open = bytes_with(flags, 2);
    e.shear2 = e.now.y * e.now.y + e.now.z * e.now.z;
    e.limit = grip - grip_slope * e.now.x;
    const Lanes most = bond - bond_slope * e.now.x;
    const LaneMask apart = at_most(zero, e.now.x), past_grip = less(e.limit * e.limit, e.shear2);
    const LaneMask holds = at_most(e.now.x, opens) & at_most(e.shear2, most * most);
    const LaneMask loose = ~(without(holds, e.was_broken));  // was broken or breaks
    e.breaks = without(loose, e.was_broken);
    e.open = loose & apart;
    e.slides = without(loose & past_grip, apart);
    e.yields = active & (e.slides | e.breaks | (e.open ^ e.was_open));
    if constexpr (contacts) e.yields |= active & following;
    return e;
  }

  /// Every lane goes on as it was.
  [[gnu::always_inline]] void stay(int i, const RowPlace& at, const LaneTrial& e, Sums& sum) const {
    store_lanes(active & e.open, e.u.y, plastic[2 * i]);
    store_lanes(active & e.open, e.u.z, plastic[2 * i + 1]);
    const Lanes zero = splat(0.0);
    const Triple<Lanes> now = {select(e.open, zero, e.now.x), select(e.open, zero, e.now.y),
                               select(e.open, zero, e.now.z)};
    act(i, at, e, now, ~e.open, sum);
  }

  /// Some slide, break, open or close; every lane computes all it might need.
  [[gnu::always_inline]] void yield(int i, const RowPlace& at, const LaneTrial& e, Sums& sum) const {
    const Lanes zero = splat(0.0), w = at.weight;
    const auto [n0, s0, t0] = e.now;
    const LaneMask elastic = ~(e.open | e.slides | e.breaks);
    const Lanes shear = square_root(e.shear2);
    const Lanes slip = select(e.slides, (shear - e.limit) * ease, zero);
    const Lanes keep = select(e.slides, 1.0 - slip / shear, splat(1.0));
    const Triple<Lanes> now = {select(e.open, zero, n0 - slip * law.dilation), select(e.open, zero, keep * s0),
                               select(e.open, zero, keep * t0)};
    const Triple<Lanes> before = e.now - e.du;
    const Lanes moved_s = e.plastic_s + select(e.open, s0, (1.0 - keep) * s0);
    const Lanes moved_t = e.plastic_t + select(e.open, t0, (1.0 - keep) * t0);
    if (dilates) store_lanes(active, select(e.open, zero, e.plastic_n + slip * law.dilation), rest[2 * i]);
    store_lanes(active, moved_s, plastic[2 * i]);
    store_lanes(active, moved_t, plastic[2 * i + 1]);
    sum.slip2 = larger(sum.slip2, select(e.open, zero, moved_s * moved_s + moved_t * moved_t));
    // Work done on the springs by the mean of the tractions at both ends of the step, less what they now hold more: by
    // the traction at the end alone the ledger would leak in proportion to the step.
    const Lanes lost_shear = 0.5 * ks *
                             ((now.y + before.y) * e.du.y + (now.z + before.z) * e.du.z -
                              (now.y * now.y + now.z * now.z) + (before.y * before.y + before.z * before.z));
    const Lanes lost_normal = 0.5 * kn * ((now.x + before.x) * e.du.x - now.x * now.x + before.x * before.x);
    sum.friction += select(without(e.was_broken, elastic), w * (lost_shear + kn * now.x * law.dilation * slip), zero);
    sum.fracture += select(e.breaks, w * (lost_shear + lost_normal), zero);
    store_flags((active & (e.was_broken | e.breaks)) | without(e.was_broken, active),
                (active & e.open) | without(e.was_open, active), broken + lane_count * i);
    act(i, at, e, now, elastic, sum);
  }

  /// What points at an elastic jump of `now` do. The branches of lanes that are not `live` are emptied.
  [[gnu::always_inline]] void act(int i, const RowPlace& at, const LaneTrial& e, const Triple<Lanes>& now,
                                  LaneMask live, Sums& sum) const {
    const Lanes w = at.weight;
    Triple<Lanes> v = now;
    if constexpr (count > 0) {
      // What was open is pressed from where it closed.
      const LaneMask was_apart = e.was_broken & less(e.du.x, e.now.x);
      const Triple<Lanes> twice = advance(i, live, e.du, select(was_apart, now.x, e.du.x), v);
      sum.work_n += w * (twice.x * e.du.x), sum.work_s += w * (twice.y * e.du.y + twice.z * e.du.z);
      if (energies) sum.stored += w * stored(kept + 3 * count * i);
    }
    if (energies) sum.elastic_n += w * (now.x * now.x), sum.elastic_s += w * (now.y * now.y + now.z * now.z);
    add_tractions(at.s, at.t, w * v.x, w * v.y, w * v.z, sum.resultant);
    sum.opening = larger(sum.opening, select(e.was_broken | e.breaks, e.u.x, splat(0.0)));
    sum.all_open &= e.open;
    sum.all_broken &= e.was_broken | e.breaks;
  }

  /// A point's branches follow the jump, `step_n` along the normal; adds their q to `v` and returns the sum of q at
  /// both ends of the step: by the mean of the two work is done on them.
  [[gnu::always_inline]] Triple<Lanes> advance(int i, LaneMask live, const Triple<Lanes>& du, Lanes step_n,
                                               Triple<Lanes>& v) const {
    if constexpr (count == 1)
      return advance_one(i, live, du, step_n, v);
    else
      return advance_several(i, live, du, step_n, v);
  }

  /// A single branch may be that of Rayleigh damping, which is stiff and forgets at once: in double precision.
  [[gnu::always_inline]] Triple<Lanes> advance_one(int i, LaneMask live, const Triple<Lanes>& du, Lanes step_n,
                                                   Triple<Lanes>& v) const {
    Singles* row = kept + 3 * i;
    const auto one = [&](int c, Lanes step, Lanes& viscous) {
      const Lanes then = widen(row[c]);
      const Lanes now = select(live, branches.e[0] * then + branches.g[0] * step, splat(0.0));
      viscous += now;
      store_lanes(active, narrow(now), row[c]);
      return then + now;
    };
    return {one(0, step_n, v.x), one(1, du.y, v.y), one(2, du.z, v.z)};
  }

  [[gnu::always_inline]] Triple<Lanes> advance_several(int i, LaneMask live, const Triple<Lanes>& du, Lanes step_n,
                                                       Triple<Lanes>& v) const {
    const Singles step[3] = {narrow(step_n), narrow(du.y), narrow(du.z)};
    Singles before[3], now[3];
    Singles* row = kept + 3 * count * i;
    for (int k = 0; k < count; ++k)
      for (int c = 0; c < 3; ++c, ++row) {
        const Singles then = *row, q = within(live, several.next(k, then, step[c]));
        before[c] = k == 0 ? then : before[c] + then;
        now[c] = k == 0 ? q : now[c] + q;
        store_lanes(active, q, *row);
      }
    v.x += widen(now[0]), v.y += widen(now[1]), v.z += widen(now[2]);
    return {widen(before[0] + now[0]), widen(before[1] + now[1]), widen(before[2] + now[2])};
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
[[gnu::always_inline]] inline void note_points(const LanePoints& found, LaneMask active, std::size_t batch,
                                               PatchMemory& memory) {
  auto* energy = reinterpret_cast<Lanes*>(&memory.energy[energy_index({batch, 0}, 0)]);
  auto* largest = reinterpret_cast<Lanes*>(&memory.largest[largest_index({batch, 0}, 0)]);
  store_lanes(active, energy[2] + found.work, energy[2]);
  store_lanes(active & less(largest[0], found.opening), found.opening, largest[0]);
  if (!found.yields) return;
  store_lanes(active, energy[0] + found.friction, energy[0]);
  store_lanes(active, energy[1] + found.fracture, energy[1]);
  store_lanes(active, larger(largest[1], square_root(found.slip2)), largest[1]);
}

[[gnu::always_inline]] inline Resultant<Lanes> select(LaneMask m, const Resultant<Lanes>& a,
                                                      const Resultant<Lanes>& b) {
  return {select(m, a.n, b.n),   select(m, a.s, b.s),   select(m, a.t, b.t),
          select(m, a.sn, b.sn), select(m, a.tn, b.tn), select(m, a.st, b.st),
          select(m, a.ts, b.ts), select(m, a.ss, b.ss), select(m, a.tt, b.tt)};
}

/// Wrenches of eight patches as rows of wrench_width numbers.
struct WrenchRows {
  Lanes row[lane_count];
  [[gnu::always_inline]] WrenchRows(const Triple<Lanes>& f, const Triple<Lanes>& m)
      : row{f.x, f.y, f.z, m.x, m.y, m.z, Lanes{}, Lanes{}} {
    transpose(row);
  }
};
[[gnu::always_inline]] inline void store_wrenches(const Triple<Lanes>& f, const Triple<Lanes>& m, double* rows) {
  const WrenchRows wrenches(f, m);
  std::memcpy(rows, wrenches.row, sizeof(wrenches.row));
}

/// Puts `now` in the place of the last jump and returns how it has changed, of jumps rounded to single precision, so
/// that the changes add up to the jump; lanes of `others` keep their last jump.
[[gnu::always_inline]] inline void note_change(const Jump<Lanes>& j, LaneMask others, Singles* last, Lanes* change) {
  const Lanes now[6] = {j.n, j.s, j.t, j.rn, j.rs, j.rt};
  for (int c = 0; c < 6; ++c) {
    const Singles rounded = narrow(now[c]);
    change[c] = widen(rounded - last[c]);
    if (any(others))
      store_lanes(~others, rounded, last[c]);
    else
      last[c] = rounded;
  }
}

/// See Model::slip_limit2() and turn_limit2().
struct SlidingLimits {
  Lanes slip2, least_area, turn2;
  explicit SlidingLimits(const Model& model)
      : slip2(splat(model.contact.reclip_slip * model.contact.reclip_slip)),
        least_area(splat(model.least_slip_area())),
        turn2(splat(model.turn_limit2())) {}
  [[gnu::always_inline]] Lanes slip_limit2(Lanes area) const { return slip2 * larger(area, least_area); }
};

/// Lanes that have slid or turned past their limits.
[[gnu::always_inline]] inline LaneMask past_limits(const SlidingLimits& limits, Lanes area, const Jump<Lanes>& j) {
  const Lanes slip = j.s * j.s + j.t * j.t;
  const Lanes turn = j.rn * j.rn + j.rs * j.rs + j.rt * j.rt;
  return less(limits.slip_limit2(area), slip) | less(limits.turn2, turn);
}

inline double sum_of(Lanes x) {
  double sum = 0.0;
  for (int lane = 0; lane < lane_count; ++lane) sum += x[lane];
  return sum;
}

}  // namespace voussoir
