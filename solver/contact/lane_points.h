// Evaluation point by point of eight patches side by side: joints, contacts, and patches with the fill.
#pragma once
#include "solver/contact/lane_patches.h"
#include "solver/contact/patch_kernel.h"
#include "solver/contact/wrench.h"

namespace voussoir {

/// Strengths of eight patches (Pa; tangents without unit): with bond, where tension ends at the apex of the friction
/// cone, and without bond (`residual_`).
struct LaneStrength {
  Lanes tension, cohesion, tangent, residual_cohesion, residual_tangent, dilation;
  LaneMask brittle;
  LaneMask tie;
  LaneMask composite, crushes;
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
  s.composite = LaneMask::first(is_composite(law) ? lane_count : 0);
  s.crushes = LaneMask::first(crushes(law) ? lane_count : 0);
  return s;
}

[[gnu::noinline]] inline LaneStrength mixed_strengths(const Model& model, const PatchBatch& batch) {
  LaneStrength s = strength_of(model.laws[std::size_t(batch.law_of[0])]);
  for (int lane = 1; lane < lane_count; ++lane) {
    if (batch.law_of[lane] == batch.law_of[lane - 1]) continue;  // equal laws are consecutive
    const LaneMask only = ~LaneMask::first(lane);
    const LaneStrength one = strength_of(model.laws[std::size_t(batch.law_of[lane])]);
    const auto take = [&](Lanes& to, Lanes from) { to = select(only, from, to); };
    take(s.tension, one.tension), take(s.cohesion, one.cohesion), take(s.tangent, one.tangent);
    take(s.residual_cohesion, one.residual_cohesion), take(s.residual_tangent, one.residual_tangent);
    take(s.dilation, one.dilation);
    s.brittle = without(s.brittle, only) | (one.brittle & only);
    s.tie = without(s.tie, only) | (one.tie & only);
    s.composite = without(s.composite, only) | (one.composite & only);
    s.crushes = without(s.crushes, only) | (one.crushes & only);
  }
  return s;
}

[[gnu::always_inline]] inline LaneStrength strengths(const Model& model, const PatchBatch& batch) {
  return batch.law >= 0 ? strength_of(model.laws[std::size_t(batch.law)]) : mixed_strengths(model, batch);
}

/// Results of the evaluation point by point: numbers L and masks M of all lanes or of a side (lane_sides.h). Energies
/// and work are in J, `opening` in m, and `slip2`, the square of the slip, in m².
template <class L, class M>
struct FoundPoints {
  Resultant<L> resultant{};
  L friction{}, fracture{}, work{}, opening{}, slip2{}, elastic{}, stored{};
  M all_open, all_broken;
  bool yields = false;  // whether any point yields; otherwise there is no friction, fracture or new slip
};
using LanePoints = FoundPoints<Lanes, LaneMask>;

constexpr int rows_ahead = 6;  // the data of a row are prefetched this number of rows earlier, see fetch()

/// One point of eight patches, and its share of PointRows::area().
template <class L>
struct RowPlace {
  L s, t, weight;
};

/// Points of a batch, from its rectangles or from the table.
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
  template <class Side, class Field>
  [[gnu::always_inline]] void each(const Field& jump, const Field& change, const auto& visit) const {
    using L = typename Side::Numbers;
    if (batch.rectangles) {
      for (int i = 0, along = 0; along < rule.count; ++along) {
        const L s = rule.x[along] * Side::of(batch.half_s);
        const auto u = jump.line(s), du = change.line(s);
        for (int across = 0; across < rule.count; ++across, ++i) {
          const L t = rule.x[across] * Side::of(batch.half_t);
          visit(i, RowPlace<L>{s, t, Side::splat(rule.w[along] * rule.w[across])}, u.at(t), du.at(t));
        }
      }
    } else {
      for (int i = 0; i < batch.points; ++i) {
        fetch(table + 3 * (i + rows_ahead), 3 * sizeof(Lanes));
        const RowPlace<L> at = {Side::of(table[3 * i]), Side::of(table[3 * i + 1]), Side::of(table[3 * i + 2])};
        visit(i, at, jump.at(at.s, at.t), change.at(at.s, at.t));
      }
    }
  }
};

/// Quantities of brittle Mohr–Coulomb (BrittleLaw, solver/model/laws.h) for one point of eight patches before its
/// update.
template <class L, class M>
struct LaneTrial {
  Triple<L> u, du;  // jump, and its change since the previous pass
  Triple<L> now;    // trial elastic jump
  L plastic_n, plastic_s, plastic_t;
  L shear2, limit;  // m², m: square of its shear, and friction limit of the shear
  M was_broken, was_open, breaks, open, slides;
  M yields;  // lanes in which the point slides, breaks, opens or closes
};

/// Displacement field of eight rigid patches over their planes, including gaps.
template <class L>
struct RigidField {
  L n, s, t, rn, rs, rt;
  [[gnu::always_inline]] Triple<L> at(L x, L y) const { return line(x).at(y); }

  struct Line {
    L n, s, t, rn, rs;
    [[gnu::always_inline]] Triple<L> at(L y) const { return {n + rs * y, s - rn * y, t}; }
  };
  [[gnu::always_inline]] Line line(L x) const { return {n - rt * x, s, t + rn * x, rn, rs}; }
  template <class Side>
  [[gnu::always_inline]] RigidField<typename Side::Numbers> part() const {
    return {Side::of(n), Side::of(s), Side::of(t), Side::of(rn), Side::of(rs), Side::of(rt)};
  }
};
[[gnu::always_inline]] inline RigidField<Lanes> rigid_field(const Jump<Lanes>& j) {
  return {j.n, j.s, j.t, j.rn, j.rs, j.rt};
}
[[gnu::always_inline]] inline RigidField<Lanes> rigid_field(const Lanes* c) {
  return {c[0], c[1], c[2], c[3], c[4], c[5]};
}

/// Several branches are a correction of some per cent and are computed in single precision, as they are stored. The
/// decay uses 1 − e, because e is near one and its rounding would change the relaxation time.
template <int count>
struct SingleBranches {
  Singles fade[count + 1], gain[count + 1];  // of each
  explicit SingleBranches(const Branches& of) {
    for (int k = 0; k < count; ++k) fade[k] = singles(1.0 - of.e[k]), gain[k] = singles(of.g[k]);
  }
  template <class Side = WholeSide>
  [[gnu::always_inline]] auto next(int k, typename Side::Floats then, typename Side::Floats step) const {
    return typename Side::Floats(then + (Side::of(gain[k]) * step - Side::of(fade[k]) * then));
  }
};

/// Input of a pass over the points of eight patches. `jump` is their jump and `change` its change since the previous
/// pass; both can be any affine fields over the patch. Lanes in `following` were wholly open in the previous pass:
/// their plastic slip was equal to the jump.
template <int count, class Field>
struct PointsTask {
  const PatchBatch& batch;
  const LaneStrength& law;
  const Branches& branches;
  const Field &jump, &change;
  LaneMask active, following;
  bool energies;
  PatchMemory& memory;
  bool dilates = any(less(splat(0.0), law.dilation));
  SingleBranches<count> several{branches};

  Lanes* plastic() const { return reinterpret_cast<Lanes*>(memory.point.data()) + 2 * first(); }
  Lanes* rest() const { return reinterpret_cast<Lanes*>(memory.point_rest.data()) + 2 * first(); }
  Singles* kept() const { return reinterpret_cast<Singles*>(memory.point_branch.data()) + 3 * count * first(); }
  std::uint8_t* broken() const { return &memory.broken[lane_count * first()]; }
  std::size_t first() const { return std::size_t(batch.first_point); }
};

/// Rows of lanes, from which a side is selected.
template <class Side, class Row>
struct SideRows {
  Row* all;
  [[gnu::always_inline]] auto& operator[](int i) const { return Side::of(all[i]); }
};

/// Evaluates one side of the lanes of such a task point by point. Most points remain closed and elastic, or open; only
/// rows in which a lane changes need more work. Within the class, Lanes, Singles and LaneMask are those of the side.
template <class Side, int count, bool contacts, class Field>
struct PointsPass {
  using Lanes = typename Side::Numbers;
  using Singles = typename Side::Floats;
  using LaneMask = typename Side::Mask;
  using Place = RowPlace<Lanes>;
  using Trial = LaneTrial<Lanes, LaneMask>;
  using Found = FoundPoints<Lanes, LaneMask>;

  const Branches& branches;
  const SingleBranches<count>& several;
  Field jump, change;
  LaneMask active, following;
  bool energies, dilates;
  Lanes kn, ks;
  Lanes opens, bond, bond_slope, grip, grip_slope;  // limits of the law as jumps, see set_limits()
  Lanes dilation, ease;                             // `ease`: slip for each metre of shear beyond its limit
  SideRows<Side, voussoir::Lanes> plastic, rest;
  SideRows<Side, voussoir::Singles> kept;
  std::uint8_t* broken;

  [[gnu::always_inline]] explicit PointsPass(const auto& task)
      : branches(task.branches),
        several(task.several),
        jump(task.jump.template part<Side>()),
        change(task.change.template part<Side>()),
        active(Side::of(task.active)),
        following(Side::of(task.following)),
        energies(task.energies),
        dilates(task.dilates),
        kn(Side::of(task.batch.kn)),
        ks(Side::of(task.batch.ks)),
        dilation(Side::of(task.law.dilation)),
        plastic{task.plastic()},
        rest{task.rest()},
        kept{task.kept()},
        broken(task.broken() + Side::first_lane) {
    set_limits(task.law);
  }

  [[gnu::always_inline]] Found run(const auto& rows) const {
    Sums sum;
    sum.all_open = sum.all_broken = active;
    rows.template each<Side>(
        jump, change,
        [&](int i, const Place& at, const Triple<Lanes>& u, const Triple<Lanes>& du) __attribute__((always_inline)) {
          fetch_row(i + rows_ahead);
          const Trial trial = try_point(i, u, du);
          if (any(trial.yields))
            sum.yields = true, yield(i, at, trial, sum);
          else
            stay(i, at, trial, sum);
        });
    const voussoir::Lanes area = rows.area();
    return total(sum, Side::of(area));
  }

 private:
  /// Sums over the points of jumps, without the common factors of all points of a patch.
  struct Sums : Found {
    Lanes work_n{}, work_s{}, elastic_n{}, elastic_s{};
  };
  [[gnu::always_inline]] Found total(Sums& sum, Lanes area) const {
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
  /// without bond a point slides beyond `grip` − `grip_slope` n.
  [[gnu::always_inline]] void set_limits(const LaneStrength& law) {
    const Lanes soft = 1.0 / ks, softer = kn * soft;
    opens = Side::of(law.tension) / kn;
    bond = soft * Side::of(law.cohesion), bond_slope = softer * Side::of(law.tangent);
    grip = soft * Side::of(law.residual_cohesion), grip_slope = softer * Side::of(law.residual_tangent);
    ease = dilates ? 1.0 / (1.0 + grip_slope * dilation) : splat(1.0);
  }

  [[gnu::always_inline]] static Lanes splat(double x) { return Side::splat(x); }

  /// Prefetches the data of a later row, of this batch or of the next, once for both sides.
  [[gnu::always_inline]] void fetch_row(int i) const {
    if constexpr (Side::first_lane != 0) return;
    fetch(plastic.all + 2 * i, 2 * sizeof(voussoir::Lanes));
    fetch(kept.all + 3 * count * i, 3 * count * sizeof(voussoir::Singles));
    fetch(broken + lane_count * i, lane_count);
  }

  [[gnu::always_inline]] Trial try_point(int i, const Triple<Lanes>& u, const Triple<Lanes>& du) const {
    const Lanes zero = splat(0.0);
    Trial e;
    e.u = u;
    e.du = du;
    e.plastic_n = dilates ? rest[2 * i] : zero;
    e.plastic_s = plastic[2 * i], e.plastic_t = plastic[2 * i + 1];
    if constexpr (contacts) {
      e.plastic_s = select(following, e.u.y - e.du.y, e.plastic_s);
      e.plastic_t = select(following, e.u.z - e.du.z, e.plastic_t);
    }
    e.now = {e.u.x - e.plastic_n, e.u.y - e.plastic_s, e.u.z - e.plastic_t};
    const auto flags = Side::load_bytes(broken + lane_count * i);
    e.was_broken = bytes_with(flags, 1), e.was_open = bytes_with(flags, 2);
    e.shear2 = e.now.y * e.now.y + e.now.z * e.now.z;
    e.limit = grip - grip_slope * e.now.x;
    const Lanes most = bond - bond_slope * e.now.x;
    const LaneMask apart = at_most(zero, e.now.x), past_grip = less(e.limit * e.limit, e.shear2);
    const LaneMask holds = at_most(e.now.x, opens) & at_most(e.shear2, most * most);
    const LaneMask loose = ~(without(holds, e.was_broken));  // broken before or now
    e.breaks = without(loose, e.was_broken);
    e.open = loose & apart;
    e.slides = without(loose & past_grip, apart);
    e.yields = active & (e.slides | e.breaks | (e.open ^ e.was_open));
    if constexpr (contacts) e.yields |= active & following;
    return e;
  }

  /// No lane changes its condition.
  [[gnu::always_inline]] void stay(int i, const Place& at, const Trial& e, Sums& sum) const {
    store_lanes(active & e.open, e.u.y, plastic[2 * i]);
    store_lanes(active & e.open, e.u.z, plastic[2 * i + 1]);
    const Lanes zero = splat(0.0);
    const Triple<Lanes> now = {select(e.open, zero, e.now.x), select(e.open, zero, e.now.y),
                               select(e.open, zero, e.now.z)};
    act(i, at, e, now, ~e.open, sum);
  }

  /// Some lanes slide, break, open or close; all lanes compute all results.
  [[gnu::always_inline]] void yield(int i, const Place& at, const Trial& e, Sums& sum) const {
    const Lanes zero = splat(0.0), w = at.weight;
    const auto [n0, s0, t0] = e.now;
    const LaneMask elastic = ~(e.open | e.slides | e.breaks);
    const Lanes shear = square_root(e.shear2);
    const Lanes slip = select(e.slides, (shear - e.limit) * ease, zero);
    const Lanes keep = select(e.slides, 1.0 - slip / shear, splat(1.0));
    const Triple<Lanes> now = {select(e.open, zero, n0 - slip * dilation), select(e.open, zero, keep * s0),
                               select(e.open, zero, keep * t0)};
    const Triple<Lanes> before = e.now - e.du;
    const Lanes moved_s = e.plastic_s + select(e.open, s0, (1.0 - keep) * s0);
    const Lanes moved_t = e.plastic_t + select(e.open, t0, (1.0 - keep) * t0);
    if (dilates) store_lanes(active, select(e.open, zero, e.plastic_n + slip * dilation), rest[2 * i]);
    store_lanes(active, moved_s, plastic[2 * i]);
    store_lanes(active, moved_t, plastic[2 * i + 1]);
    sum.slip2 = larger(sum.slip2, select(e.open, zero, moved_s * moved_s + moved_t * moved_t));
    // Work on the springs with the mean of the tractions at both ends of the time step, minus the increase of their
    // energy. With the traction at the end only, the error of the energy balance would be in proportion to the time
    // step.
    const Lanes lost_shear = 0.5 * ks *
                             ((now.y + before.y) * e.du.y + (now.z + before.z) * e.du.z -
                              (now.y * now.y + now.z * now.z) + (before.y * before.y + before.z * before.z));
    const Lanes lost_normal = 0.5 * kn * ((now.x + before.x) * e.du.x - now.x * now.x + before.x * before.x);
    sum.friction += select(without(e.was_broken, elastic), w * (lost_shear + kn * now.x * dilation * slip), zero);
    sum.fracture += select(e.breaks, w * (lost_shear + lost_normal), zero);
    store_flags((active & (e.was_broken | e.breaks)) | without(e.was_broken, active),
                (active & e.open) | without(e.was_open, active), broken + lane_count * i);
    act(i, at, e, now, elastic, sum);
  }

  /// Results of points with the elastic jump `now`. The branches of lanes that are not `live` are set to zero.
  [[gnu::always_inline]] void act(int i, const Place& at, const Trial& e, const Triple<Lanes>& now, LaneMask live,
                                  Sums& sum) const {
    const Lanes w = at.weight;
    Triple<Lanes> v = now;
    if constexpr (count > 0) {
      // A point that was open is compressed from the position at which it closed.
      const LaneMask was_apart = e.was_broken & less(e.du.x, e.now.x);
      const Triple<Lanes> twice = advance(i, live, e.du, select(was_apart, now.x, e.du.x), v);
      sum.work_n += w * (twice.x * e.du.x), sum.work_s += w * (twice.y * e.du.y + twice.z * e.du.z);
      if (energies) sum.stored += w * stored(3 * count * i);
    }
    if (energies) sum.elastic_n += w * (now.x * now.x), sum.elastic_s += w * (now.y * now.y + now.z * now.z);
    add_tractions(at.s, at.t, w * v.x, w * v.y, w * v.z, sum.resultant);
    sum.opening = larger(sum.opening, select(e.was_broken | e.breaks, e.u.x, splat(0.0)));
    sum.all_open &= e.open;
    sum.all_broken &= e.was_broken | e.breaks;
  }

  /// The branches of a point follow the jump, `step_n` along the normal. Adds their q to `v` and returns the sum of q
  /// at both ends of the time step, whose mean gives the work on them.
  [[gnu::always_inline]] Triple<Lanes> advance(int i, LaneMask live, const Triple<Lanes>& du, Lanes step_n,
                                               Triple<Lanes>& v) const {
    if constexpr (count == 1)
      return advance_one(i, live, du, step_n, v);
    else
      return advance_several(i, live, du, step_n, v);
  }

  /// A single branch can be that of Rayleigh damping, which is stiff and relaxes at once. It is computed in double
  /// precision.
  [[gnu::always_inline]] Triple<Lanes> advance_one(int i, LaneMask live, const Triple<Lanes>& du, Lanes step_n,
                                                   Triple<Lanes>& v) const {
    const int row = 3 * i;
    const auto one = [&](int c, Lanes step, Lanes& viscous) {
      const Lanes then = widen(kept[row + c]);
      const Lanes now = select(live, branches.e[0] * then + branches.g[0] * step, splat(0.0));
      viscous += now;
      store_lanes(active, narrow(now), kept[row + c]);
      return then + now;
    };
    return {one(0, step_n, v.x), one(1, du.y, v.y), one(2, du.z, v.z)};
  }

  [[gnu::always_inline]] Triple<Lanes> advance_several(int i, LaneMask live, const Triple<Lanes>& du, Lanes step_n,
                                                       Triple<Lanes>& v) const {
    const Singles step[3] = {narrow(step_n), narrow(du.y), narrow(du.z)};
    Singles before[3], now[3];
    int row = 3 * count * i;
    for (int k = 0; k < count; ++k)
      for (int c = 0; c < 3; ++c, ++row) {
        const Singles then = kept[row], q = within(live, several.template next<Side>(k, then, step[c]));
        before[c] = k == 0 ? then : before[c] + then;
        now[c] = k == 0 ? q : now[c] + q;
        store_lanes(active, q, kept[row]);
      }
    v.x += widen(now[0]), v.y += widen(now[1]), v.z += widen(now[2]);
    return {widen(before[0] + now[0]), widen(before[1] + now[1]), widen(before[2] + now[2])};
  }

  [[gnu::always_inline]] Lanes stored(int row) const {
    Lanes sum = splat(0.0);
    for (int k = 0; k < count; ++k) {
      const Lanes n = widen(kept[row + 3 * k]), x = widen(kept[row + 3 * k + 1]), y = widen(kept[row + 3 * k + 2]);
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

/// Merges the results of a side with those of the others.
template <class Side>
[[gnu::always_inline]] inline void take_side(const auto& found, LanePoints& all) {
  const auto& q = found.resultant;
  Resultant<Lanes>& sum = all.resultant;
  Side::of(sum.n) = q.n, Side::of(sum.s) = q.s, Side::of(sum.t) = q.t;
  Side::of(sum.sn) = q.sn, Side::of(sum.tn) = q.tn, Side::of(sum.st) = q.st, Side::of(sum.ts) = q.ts;
  Side::of(sum.ss) = q.ss, Side::of(sum.tt) = q.tt;
  Side::of(all.friction) = found.friction, Side::of(all.fracture) = found.fracture, Side::of(all.work) = found.work;
  Side::of(all.opening) = found.opening, Side::of(all.slip2) = found.slip2;
  Side::of(all.elastic) = found.elastic, Side::of(all.stored) = found.stored;
  Side::of(all.all_open) = found.all_open, Side::of(all.all_broken) = found.all_broken;
  all.yields |= found.yields;
}

/// Evaluates all lanes of a task, side after side; `contacts`: some lanes may be `following`.
template <bool contacts, int count, class Field>
[[gnu::always_inline]] inline LanePoints pass_points(const PointsTask<count, Field>& task, const auto& rows) {
  LanePoints all;
  each_side([&](auto side) __attribute__((always_inline)) {
    using Side = decltype(side);
    using SideField = decltype(task.jump.template part<Side>());
    take_side<Side>(PointsPass<Side, count, contacts, SideField>(task).run(rows), all);
  });
  return all;
}

/// Energies, largest opening and slip of the lanes evaluated point by point.
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

}  // namespace voussoir
