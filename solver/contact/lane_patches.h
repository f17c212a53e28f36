// Common functions of the kernels for eight patches side by side: input of poses, output of wrenches, and slip of
// patches.
#pragma once
#include "solver/base/lane_sides.h"
#include "solver/contact/jump.h"

namespace voussoir {

template <class Side = WholeSide>
[[gnu::always_inline]] inline Triple<typename Side::Numbers> load(const Lanes* x) {
  return {Side::of(x[0]), Side::of(x[1]), Side::of(x[2])};
}

template <class L>
struct PosesOf {
  Triple<L> u;
  Quat<L> q;
};
using LanePoses = PosesOf<Lanes>;

/// `places` are the indices at which the eight poses begin.
template <class Side = WholeSide>
[[gnu::always_inline]] inline PosesOf<typename Side::Numbers> gather(const double* pose, const std::int32_t* places) {
  Lanes record[Side::lanes];
  typename Side::Numbers r[lane_count];
  for (int lane = 0; lane < Side::lanes; ++lane)
    record[lane] = *reinterpret_cast<const Lanes*>(pose + places[Side::first_lane + lane]);
  Side::to_lanes(record, r);
  return {{r[0], r[1], r[2]}, {r[3], {r[4], r[5], r[6]}}};
}

/// Prefetches eight poses, see fetch().
[[gnu::always_inline]] inline void fetch_poses(const double* pose, const std::int32_t* places) {
  for (int lane = 0; lane < lane_count; ++lane) fetch(pose + places[lane], pose_width * sizeof(double));
}

/// Prefetches one of several parts of a record, see fetch().
template <std::size_t parts, class Record>
[[gnu::always_inline]] inline void fetch_part(const Record& record, std::size_t part) {
  constexpr std::size_t size = (sizeof(Record) / cache_line + parts - 1) / parts * cache_line;
  fetch(reinterpret_cast<const char*>(&record) + part * size, size);
}

/// Wrenches of the patches of a side as rows of wrench_width numbers.
template <class Side = WholeSide>
struct WrenchRows {
  using L = typename Side::Numbers;
  Lanes row[Side::lanes];
  [[gnu::always_inline]] WrenchRows(const Triple<L>& f, const Triple<L>& m) {
    const L numbers[lane_count] = {f.x, f.y, f.z, m.x, m.y, m.z, L{}, L{}};
    Side::to_records(numbers, row);
  }
};
[[gnu::always_inline]] inline void store_wrenches(const Triple<Lanes>& f, const Triple<Lanes>& m, double* rows) {
  const WrenchRows<> wrenches(f, m);
  std::memcpy(rows, wrenches.row, sizeof(wrenches.row));
}

/// Replaces the last jump by `j` and returns the change. Both are rounded to single precision, so that the changes add
/// up to the jump. Only lanes of `noted` are written.
template <class Side>
[[gnu::always_inline]] inline void note_change(const Jump<typename Side::Numbers>& j, auto noted, Singles* last,
                                               typename Side::Numbers* change) {
  const typename Side::Numbers now[6] = {j.n, j.s, j.t, j.rn, j.rs, j.rt};
  for (int c = 0; c < 6; ++c) {
    const typename Side::Floats rounded = narrow(now[c]);
    change[c] = widen(typename Side::Floats(rounded - Side::of(last[c])));
    store_lanes(noted, rounded, Side::of(last[c]));
  }
}

/// See Model::slip_limit2() and turn_limit2().
struct SlidingLimits {
  Lanes slip2, least_area, turn2;
  explicit SlidingLimits(const Model& model)
      : slip2(splat(model.contact.reclip_slip * model.contact.reclip_slip)),
        least_area(splat(model.least_slip_area())),
        turn2(splat(model.turn_limit2())) {}
  template <class Side = WholeSide>
  [[gnu::always_inline]] auto slip_limit2(typename Side::Numbers area) const {
    return typename Side::Numbers(Side::of(slip2) * larger(area, Side::of(least_area)));
  }
};

/// Lanes whose slip or rotation exceeds its limit.
template <class Side = WholeSide>
[[gnu::always_inline]] inline auto past_limits(const SlidingLimits& limits, typename Side::Numbers area,
                                               const Jump<typename Side::Numbers>& j) {
  using L = typename Side::Numbers;
  const L slip = j.s * j.s + j.t * j.t;
  const L turn = j.rn * j.rn + j.rs * j.rs + j.rt * j.rt;
  return less(limits.template slip_limit2<Side>(area), slip) | less(Side::of(limits.turn2), turn);
}

inline double sum_of(Lanes x) {
  double sum = 0.0;
  for (int lane = 0; lane < lane_count; ++lane) sum += x[lane];
  return sum;
}

}  // namespace voussoir
