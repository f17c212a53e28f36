// Eight joints at a time. Lanes on the intact path are six generalised springs each; the others go point by point
// (lane_points.h). What is rare (a lane that fails its check, opens, comes back) stands apart from
// what every step does, and reads memory of its own.
#include <algorithm>

#include "solver/contact/lane_points.h"
#include "solver/model/with_branches.h"

namespace voussoir {

namespace {

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
  check.admissible &= at_most(sigma, tension) & at_most(shear2, limit * limit);
  check.open &= at_most(splat(0.0), u.x);
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
                                   Lanes* slip, std::uint8_t* mode, Lanes& largest) {
  for (int c = 0; c < 3; ++c) slip[c] = select(open, slip[c] + e.u[c + 1], slip[c]);
  Lanes most = splat(0.0);
  const auto look_at = [&](Lanes s, Lanes t) { most = larger(jump_at(e, s, t).x, most); };
  if (batch.rectangles) {
    const Lanes a = batch.half_s, b = batch.half_t;
    look_at(a, b), look_at(-a, b), look_at(-a, -b), look_at(a, -b);
  } else {
    const Lanes* corner = &model.batch_corners[std::size_t(batch.first_corner)];
    for (int c = 0; c < batch.corners; ++c, corner += 2) look_at(corner[0], corner[1]);
  }
  store_lanes(open & less(largest, most), most, largest);
  for (int lane = 0; lane < batch.count; ++lane)
    if (open[lane]) mode[lane] |= mode_slid;
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

/// A batch lies in several arrays, which together do not fit in a cache: what those after batch k have there is asked
/// for while it is computed, a part at a time (see fetch()); points are asked for row by row.
template <int count>
struct BatchAhead {
  const PatchPass& pass;
  std::size_t k;

  /// Of the next batch, which by then has been asked for itself.
  [[gnu::always_inline]] void poses() const {
    if (k + 1 == pass.model->batches.size()) return;
    const JointBatch& next = pass.model->batches[k + 1];
    fetch_poses(pass.state->pose.data(), next.a), fetch_poses(pass.state->pose.data(), next.b);
  }
  /// Of the one after it, in two parts.
  [[gnu::always_inline]] void constants(std::size_t part) const {
    if (k + 2 < pass.model->batches.size()) fetch_part<2>(pass.model->batches[k + 2], part);
  }
  [[gnu::always_inline]] void memory() const {
    const State& state = *pass.state;
    const std::size_t next = k + 2;
    if (next >= pass.model->batches.size()) return;
    fetch(&state.joint.last[last_index(next, 0)], 6 * sizeof(Singles));
    fetch(&state.slip[3 * lane_count * next], 3 * sizeof(Lanes));
    fetch(state.joint.mode.data() + pass.model->batches[k].first_joint + 2 * lane_count, 1);
    if constexpr (count > 0) fetch(&state.branch[branch_index(count, next, 0, 0)], 6 * count * sizeof(Singles));
  }
  /// Of patches that are likely to go point by point, too.
  [[gnu::always_inline]] void notes() const {
    if (k + 1 == pass.model->batches.size()) return;
    fetch(&pass.state->joint.energy[energy_index({k + 1, 0}, 0)], 3 * sizeof(Lanes));
    fetch(&pass.state->joint.largest[largest_index({k + 1, 0}, 0)], 2 * sizeof(Lanes));
  }
};

/// One batch, from its pose to its wrenches, with `count` branches.
template <int count>
struct BatchPass {
  const PatchPass& pass;
  const JointBatch& batch;
  std::size_t k, first;
  BatchAhead<count> ahead{pass, k};
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
    LaneMask stays{}, closed{};
    Resultant<Lanes> resultant;  // of closed lanes alone
  };
  [[gnu::always_inline]] Intact intact_lanes(LaneMask keep, TileFindings& findings) {
    LaneElastic e = {{jump.n, jump.s, jump.t, jump.rn, jump.rs, jump.rt}};
    if (any(bytes_with(modes, mode_slid)))
      for (int c = 0; c < 3; ++c) e.u[c + 1] -= slip[c];
    const LaneMask broken = bytes_with(modes, mode_broken);
    const LaneCheck check = check_corners(*pass.model, batch, e, strength, broken, keep);
    const LaneMask open = broken & check.open, closed = without(check.admissible, open);
    if (any(open)) follow_open(*pass.model, batch, e, open, slip, mode, largest_openings());
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
    ahead.notes();
    const PointRows rows_of_points(pass.model->rule, pass.model->points, batch);
    PointsPass<count, false> points(batch, strength, RigidField(jump), pass.branches, active, LaneMask{},
                                    RigidField(change), pass.energies != nullptr, pass.state->joint);
    const LanePoints found = points.run(rows_of_points);
    note_points(found, active, k, pass.state->joint);
    findings.elastic += select(active, found.elastic, splat(0.0));
    findings.stored += select(active, found.stored, splat(0.0));
    const LaneMask back = active & found.all_open & found.all_broken;
    if (pass.shortcut && any(back)) to_intact(jump, pass.branches, back, batch.count, mode, slip, kept);
    return found.resultant;
  }

  Lanes& largest_openings() const {
    return *reinterpret_cast<Lanes*>(&pass.state->joint.largest[largest_index({k, 0}, 0)]);
  }

  void leave_intact(LaneMask points) {
    const LaneMask leave = without(points, bytes_with(modes, mode_points));
    if (!any(leave)) return;
    for (int lane = 0; lane < batch.count; ++lane)
      if (leave[lane]) joint_to_points(*pass.model, *pass.state, pass.branches, first + std::size_t(lane));
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
    // point_patch() keeps the last jump of its lanes itself.
    ahead.poses();
    note_change(jump, without(live, keep | strength.brittle),
                reinterpret_cast<Singles*>(&pass.state->joint.last[last_index(k, 0)]), change);
    ahead.constants(0);
    Intact intact;
    if (any(keep)) intact = intact_lanes(keep, findings);
    const LaneMask points = without(live, intact.stays);
    ahead.constants(1);
    Triple<Lanes> force, moment;
    if (all(intact.closed)) {
      world_wrench(intact.resultant, jump, force, moment);
      store_wrenches(force, moment, rows);
    } else {
      mixed(intact, points, findings);
    }
    ahead.memory();
    add_up();
    findings.reclip |= without(live, strength.tie) & past_limits(*pass.model, batch, jump);
    findings.intact += count_of(intact.stays);
    findings.points += count_of(points);
  }

  /// A batch in which some lanes are open, gone or go point by point: those that fail the check from here on.
  [[gnu::noinline]] void mixed(const Intact& intact, LaneMask points, TileFindings& findings) {
    const Resultant<Lanes> nothing{};
    Resultant<Lanes> by_points{};
    const LaneMask brittle = points & strength.brittle, others = without(points, brittle);
    if (any(points)) leave_intact(points);
    if (any(brittle)) by_points = point_lanes(brittle, findings);
    Triple<Lanes> force, moment;
    world_wrench(select(intact.closed, intact.resultant, select(brittle, by_points, nothing)), jump, force, moment);
    store_wrenches(force, moment, rows);
    if (!any(others)) return;
    for (int lane = 0; lane < batch.count; ++lane)
      if (others[lane])
        point_patch(*pass.model, first + std::size_t(lane), pass.branches, *pass.state, rows + wrench_width * lane);
  }
};

/// Whether nothing is left of a batch; its wrenches are then none.
bool all_gone(const PatchPass& pass, const JointBatch& batch) {
  const auto first = std::size_t(batch.first_joint);
  const LaneBytes modes = load_bytes(&pass.state->joint.mode[first], batch.count);
  if (any(without(LaneMask::first(batch.count), bytes_with(modes, mode_gone)))) return false;
  if (pass.wrenches) std::fill_n(pass.wrenches + wrench_width * first, wrench_width * std::size_t(batch.count), 0.0);
  return true;
}

template <int count>
PassReport joints_of(const PatchPass& pass, std::size_t index) {
  const Tile& tile = pass.model->tiles[index];
  std::fill(pass.sums + wrench_width * std::size_t(tile.first_sum),
            pass.sums + wrench_width * std::size_t(tile.end_sum), 0.0);
  TileFindings found;
  for (auto k = std::size_t(tile.first_batch); k < std::size_t(tile.end_batch); ++k)
    if (!all_gone(pass, pass.model->batches[k])) BatchPass<count>(pass, k).run(found);
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
