// Eight joints at a time. Lanes on the intact path are six generalised springs each; the others go point by point
// (lane_points.h). What is rare (a lane that fails its check, opens, comes back) stands apart from
// what every step does, and reads memory of its own.
#include <algorithm>

#include "solver/contact/lane_points.h"
#include "solver/model/with_branches.h"

namespace voussoir {

namespace {

/// Where eight poses are found: rows of poses, and where theirs begin.
struct PoseRows {
  const double* rows;
  const std::int32_t* places;
};

/// Copies of eight poses, of still bodies from where those are: for batches that touch any.
[[gnu::noinline]] PoseRows copies(const PatchPass& pass, const std::int32_t* places, double* rows) {
  static constexpr std::int32_t in_order[lane_count] = {0, 8, 16, 24, 32, 40, 48, 56};
  static_assert(pose_width == 8);
  for (int lane = 0; lane < lane_count; ++lane)
    std::copy_n(pass.pose_of(places[lane] / pose_width), pose_width, rows + in_order[lane]);
  return {rows, in_order};
}

template <class Side>
[[gnu::always_inline]] inline Jump<typename Side::Numbers> side_jump(const JointBatch& batch, PoseRows of_a,
                                                                     PoseRows of_b) {
  using L = typename Side::Numbers;
  const PosesOf<L> a = gather<Side>(of_a.rows, of_a.places), b = gather<Side>(of_b.rows, of_b.places);
  const L same = a.q.w * b.q.w + dot(a.q.v, b.q.v);
  const Quat<L> qb = {flip(b.q.w, same), {flip(b.q.v.x, same), flip(b.q.v.y, same), flip(b.q.v.z, same)}};
  const Triple<L> c = cross(a.q.v, qb.v);
  const Quat<L> relative = {magnitude(same),
                            {a.q.w * qb.v.x - qb.w * a.q.v.x + c.x, a.q.w * qb.v.y - qb.w * a.q.v.y + c.y,
                             a.q.w * qb.v.z - qb.w * a.q.v.z + c.z}};
  const Quat<L> sum =
      Quat<L>{a.q.w + qb.w, a.q.v + qb.v} * Quat<L>{Side::of(batch.frame[0]), load<Side>(batch.frame + 1)};
  const Triple<L> move_a = a.u + turn_change(a.q, load<Side>(batch.arm_a));
  const Triple<L> move_b = b.u + turn_change(b.q, load<Side>(batch.arm_b));
  return local_jump(move_b - move_a, move_a + move_b, load<Side>(batch.place), relative, sum);
}

/// Calls f(a number of the one, the same of the other) for all numbers of two jumps.
[[gnu::always_inline]] inline void each_number(auto& one, auto& other, const auto& f) {
  const auto three = [&](auto& v, auto& w) { f(v.x, w.x), f(v.y, w.y), f(v.z, w.z); };
  f(one.n, other.n), f(one.s, other.s), f(one.t, other.t);
  f(one.rn, other.rn), f(one.rs, other.rs), f(one.rt, other.rt);
  f(one.cosine, other.cosine), f(one.share, other.share);
  three(one.axes.x, other.axes.x), three(one.axes.y, other.axes.y), three(one.axes.z, other.axes.z);
  three(one.place, other.place);
}

/// The same of two resultants.
template <class One, class Other>
requires requires(One q) {
  q.sn;
}
[[gnu::always_inline]] inline void each_number(One& one, Other& other, const auto& f) {
  f(one.n, other.n), f(one.s, other.s), f(one.t, other.t);
  f(one.sn, other.sn), f(one.tn, other.tn), f(one.st, other.st);
  f(one.ts, other.ts), f(one.ss, other.ss), f(one.tt, other.tt);
}

/// A side's lanes of a jump or a resultant.
template <class Side, template <class> class Of>
[[gnu::always_inline]] inline auto side_of(const Of<Lanes>& all) {
  Of<typename Side::Numbers> side;
  each_number(
      side, all, [](auto& x, const Lanes& of) __attribute__((always_inline)) { x = Side::of(of); });
  return side;
}

/// The elastic generalised jump of the intact path.
template <class L>
struct ElasticOf {
  L u[6];  // n, s, t, θn, θs, θt
};
using LaneElastic = ElasticOf<Lanes>;

template <class M>
struct CheckOf {
  M admissible, open;
};

/// A copy made number by number: of one made at once the compiler would keep the original in memory too.
[[gnu::always_inline]] inline Jump<Lanes> in_memory(const Jump<Lanes>& j) {
  const auto copy = [](const Triple<Lanes>& v) { return Triple<Lanes>{v.x, v.y, v.z}; };
  return {j.n,          j.s, j.t, j.rn, j.rs, j.rt, j.cosine, j.share, {copy(j.axes.x), copy(j.axes.y), copy(j.axes.z)},
          copy(j.place)};
}

/// Jump at one place of the joints' planes.
template <class L>
[[gnu::always_inline]] inline Triple<L> jump_at(const ElasticOf<L>& e, L s, L t) {
  return {e.u[0] + e.u[4] * t - e.u[5] * s, e.u[1] - e.u[3] * t, e.u[2] + e.u[3] * s};
}

/// What intact joints bear, by what is left of their bonds.
template <class L>
struct BearingOf {
  L tension, cohesion, tangent;
};

template <class Side, class L, class M>
[[gnu::always_inline]] inline void check_corner(const JointBatch& batch, const ElasticOf<L>& e, L s, L t,
                                                const BearingOf<L>& bears, CheckOf<M>& check) {
  const Triple<L> u = jump_at(e, s, t);
  const L ks = Side::of(batch.ks), sigma = Side::of(batch.kn) * u.x;
  const L limit = bears.cohesion - sigma * bears.tangent;
  const L shear2 = ks * ks * (u.y * u.y + u.z * u.z);
  check.admissible = check.admissible & at_most(sigma, bears.tension) & at_most(shear2, limit * limit);
  check.open = check.open & at_most(Side::splat(0.0), u.x);
}

template <class Side, class L, class M>
[[gnu::noinline]] CheckOf<M> check_polygons(const Model& model, const JointBatch& batch, const ElasticOf<L>& e,
                                            const BearingOf<L>& bears, M keep) {
  CheckOf<M> check = {keep, keep};
  const Lanes* corner = &model.batch_corners[std::size_t(batch.first_corner)];
  for (int c = 0; c < batch.corners; ++c, corner += 2)
    check_corner<Side>(batch, e, L(Side::of(corner[0])), L(Side::of(corner[1])), bears, check);
  return check;
}

/// Whether the lanes of a side bear the largest normal and the largest shear jump there are in their rectangles, as
/// most do: then every point of theirs is elastic.
template <class Side, class L>
[[gnu::always_inline]] inline auto surely_bear(const JointBatch& batch, const ElasticOf<L>& e, L tension, L cohesion,
                                               L tangent) {
  const L a = Side::of(batch.half_s), b = Side::of(batch.half_t), kn = Side::of(batch.kn), ks = Side::of(batch.ks);
  const L turned = magnitude(e.u[4]) * b + magnitude(e.u[5]) * a;
  const L s = magnitude(e.u[1]) + magnitude(e.u[3]) * b, t = magnitude(e.u[2]) + magnitude(e.u[3]) * a;
  const L sigma = kn * (e.u[0] + turned), limit = cohesion - sigma * tangent;
  return at_most(sigma, tension) & at_most(ks * ks * (s * s + t * t), limit * limit);
}

/// The elastic traction field is affine and the admissible set convex: the corners decide for the whole polygon, and
/// those of a rectangle about it are on the safe side.
template <class Side, class L, class M>
[[gnu::always_inline]] inline CheckOf<M> check_corners(const Model& model, const JointBatch& batch,
                                                       const ElasticOf<L>& e, const LaneStrength& strength, M broken,
                                                       M keep) {
  const BearingOf<L> bears = {select(broken, Side::splat(0.0), L(Side::of(strength.tension))),
                              select(broken, L(Side::of(strength.residual_cohesion)), L(Side::of(strength.cohesion))),
                              select(broken, L(Side::of(strength.residual_tangent)), L(Side::of(strength.tangent)))};
  const L a = Side::of(batch.half_s), b = Side::of(batch.half_t);
  CheckOf<M> check = {keep, keep};
  check_corner<Side>(batch, e, a, b, bears, check);
  check_corner<Side>(batch, e, L(-a), b, bears, check);
  check_corner<Side>(batch, e, L(-a), L(-b), bears, check);
  check_corner<Side>(batch, e, a, L(-b), bears, check);
  if (batch.rectangles || !any(without(keep, check.admissible))) return check;
  return check_polygons<Side>(model, batch, e, bears, keep);
}

/// Largest opening and the plastic slip field of patches that are wholly open.
template <class Side, class L, class M>
[[gnu::noinline]] void follow_open(const Model& model, const JointBatch& batch, const ElasticOf<L>& e, M open,
                                   Lanes* slip, std::uint8_t* mode, Lanes& largest) {
  for (int c = 0; c < 3; ++c) store_lanes(open, L(Side::of(slip[c]) + e.u[c + 1]), Side::of(slip[c]));
  L most = Side::splat(0.0);
  const auto look_at = [&](L s, L t) { most = larger(jump_at(e, s, t).x, most); };
  if (batch.rectangles) {
    const L a = Side::of(batch.half_s), b = Side::of(batch.half_t);
    look_at(a, b), look_at(-a, b), look_at(-a, -b), look_at(a, -b);
  } else {
    const Lanes* corner = &model.batch_corners[std::size_t(batch.first_corner)];
    for (int c = 0; c < batch.corners; ++c, corner += 2) look_at(Side::of(corner[0]), Side::of(corner[1]));
  }
  store_lanes(open & less(L(Side::of(largest)), most), most, Side::of(largest));
  for (int lane = 0; lane < Side::lanes; ++lane)
    if (open[lane]) mode[Side::first_lane + lane] |= mode_slid;
}

/// The branches of one generalised jump follow its change `du`, those of lanes that are not closed relax; adds their q
/// to `viscous` and returns the sum of q at both ends of the step. Lanes to keep are written.
template <class Side, int count>
[[gnu::always_inline]] inline auto advance_jump(const Branches& branches, const SingleBranches<count>& several,
                                                typename Side::Numbers du, auto closed, auto keep, Singles* kept,
                                                typename Side::Numbers& viscous) {
  using L = typename Side::Numbers;
  using F = typename Side::Floats;
  if constexpr (count == 1) {  // it may be stiff and forget at once, see PointsPass::advance_one()
    const L then = widen(Side::of(*kept));
    const L q = select(closed, L(branches.e[0] * then + branches.g[0] * du), Side::splat(0.0));
    viscous += q;
    store_lanes(keep, narrow(q), Side::of(*kept));
    return L(then + q);
  } else {
    const F step = narrow(du);
    F before{}, now{};
    for (int k = 0; k < count; ++k, ++kept) {
      const F then = Side::of(*kept), q = within(closed, several.template next<Side>(k, then, step));
      before = k == 0 ? then : before + then;
      now = k == 0 ? q : now + q;
      store_lanes(keep, q, Side::of(*kept));
    }
    viscous += widen(now);
    return L(widen(F(before + now)));
  }
}

/// Elastic plus viscous generalised jump; the branches of lanes that close start from nothing. Adds the work done on
/// them, by the mean of their tractions at both ends of the step.
template <class Side, int count>
[[gnu::always_inline]] inline auto advance_lanes(const Branches& branches, const SingleBranches<count>& several,
                                                 const JointBatch& batch, const ElasticOf<typename Side::Numbers>& e,
                                                 auto closed, auto was_open, auto keep, Singles* kept,
                                                 typename Side::Numbers& work, const typename Side::Numbers* du) {
  using L = typename Side::Numbers;
  ElasticOf<L> sum = e;
  const L kn = Side::of(batch.kn), ks = Side::of(batch.ks), area = Side::of(batch.area), ss = Side::of(batch.ss),
          tt = Side::of(batch.tt);
  const L stiffness[6] = {kn * area, ks * area, ks * area, ks * (ss + tt), kn * tt, kn * ss};
  L done = Side::splat(0.0);
  for (int c = 0; c < 6; ++c) {
    const L change = select(was_open, e.u[c], du[c]);
    const L twice = advance_jump<Side, count>(branches, several, change, closed, keep, kept + count * c, sum.u[c]);
    done += stiffness[c] * (twice * du[c]);
  }
  work += select(keep, L(0.5 * done), Side::splat(0.0));
  return sum;
}

template <class Side = WholeSide>
[[gnu::always_inline]] inline auto lanes_resultant(const JointBatch& b, const ElasticOf<typename Side::Numbers>& v) {
  using L = typename Side::Numbers;
  const L zero = Side::splat(0.0), kn = Side::of(b.kn), ks = Side::of(b.ks), area = Side::of(b.area),
          ss = Side::of(b.ss), tt = Side::of(b.tt);
  Resultant<L> q;
  q.n = kn * area * v.u[0];
  q.s = ks * area * v.u[1];
  q.t = ks * area * v.u[2];
  q.sn = -(kn * ss) * v.u[5];
  q.tn = kn * tt * v.u[4];
  q.st = ks * ss * v.u[3];
  q.ts = -(ks * tt) * v.u[3];
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

/// What a tile finds of its joints.
struct TileFindings {
  int intact = 0, points = 0;
  LaneMask reclip;
  Lanes work = splat(0.0);                          // J, done on the branches of the intact path
  Lanes elastic = splat(0.0), stored = splat(0.0);  // J, where energies are wanted
};

/// The arrays that batches lie in.
template <int count>
struct BatchArrays {
  const JointBatch* batches;
  std::size_t final;  // of all batches
  const double* pose;
  std::uint8_t* mode;
  Singles *last, *branch;
  Lanes* slip;
  double* sums;
  SlidingLimits limits;
  SingleBranches<count> several;

  explicit BatchArrays(const PatchPass& pass)
      : batches(pass.model->batches.data()),
        final(pass.model->batches.size() - 1),
        pose(pass.state->pose.data()),
        mode(pass.state->joint.mode.data()),
        last(reinterpret_cast<Singles*>(pass.state->joint.last.data())),
        branch(reinterpret_cast<Singles*>(pass.state->branch.data())),
        slip(reinterpret_cast<Lanes*>(pass.state->slip.data())),
        sums(pass.sums),
        limits(*pass.model),
        several(pass.branches) {}

  Singles* last_of(std::size_t k) const { return last + 6 * k; }
  Singles* branches_of(std::size_t k) const { return branch + 6 * count * k; }
  Lanes* slip_of(std::size_t k) const { return slip + 3 * k; }
};

/// Those arrays together do not fit in a cache: what the batches after batch k have there is asked for while it is
/// computed, a part at a time (see fetch()); points are asked for row by row.
template <int count>
struct BatchAhead {
  const BatchArrays<count>& in;
  std::size_t k, next, after;

  [[gnu::always_inline]] BatchAhead(const BatchArrays<count>& arrays, std::size_t index)
      : in(arrays), k(index), next(std::min(k + 1, in.final)), after(std::min(k + 2, in.final)) {}

  /// Of the next batch, which by then has been asked for itself.
  [[gnu::always_inline]] void poses() const {
    fetch_poses(in.pose, in.batches[next].pose_a), fetch_poses(in.pose, in.batches[next].pose_b);
  }
  /// Of the one after it, in two parts.
  [[gnu::always_inline]] void constants(std::size_t part) const { fetch_part<2>(in.batches[after], part); }
  [[gnu::always_inline]] void memory() const {
    fetch(in.last_of(after), 6 * sizeof(Singles));
    fetch(in.slip_of(after), 3 * sizeof(Lanes));
    fetch(in.mode + in.batches[k].first_joint + 2 * lane_count, 1);
    if constexpr (count > 0) fetch(in.branches_of(after), 6 * count * sizeof(Singles));
  }
  /// Of patches that are likely to go point by point, too.
  [[gnu::always_inline]] void notes(const PatchMemory& memory) const {
    fetch(&memory.energy[energy_index({next, 0}, 0)], 3 * sizeof(Lanes));
    fetch(&memory.largest[largest_index({next, 0}, 0)], 2 * sizeof(Lanes));
  }
};

/// One batch, from its pose to its wrenches, with `count` branches.
template <int count>
struct BatchPass {
  const PatchPass& pass;
  const BatchArrays<count>& in;
  const BatchAhead<count> ahead;
  std::size_t k;
  const JointBatch& batch;
  std::uint8_t* mode;

  [[gnu::always_inline]] BatchPass(const PatchPass& p, const BatchArrays<count>& arrays, std::size_t index)
      : pass(p), in(arrays), ahead(in, index), k(index), batch(in.batches[k]), mode(in.mode + batch.first_joint) {}

  [[gnu::always_inline]] void run(TileFindings& findings) const {
    const bool full = batch.count == lane_count && batch.law >= 0 && pass.shortcut;
    const std::uint64_t modes = full ? all_modes() : 0;
    const bool closed = full && !(modes & in_each(mode_points | mode_gone | mode_open));
    if (!closed && !any(live_lanes())) return nothing_left();
    PoseRows a = {in.pose, batch.pose_a}, b = {in.pose, batch.pose_b};
    alignas(64) double rows[2][lane_count * pose_width];
    if (batch.touches_still && pass.still)
      a = copies(pass, batch.pose_a, rows[0]), b = copies(pass, batch.pose_b, rows[1]);
    Jump<Lanes> jump;
    bool bear = closed;
    each_side([&](auto side) __attribute__((always_inline)) {
      using Side = decltype(side);
      const auto j = side_jump<Side>(batch, a, b);
      each_number(
          j, jump, [](const auto& x, Lanes& of) __attribute__((always_inline)) { Side::of(of) = x; });
      if (bear) bear = bears<Side>(j, modes);
    });
    ahead.poses();
    if (bear) return springs(jump, modes & in_each(mode_slid), findings);
    mixed_batch(pass, in, k, in_memory(jump), findings);
  }

 private:
  std::uint64_t all_modes() const {
    std::uint64_t modes;
    std::memcpy(&modes, mode, sizeof(modes));
    return modes;
  }
  static constexpr std::uint64_t in_each(int bits) { return 0x0101010101010101u * std::uint64_t(bits); }

  LaneMask live_lanes() const {
    return without(LaneMask::first(batch.count), bytes_with(load_bytes(mode, batch.count), mode_gone));
  }

  template <class Side = WholeSide>
  [[gnu::always_inline]] auto elastic_of(const Jump<typename Side::Numbers>& jump, bool slid) const {
    ElasticOf<typename Side::Numbers> e = {{jump.n, jump.s, jump.t, jump.rn, jump.rs, jump.rt}};
    if (slid)
      for (int c = 0; c < 3; ++c) e.u[c + 1] -= Side::of(in.slip_of(k)[c]);
    return e;
  }

  /// Whether all lanes of a side of a closed batch bear for sure.
  template <class Side>
  [[gnu::always_inline]] bool bears(const Jump<typename Side::Numbers>& jump, std::uint64_t modes) const {
    const auto e = elastic_of<Side>(jump, modes & in_each(mode_slid));
    const LawConstants& law = pass.model->laws[std::size_t(batch.law)];
    auto tension = Side::splat(law.most_tension), cohesion = Side::splat(law.most_cohesion),
         tangent = Side::splat(law.slope);
    if (modes & in_each(mode_broken)) {
      const auto broken = bytes_with(Side::load_bytes(mode + Side::first_lane), mode_broken);
      tension = select(broken, Side::splat(-1e-300), tension);  // where nothing presses they are open
      cohesion = select(broken, Side::splat(law.residual_cohesion), cohesion);
      tangent = select(broken, Side::splat(law.residual_tan_friction), tangent);
    }
    return all(surely_bear<Side>(batch, e, tension, cohesion, tangent));
  }

  /// All lanes are springs, and were: nothing of theirs changes but the last jump and the branches. Side by side.
  [[gnu::always_inline]] void springs(const Jump<Lanes>& jump, bool slid, TileFindings& findings) const {
    each_side([&](auto side) __attribute__((always_inline)) {
      using Side = decltype(side);
      spring_side<Side>(jump, slid, findings);
    });
    if (pass.energies)
      add_energy<count>(pass.branches, batch, elastic_of(jump, slid), LaneMask::first(lane_count), in.branches_of(k),
                        findings.elastic, findings.stored);
    ahead.memory();
    findings.intact += lane_count;
  }
  template <class Side>
  [[gnu::always_inline]] void spring_side(const Jump<Lanes>& all, bool slid, TileFindings& findings) const {
    using L = typename Side::Numbers;
    const Jump<L> jump = side_of<Side>(all);
    auto e = elastic_of<Side>(jump, slid);
    L change[6];
    note_change<Side>(jump, EveryLane{}, in.last_of(k), change);
    if constexpr (Side::first_lane == 0) ahead.constants(0);
    if constexpr (count > 0)
      e = advance_lanes<Side, count>(pass.branches, in.several, batch, e, EveryLane{}, NoLane{}, EveryLane{},
                                     in.branches_of(k), Side::of(findings.work), change);
    if constexpr (Side::first_lane + Side::lanes == lane_count) ahead.constants(1);
    const auto wrench = WorldWrench<L>::of_springs(lanes_resultant<Side>(batch, e), jump);
    const WrenchRows<Side> wrenches(wrench.force, wrench.moment);
    add_up(wrenches.row, Side::first_lane, Side::lanes);
    Side::of(findings.reclip) = Side::of(findings.reclip) | past_limits<Side>(in.limits, Side::of(batch.area), jump);
  }

  /// What the check left of intact lanes: those that stay, and those of them that carry load.
  struct Intact {
    LaneMask stays{}, closed{};
    Resultant<Lanes> resultant;  // of closed lanes alone
  };

  /// Of its own, so that for the short way the compiler keeps none of this in memory.
  [[gnu::noinline]] static void mixed_batch(const PatchPass& p, const BatchArrays<count>& arrays, std::size_t index,
                                            const Jump<Lanes>& jump, TileFindings& findings) {
    BatchPass(p, arrays, index).mixed(jump, findings);
  }
  /// A batch in which some lanes are open, gone or go point by point: those that fail the check from here on.
  [[gnu::always_inline]] void mixed(const Jump<Lanes>& jump, TileFindings& findings) const {
    const LaneMask live = live_lanes();
    const LaneBytes modes = load_bytes(mode, batch.count);
    const LaneMask keep = pass.shortcut ? without(live, bytes_with(modes, mode_points)) : LaneMask{};
    const LaneStrength strength = strengths(*pass.model, batch);
    Lanes change[6];  // of the jump since the pass before
    // point_patch() keeps the last jump of its lanes itself.
    const LaneMask left = without(live, keep | strength.brittle), noted = ~left;
    each_side([&](auto side) __attribute__((always_inline)) {
      using Side = decltype(side);
      typename Side::Numbers since[6];
      if (any(left))
        note_change<Side>(side_of<Side>(jump), Side::of(noted), in.last_of(k), since);
      else
        note_change<Side>(side_of<Side>(jump), EveryLane{}, in.last_of(k), since);
      for (int c = 0; c < 6; ++c) Side::of(change[c]) = since[c];
    });
    ahead.constants(0);
    Intact intact;
    if (any(keep)) intact = intact_lanes(jump, change, strength, modes, keep, findings);
    const LaneMask points = without(live, intact.stays);
    ahead.constants(1);
    const Resultant<Lanes> nothing{};
    Resultant<Lanes> by_points{};
    const LaneMask brittle = points & strength.brittle, others = without(points, brittle);
    leave_intact(without(points, bytes_with(modes, mode_points)));
    if (any(brittle)) by_points = point_lanes(jump, change, strength, brittle, findings);
    const Resultant<Lanes> resultant = select(intact.closed, intact.resultant, select(brittle, by_points, nothing));
    alignas(64) double rows[lane_count * wrench_width];
    each_side([&](auto side) __attribute__((always_inline)) {
      using Side = decltype(side);
      const WorldWrench<typename Side::Numbers> wrench(side_of<Side>(resultant), side_of<Side>(jump));
      const WrenchRows<Side> wrenches(wrench.force, wrench.moment);
      std::memcpy(rows + wrench_width * Side::first_lane, wrenches.row, sizeof(wrenches.row));
    });
    for (int lane = 0; any(others) && lane < batch.count; ++lane)
      if (others[lane]) point_patch(pass, std::size_t(batch.first_joint + lane), rows + wrench_width * lane);
    ahead.memory();
    add_up(reinterpret_cast<const Lanes*>(rows), 0, batch.count);
    findings.reclip |= without(live, strength.tie) & past_limits(in.limits, batch.area, jump);
    findings.intact += count_of(intact.stays);
    findings.points += count_of(points);
  }

  /// Intact lanes: checked at the corners, advanced if they stay.
  [[gnu::always_inline]] Intact intact_lanes(const Jump<Lanes>& jump, const Lanes* change, const LaneStrength& strength,
                                             LaneBytes modes, LaneMask keep, TileFindings& findings) const {
    const bool slid = any(bytes_with(modes, mode_slid));
    const LaneMask broken = bytes_with(modes, mode_broken), was_open = keep & bytes_with(modes, mode_open);
    Intact all;
    LaneMask open;
    each_side([&](auto side) __attribute__((always_inline)) {
      using Side = decltype(side);
      using L = typename Side::Numbers;
      auto e = elastic_of<Side>(side_of<Side>(jump), slid);
      const auto check = check_corners<Side>(*pass.model, batch, e, strength, Side::of(broken), Side::of(keep));
      const auto opens = Side::of(broken) & check.open, closed = without(check.admissible, opens),
                 stays = opens | closed;
      if (any(opens)) follow_open<Side>(*pass.model, batch, e, opens, in.slip_of(k), mode, largest_openings());
      L since[6];
      for (int c = 0; c < 6; ++c) since[c] = Side::of(change[c]);
      if constexpr (count > 0)
        e = advance_lanes<Side, count>(pass.branches, in.several, batch, e, closed, Side::of(was_open), stays,
                                       in.branches_of(k), Side::of(findings.work), since);
      Side::of(open) = opens, Side::of(all.stays) = stays, Side::of(all.closed) = closed;
      const auto resultant = lanes_resultant<Side>(batch, e);
      each_number(
          resultant, all.resultant, [](const auto& x, Lanes& of) __attribute__((always_inline)) { Side::of(of) = x; });
    });
    if (any(open ^ was_open))
      for (int lane = 0; lane < batch.count; ++lane)
        if (keep[lane]) mode[lane] = std::uint8_t((mode[lane] & ~mode_open) | (open[lane] ? mode_open : 0));
    if (pass.energies)
      add_energy<count>(pass.branches, batch, elastic_of(jump, slid), all.closed, in.branches_of(k), findings.elastic,
                        findings.stored);
    return all;
  }

  Lanes& largest_openings() const {
    return *reinterpret_cast<Lanes*>(&pass.state->joint.largest[largest_index({k, 0}, 0)]);
  }

  void leave_intact(LaneMask leave) const {
    for (int lane = 0; any(leave) && lane < lane_count; ++lane)
      if (leave[lane]) joint_to_points(*pass.model, *pass.state, pass.branches, std::size_t(batch.first_joint + lane));
  }

  /// Lanes point by point; the few whose law has no lane form are left to point_patch().
  [[gnu::always_inline]] Resultant<Lanes> point_lanes(const Jump<Lanes>& jump, const Lanes* change,
                                                      const LaneStrength& strength, LaneMask active,
                                                      TileFindings& findings) const {
    PatchMemory& memory = pass.state->joint;
    ahead.notes(memory);
    const PointRows rows_of_points(pass.model->rule, pass.model->points, batch);
    const RigidField<Lanes> now = rigid_field(jump), since = rigid_field(change);
    const PointsTask<count, RigidField<Lanes>> task = {
        batch, strength, pass.branches, now, since, active, LaneMask{}, pass.energies != nullptr, memory};
    const LanePoints found = pass_points<false>(task, rows_of_points);
    note_points(found, active, k, memory);
    findings.elastic += select(active, found.elastic, splat(0.0));
    findings.stored += select(active, found.stored, splat(0.0));
    const LaneMask back = active & found.all_open & found.all_broken;
    if (pass.shortcut && any(back))
      to_intact(jump, pass.branches, back, batch.count, mode, in.slip_of(k), in.branches_of(k));
    return found.resultant;
  }

  /// Adds the wrenches to the sums of their bodies, joint by joint.
  [[gnu::always_inline]] void add_up(const Lanes* rows, int first, int lanes) const {
    for (int i = 0; i < lane_count; ++i) {
      if (i == lanes) break;
      *reinterpret_cast<Lanes*>(in.sums + batch.sum_a[first + i]) += rows[i];
      *reinterpret_cast<Lanes*>(in.sums + batch.sum_b[first + i]) -= rows[i];
    }
    if (!pass.wrenches) return;
    auto* wrenches = reinterpret_cast<Lanes*>(pass.wrenches + wrench_width * batch.first_joint) + first;
    for (int i = 0; i < lane_count && i < lanes; ++i) wrenches[i] = rows[i];
  }

  /// Of a batch without live lanes, whose wrenches are none.
  void nothing_left() const {
    if (pass.wrenches)
      std::fill_n(pass.wrenches + wrench_width * batch.first_joint, wrench_width * std::size_t(batch.count), 0.0);
  }
};

template <int count>
PassReport joints_of(const PatchPass& pass, std::size_t index) {
  const Tile& tile = pass.model->tiles[index];
  std::fill(pass.sums + wrench_width * std::size_t(tile.first_sum),
            pass.sums + wrench_width * std::size_t(tile.end_sum), 0.0);
  const BatchArrays<count> arrays(pass);
  TileFindings found;
  for (auto k = std::size_t(tile.first_batch); k < std::size_t(tile.end_batch); ++k)
    BatchPass<count>(pass, arrays, k).run(found);
  if constexpr (count > 0) *reinterpret_cast<Lanes*>(&pass.state->branch_work[lane_count * index]) += found.work;
  if (pass.energies) pass.energies[index] = {sum_of(found.elastic), sum_of(found.stored)};
  PassReport report;
  report.reclip = any(found.reclip);
  report.intact = found.intact, report.points = found.points;
  return report;
}

}  // namespace

PassReport PatchPass::joints(std::size_t tile) const {
  return with_branches(branches.count, [&](auto count) { return joints_of<count>(*this, tile); });
}

}  // namespace voussoir
