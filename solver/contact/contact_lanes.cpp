// Eight contacts at a time, always point by point; while they stay wholly open their jump alone.
#include "solver/contact/lane_points.h"
#include "solver/model/with_branches.h"

namespace voussoir {

namespace {

/// As patch_jump().
[[gnu::always_inline]] inline Jump<Lanes> contact_jump(const ContactBatch& c, const double* pose) {
  const LanePoses a = gather(pose, c.patch.pose_a), b = gather(pose, c.patch.pose_b);
  const Quat<Lanes> fa = a.q * Quat<Lanes>{c.patch.frame[0], load(c.patch.frame + 1)};
  Quat<Lanes> fb = b.q * Quat<Lanes>{c.frame_b[0], load(c.frame_b + 1)};
  const Lanes same = fa.w * fb.w + dot(fa.v, fb.v);
  fb = {flip(fb.w, same), {flip(fb.v.x, same), flip(fb.v.y, same), flip(fb.v.z, same)}};
  const Quat<Lanes> relative = fb * Quat<Lanes>{fa.w, {-fa.v.x, -fa.v.y, -fa.v.z}};
  const Triple<Lanes> move_a = a.u + turn_change(a.q, load(c.patch.arm_a));
  const Triple<Lanes> move_b = b.u + turn_change(b.q, load(c.patch.arm_b));
  const Triple<Lanes> shift = load(c.shift);
  return local_jump(shift + (move_b - move_a), shift + (move_a + move_b), load(c.patch.place), relative,
                    Quat<Lanes>{fa.w + fb.w, fa.v + fb.v});
}

/// Lanes in which every point is open, judged by the gap at the centroid and how far the turn can close it.
[[gnu::always_inline]] inline LaneMask surely_open(const ContactBatch& c, const Jump<Lanes>& gaps) {
  const Lanes closes = (gaps.rs * gaps.rs + gaps.rt * gaps.rt) * c.reach * c.reach;
  return less(splat(0.0), gaps.n) & less(closes, gaps.n * gaps.n);
}

/// What a tile's next batches need, asked for while the first is computed, a part at a time (see fetch()).
struct ContactsAhead {
  const State& state;
  const std::int32_t *batch, *end;

  /// Of the batch after the next, in three parts.
  [[gnu::always_inline]] void constants(std::size_t part) const {
    if (end - batch <= 2) return;
    fetch_part<3>(state.contact_batches[std::size_t(batch[2])], part);
    if (part == 2) fetch(&state.contact.last[last_index(std::size_t(batch[2]), 0)], 6 * sizeof(Singles));
  }
  /// Of the next, which by then has been asked for itself.
  [[gnu::always_inline]] void poses() const {
    if (end - batch <= 1) return;
    const JointBatch& next = state.contact_batches[std::size_t(batch[1])].patch;
    fetch_poses(state.pose.data(), next.pose_a), fetch_poses(state.pose.data(), next.pose_b);
  }
};

template <int count>
struct ContactPass {
  const PatchPass& pass;
  std::size_t k;
  const ContactsAhead& ahead;
  const ContactBatch& batch;
  PatchMemory& memory;
  std::uint8_t* mode;
  Lanes change[6];

  ContactPass(const PatchPass& p, std::size_t index, const ContactsAhead& next)
      : pass(p),
        k(index),
        ahead(next),
        batch(p.state->contact_batches[index]),
        memory(p.state->contact),
        mode(&memory.mode[lane_count * index]) {}

  void run(PassReport& report, TileEnergy* energy) {
    const LaneBytes modes = load_bytes(mode);
    const LaneMask live = ~bytes_with(modes, mode_gone);
    ahead.poses();
    if (!any(live)) return;
    const Jump<Lanes> j = contact_jump(batch, pass.state->pose.data());
    ahead.constants(0);
    Jump<Lanes> gaps = j;
    gaps.n += batch.gap[0], gaps.rs += batch.gap[1], gaps.rt += batch.gap[2];
    const LaneMask was_open = live & bytes_with(modes, mode_open);
    const LaneMask still = was_open & surely_open(batch, gaps);
    const LaneMask leaving = without(was_open, still), active = without(live, still);
    for (int lane = 0; any(leaving) && lane < lane_count; ++lane)
      if (leaving[lane]) mode[lane] &= std::uint8_t(~mode_open);
    note_change<WholeSide>(j, EveryLane{}, reinterpret_cast<Singles*>(&memory.last[last_index(k, 0)]), change);
    ahead.constants(1);
    Triple<Lanes> force{}, moment{};
    if (any(active)) {
      const WorldWrench<Lanes> w(select(active, points(gaps, active, leaving, energy), Resultant<Lanes>{}), j);
      force = w.force, moment = w.moment;
    }
    ahead.constants(2);
    store_wrenches(force, moment, pass.contact_wrenches + wrench_width * lane_count * k);
    report.reclip |= any(live & past_limits(SlidingLimits(*pass.model), batch.patch.area, j));
    report.contacts += count_of(live);
  }

  [[gnu::noinline]] Resultant<Lanes> points(const Jump<Lanes>& gaps, LaneMask active, LaneMask leaving,
                                            TileEnergy* energy) {
    const LaneStrength strength = unbonded();
    const PointRows rows(pass.model->rule, pass.state->contact_points, batch.patch);
    const RigidField<Lanes> now = rigid_field(gaps), since = rigid_field(change);
    const PointsTask<count, RigidField<Lanes>> task = {batch.patch, strength, pass.branches,     now,   since,
                                                       active,      leaving,  energy != nullptr, memory};
    LanePoints found = pass_points<true>(task, rows);
    found.opening = splat(0.0);  // the gap of a contact that was found apart is no opening: it keeps what it was handed
    note_points(found, active, k, memory);
    note_open(active & found.all_open & found.all_broken);
    if (energy) {
      energy->elastic += sum_of(select(active, found.elastic, splat(0.0)));
      energy->branches += sum_of(select(active, found.stored, splat(0.0)));
    }
    return found.resultant;
  }

  /// Contacts have no bond, and often one law each.
  [[gnu::always_inline]] LaneStrength unbonded() const {
    LaneStrength s{};
    for (int lane = 0; lane < lane_count; ++lane) {
      const LawConstants& law = pass.model->laws[std::size_t(batch.patch.law_of[lane])];
      s.residual_cohesion[lane] = law.residual_cohesion;
      s.residual_tangent[lane] = law.residual_tan_friction;
      // By the time a patch is clipped anew it has slid so far that the dilation of composite joints has faded.
      s.dilation[lane] = is_composite(law) && law.dilation_length > 0.0 ? 0.0 : law.tan_dilation;
    }
    return s;
  }

  void note_open(LaneMask open) const {
    for (int lane = 0; any(open) && lane < lane_count; ++lane)
      if (open[lane]) mode[lane] |= mode_broken | mode_open;
  }
};

template <int count>
PassReport contacts_of(const PatchPass& pass, const std::int32_t* begin, const std::int32_t* end, TileEnergy* energy) {
  PassReport report;
  for (; begin != end; ++begin) {
    const ContactsAhead ahead{*pass.state, begin, end};
    ContactPass<count>(pass, std::size_t(*begin), ahead).run(report, energy);
  }
  return report;
}

}  // namespace

PassReport PatchPass::contacts(std::size_t tile, const std::int32_t* begin, const std::int32_t* end) const {
  TileEnergy* energy = energies ? &energies[tile] : nullptr;
  return with_branches(branches.count, [&](auto count) { return contacts_of<count>(*this, begin, end, energy); });
}

}  // namespace voussoir
