// The intact path of eight joints side by side: six generalised springs each, the check of their strength, and their
// branches.
#pragma once
#include "solver/contact/lane_points.h"

namespace voussoir {

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

/// Jump at one place of the joints' planes.
template <class L>
[[gnu::always_inline]] inline Triple<L> jump_at(const ElasticOf<L>& e, L s, L t) {
  return {e.u[0] + e.u[4] * t - e.u[5] * s, e.u[1] - e.u[3] * t, e.u[2] + e.u[3] * s};
}

/// Strength of each lane on the intact path, with or without its bond: Pa, Pa, –.
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

/// Whether the lanes of a side can carry the largest normal jump and the largest shear jump in their rectangles. This
/// holds for most lanes, and all their points are then elastic.
template <class Side, class L>
[[gnu::always_inline]] inline auto surely_bear(const JointBatch& batch, const ElasticOf<L>& e, L tension, L cohesion,
                                               L tangent) {
  const L a = Side::of(batch.half_s), b = Side::of(batch.half_t), kn = Side::of(batch.kn), ks = Side::of(batch.ks);
  const L turned = magnitude(e.u[4]) * b + magnitude(e.u[5]) * a;
  const L s = magnitude(e.u[1]) + magnitude(e.u[3]) * b, t = magnitude(e.u[2]) + magnitude(e.u[3]) * a;
  const L sigma = kn * (e.u[0] + turned), limit = cohesion - sigma * tangent;
  return at_most(sigma, tension) & at_most(ks * ks * (s * s + t * t), limit * limit);
}

/// The cap of the composite law for the lanes of a side before crushing: Pa, –.
template <class L>
struct CapOf {
  L begin, shear;
};
template <class Side>
[[gnu::noinline]] CapOf<typename Side::Numbers> caps_of(const Model& model, const JointBatch& batch) {
  CapOf<typename Side::Numbers> cap = {Side::splat(0.0), Side::splat(0.0)};
  for (int lane = 0; lane < Side::lanes; ++lane) {
    const LawConstants& law = model.laws[std::size_t(batch.law_of[Side::first_lane + lane])];
    cap.begin[lane] = CrushingCurve::begin * law.crushing;
    cap.shear[lane] = law.cap_shear;
  }
  return cap;
}

/// Lanes in which the pressure kn n and the shear (`shear2` is its square, m2) do not cause crushing.
template <class Side, class L>
[[gnu::always_inline]] inline auto within_cap(const JointBatch& batch, const CapOf<L>& cap, L n, L shear2) {
  const L ks = Side::of(batch.ks), pressure = Side::of(batch.kn) * larger(L(-n), Side::splat(0.0));
  return at_most(pressure * pressure + cap.shear * (ks * ks * shear2), cap.begin * cap.begin);
}

/// Whether the lanes of a side with one law certainly do not crush, from the largest pressure and the largest shear
/// jump of their rectangles, as in surely_bear(). It is a separate function with arguments by value, so that other laws
/// need no memory for it.
template <class Side, class L>
[[gnu::noinline]] bool surely_whole(const JointBatch& batch, const LawConstants& law, L n, L s, L t, L rn, L rs, L rt) {
  const L a = Side::of(batch.half_s), b = Side::of(batch.half_t);
  const L turned = magnitude(rs) * b + magnitude(rt) * a;
  const L along = magnitude(s) + magnitude(rn) * b, across = magnitude(t) + magnitude(rn) * a;
  const CapOf<L> cap = {Side::splat(CrushingCurve::begin * law.crushing), Side::splat(law.cap_shear)};
  return all(within_cap<Side>(batch, cap, L(n - turned), L(along * along + across * across)));
}

/// Lanes of a side without crushing at any corner. The set of tractions within the cap is convex, so the corners are
/// sufficient.
template <class Side, class L>
[[gnu::noinline]] auto whole_lanes(const Model& model, const JointBatch& batch, L n, L s, L t, L rn, L rs, L rt) {
  const ElasticOf<L> e = {{n, s, t, rn, rs, rt}};
  const CapOf<L> cap = caps_of<Side>(model, batch);
  const auto holds = [&](L x, L y) {
    const Triple<L> u = jump_at(e, x, y);
    return within_cap<Side>(batch, cap, u.x, L(u.y * u.y + u.z * u.z));
  };
  if (batch.rectangles) {
    const L a = Side::of(batch.half_s), b = Side::of(batch.half_t);
    return holds(a, b) & holds(L(-a), b) & holds(L(-a), L(-b)) & holds(a, L(-b));
  }
  const Lanes* corner = &model.batch_corners[std::size_t(batch.first_corner)];
  auto whole = holds(L(Side::of(corner[0])), L(Side::of(corner[1])));
  for (int c = 1; c < batch.corners; ++c)
    whole = whole & holds(L(Side::of(corner[2 * c])), L(Side::of(corner[2 * c + 1])));
  return whole;
}

/// The elastic traction field is affine and the admissible set is convex. The corners are therefore sufficient for the
/// whole polygon, and those of a rectangle around it are on the safe side.
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

/// The branches of one generalised jump follow its change `du`; those of lanes that are not closed are set to zero.
/// Adds their q to `viscous` and returns the sum of q at both ends of the time step. Only the selected lanes are
/// written.
template <class Side, int count>
[[gnu::always_inline]] inline auto advance_jump(const Branches& branches, const SingleBranches<count>& several,
                                                typename Side::Numbers du, auto closed, auto keep, Singles* kept,
                                                typename Side::Numbers& viscous) {
  using L = typename Side::Numbers;
  using F = typename Side::Floats;
  if constexpr (count == 1) {  // it can be stiff and relax at once, see PointsPass::advance_one()
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

/// Elastic plus viscous generalised jump; the branches of closing lanes start from zero. Adds the work on them, with
/// the mean of their tractions at both ends of the time step.
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

/// Energy of intact lanes, J: of the elastic jump, and of the springs of their branches.
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

/// Returns patches that are wholly open and broken to the intact path, because their plastic slip is again a rigid
/// field.
inline void to_intact(const Jump<Lanes>& j, const Branches& branches, LaneMask back, int count, std::uint8_t* mode,
                      Lanes* slip, Singles* kept) {
  slip[0] = select(back, j.s, slip[0]);
  slip[1] = select(back, j.t, slip[1]);
  slip[2] = select(back, j.rn, slip[2]);
  for (int c = 0; c < 6 * branches.count; ++c) kept[c] = narrow(select(back, splat(0.0), widen(kept[c])));
  for (int lane = 0; lane < count; ++lane)
    if (back[lane]) mode[lane] = std::uint8_t((mode[lane] & ~mode_points) | mode_broken | mode_open | mode_slid);
}

}  // namespace voussoir
