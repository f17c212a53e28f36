// Eight joints at a time. Lanes on the intact path are six generalised springs each (lane_springs.h); the others go
// point by point (lane_points.h). Rare cases (a lane fails its check, opens, or returns) are separate from the code of
// every time step and read the memory themselves.
#include <algorithm>

#include "solver/contact/lane_points.h"
#include "solver/contact/lane_springs.h"
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

/// As since_built().
template <class Side>
[[gnu::always_inline]] inline void less_built(const Singles* built, Jump<typename Side::Numbers>& j) {
  typename Side::Numbers* numbers[6] = {&j.n, &j.s, &j.t, &j.rn, &j.rs, &j.rt};
  for (int c = 0; c < 6; ++c) *numbers[c] -= widen(Side::of(built[c]));
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

/// A copy made number by number: of one made at once the compiler would keep the original in memory too.
[[gnu::always_inline]] inline Jump<Lanes> in_memory(const Jump<Lanes>& j) {
  const auto copy = [](const Triple<Lanes>& v) { return Triple<Lanes>{v.x, v.y, v.z}; };
  return {j.n,          j.s, j.t, j.rn, j.rs, j.rt, j.cosine, j.share, {copy(j.axes.x), copy(j.axes.y), copy(j.axes.z)},
          copy(j.place)};
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
  const Singles* built;  // none: all joints are as drawn
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
        built(pass.model->built.empty() ? nullptr : pass.model->built.data()),
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
    if (in.built) fetch(in.built + 6 * after, 6 * sizeof(Singles));
  }
  /// Of patches that are likely to go point by point, too.
  [[gnu::always_inline]] void notes(const PatchMemory& memory) const {
    fetch(&memory.energy[energy_index({next, 0}, 0)], 3 * sizeof(Lanes));
    fetch(&memory.largest[largest_index({next, 0}, 0)], 2 * sizeof(Lanes));
  }
};

/// One batch, from its pose to its wrenches, with `count` branches. `composite`: some law of the model is; where none
/// is, its joints cost nothing.
template <int count, bool composite>
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
      auto j = side_jump<Side>(batch, a, b);
      if (in.built) less_built<Side>(in.built + 6 * k, j);
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
    if (!all(surely_bear<Side>(batch, e, tension, cohesion, tangent))) return false;
    return !composite || !crushes(law) ||
           surely_whole<Side>(batch, law, e.u[0], e.u[1], e.u[2], e.u[3], e.u[4], e.u[5]);
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
    Lanes change[6];                       // of the jump since the pass before
    LaneMask in_lanes = strength.brittle;  // of the lanes point by point
    if (composite && any(strength.composite)) in_lanes = in_lanes | plain_lanes(jump, modes, live & strength.composite);
    // point_patch() keeps the last jump of its lanes itself.
    const LaneMask left = without(live, keep | in_lanes), noted = ~left;
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
    const LaneMask brittle = points & in_lanes, others = without(points, brittle);
    const LaneMask leave = without(points, bytes_with(modes, mode_points));
    leave_intact(leave);
    if (composite && any(strength.composite)) give_back(change, leave & strength.composite);
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

  /// Composite lanes that go point by point and are now no more than brittle ones that have broken: what friction can
  /// hold at the largest pressure of their rectangles crushes nothing. Notes which they are.
  [[gnu::noinline]] LaneMask plain_lanes(const Jump<Lanes>& jump, LaneBytes modes, LaneMask of_law) const {
    Lanes most;
    for (int lane = 0; lane < lane_count; ++lane)
      most[lane] = pass.model->laws[std::size_t(batch.law_of[lane])].plain_pressure;
    const Lanes turned = magnitude(jump.rs) * batch.half_t + magnitude(jump.rt) * batch.half_s;
    const LaneMask eligible = of_law & bytes_with(modes, mode_points) & bytes_with(modes, mode_plain);
    const LaneMask plain = eligible & at_most(batch.kn * (turned - jump.n), most);
    for (int lane = 0; lane < batch.count; ++lane)
      if (of_law[lane]) mode[lane] = std::uint8_t((mode[lane] & ~mode_lanes) | (plain[lane] ? mode_lanes : 0));
    return plain;
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
      auto check = check_corners<Side>(*pass.model, batch, e, strength, Side::of(broken), Side::of(keep));
      if constexpr (composite)
        if (const auto crushed = Side::of(strength.crushes); any(crushed))
          check.admissible = check.admissible & (~crushed | whole_lanes<Side>(*pass.model, batch, e.u[0], e.u[1],
                                                                              e.u[2], e.u[3], e.u[4], e.u[5]));
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

  /// Composite lanes that leave the intact path get the jump of the pass before back, from which point_patch() takes
  /// the change over the step.
  [[gnu::noinline]] void give_back(const Lanes* change, LaneMask leave) const {
    for (std::size_t c = 0; c < 6; ++c)
      for (int lane = 0; lane < batch.count; ++lane)
        if (leave[lane]) pass.state->joint.last[last_index(k, int(c)) + std::size_t(lane)] -= float(change[c][lane]);
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

template <int count, bool composite>
PassReport joints_of(const PatchPass& pass, std::size_t index) {
  const Tile& tile = pass.model->tiles[index];
  std::fill(pass.sums + wrench_width * std::size_t(tile.first_sum),
            pass.sums + wrench_width * std::size_t(tile.end_sum), 0.0);
  const BatchArrays<count> arrays(pass);
  TileFindings found;
  for (auto k = std::size_t(tile.first_batch); k < std::size_t(tile.end_batch); ++k)
    BatchPass<count, composite>(pass, arrays, k).run(found);
  if constexpr (count > 0) *reinterpret_cast<Lanes*>(&pass.state->branch_work[lane_count * index]) += found.work;
  if (pass.energies) pass.energies[index] = {sum_of(found.elastic), sum_of(found.stored)};
  PassReport report;
  report.reclip = any(found.reclip);
  report.intact = found.intact, report.points = found.points;
  return report;
}

}  // namespace

PassReport PatchPass::joints(std::size_t tile) const {
  const bool composite = std::ranges::any_of(model->laws, is_composite);
  return with_branches(branches.count, [&](auto count) {
    return composite ? joints_of<count, true>(*this, tile) : joints_of<count, false>(*this, tile);
  });
}

}  // namespace voussoir
