// How many of eight lanes a long kernel takes at a time. Where registers hold four it goes through the lower half of
// the lanes and then through the upper: less of what is in hand is kept in memory, and what is rare in a lane holds up
// three others instead of seven (docs/performance.md). What it computes for a lane is the same.
#pragma once
#include "solver/base/lanes.h"

namespace voussoir {

/// All lanes at once. A side has numbers, numbers in single precision and a mask of its own, and takes them from those
/// of all lanes with of().
struct WholeSide {
  using Numbers = Lanes;
  using Floats = Singles;
  using Mask = LaneMask;
  static constexpr int first_lane = 0;

  template <class T>
  [[gnu::always_inline]] static T& of(T& all) {
    return all;
  }
  [[gnu::always_inline]] static Lanes splat(double x) { return voussoir::splat(x); }
  [[gnu::always_inline]] static LaneBytes load_bytes(const std::uint8_t* bytes) { return voussoir::load_bytes(bytes); }

  /// Records of eight numbers, one a lane, and the numbers lane by lane.
  static constexpr int lanes = lane_count;
  [[gnu::always_inline]] static void to_lanes(const Lanes (&record)[lane_count], Lanes (&number)[lane_count]) {
    for (int i = 0; i < lane_count; ++i) number[i] = record[i];
    transpose(number);
  }
  [[gnu::always_inline]] static void to_records(const Lanes (&number)[lane_count], Lanes (&record)[lane_count]) {
    to_lanes(number, record);
  }
};

#if defined(VOUSSOIR_REGISTERS_OF_FOUR)

using HalfNumbers = parts::Register;
using HalfMask = parts::RegisterMask;
using HalfFloats = float __attribute__((vector_size(16)));
struct HalfBytes {
  HalfMask of_lane;
};
using parts::any, parts::at_most, parts::flip, parts::larger, parts::less, parts::magnitude, parts::select,
    parts::square_root;

template <bool upper>
struct HalfSide {
  using Numbers = HalfNumbers;
  using Floats = HalfFloats;
  using Mask = HalfMask;
  static constexpr int first_lane = upper ? 4 : 0;

  template <class Half, class T>
  [[gnu::always_inline]] static const Half& of(const parts::Both<Half, T>& all) {
    return upper ? all.high : all.low;
  }
  template <class Half, class T>
  [[gnu::always_inline]] static Half& of(parts::Both<Half, T>& all) {
    return upper ? all.high : all.low;
  }
  [[gnu::always_inline]] static const Mask& of(const LaneMask& all) { return upper ? all.high : all.low; }
  [[gnu::always_inline]] static Mask& of(LaneMask& all) { return upper ? all.high : all.low; }
  [[gnu::always_inline]] static const Floats& of(const Singles& all) {
    return reinterpret_cast<const Floats*>(&all)[upper];
  }
  [[gnu::always_inline]] static Floats& of(Singles& all) { return reinterpret_cast<Floats*>(&all)[upper]; }
  [[gnu::always_inline]] static Numbers splat(double x) { return x - Numbers{}; }
  [[gnu::always_inline]] static HalfBytes load_bytes(const std::uint8_t* bytes) {
    std::int32_t four;
    std::memcpy(&four, bytes, sizeof(four));
    return {HalfMask(_mm256_cvtepu8_epi64(_mm_cvtsi32_si128(four)))};
  }

  static constexpr int lanes = 4;
  [[gnu::always_inline]] static void to_lanes(const Lanes (&record)[4], Numbers (&number)[lane_count]) {
    Numbers low[4], high[4];
    for (int i = 0; i < 4; ++i) low[i] = record[i].low, high[i] = record[i].high;
    parts::transpose(low), parts::transpose(high);
    for (int i = 0; i < 4; ++i) number[i] = low[i], number[i + 4] = high[i];
  }
  [[gnu::always_inline]] static void to_records(const Numbers (&number)[lane_count], Lanes (&record)[4]) {
    Numbers low[4], high[4];
    for (int i = 0; i < 4; ++i) low[i] = number[i], high[i] = number[i + 4];
    parts::transpose(low), parts::transpose(high);
    for (int i = 0; i < 4; ++i) record[i] = {low[i], high[i]};
  }
};

[[gnu::always_inline]] inline HalfNumbers widen(HalfFloats x) {
  return _mm256_cvtps_pd(x);
}
[[gnu::always_inline]] inline HalfFloats narrow(HalfNumbers x) {
  return _mm256_cvtpd_ps(x);
}
[[gnu::always_inline]] inline HalfMask without(HalfMask a, HalfMask b) {
  return a & ~b;
}
[[gnu::always_inline]] inline bool all(HalfMask m) {
  return !any(~m);
}
[[gnu::always_inline]] inline HalfMask bytes_with(HalfBytes bytes, int bits) {
  return (bytes.of_lane & std::int64_t(bits)) != 0;
}
[[gnu::always_inline]] inline HalfFloats of_floats(HalfMask m) {
  using Ints = std::int32_t __attribute__((vector_size(32)));
  return HalfFloats(__builtin_shufflevector(Ints(m), Ints(m), 0, 2, 4, 6));
}
[[gnu::always_inline]] inline HalfFloats within(HalfMask m, HalfFloats x) {
  return _mm_and_ps(of_floats(m), x);
}
[[gnu::always_inline]] inline void store_lanes(HalfMask m, HalfNumbers x, HalfNumbers& to) {
  to = parts::select(m, x, to);
}
[[gnu::always_inline]] inline void store_lanes(HalfMask m, HalfFloats x, HalfFloats& to) {
  to = _mm_blendv_ps(to, x, of_floats(m));
}
[[gnu::always_inline]] inline void store_flags(HalfMask first, HalfMask second, std::uint8_t* bytes) {
  using Bytes = std::uint8_t __attribute__((vector_size(32)));
  const auto flags = Bytes((first & 1) | (second & 2));
  const auto four = __builtin_shufflevector(flags, flags, 0, 8, 16, 24);
  std::memcpy(bytes, &four, sizeof(four));
}

#endif

/// Masks that are known beforehand, of any side: what they leave out is not even compiled.
struct EveryLane {};
struct NoLane {};
template <class L>
[[gnu::always_inline]] inline L select(EveryLane, L a, L) {
  return a;
}
template <class L>
[[gnu::always_inline]] inline L select(NoLane, L, L b) {
  return b;
}
template <class L>
[[gnu::always_inline]] inline L within(EveryLane, L x) {
  return x;
}
template <class L>
[[gnu::always_inline]] inline void store_lanes(EveryLane, L x, L& to) {
  to = x;
}

/// Calls f(side) for each of the sides that together are all lanes.
template <class F>
[[gnu::always_inline]] inline void each_side(const F& f) {
#if defined(VOUSSOIR_REGISTERS_OF_FOUR)
  f(HalfSide<false>{});
  f(HalfSide<true>{});
#else
  f(WholeSide{});
#endif
}

}  // namespace voussoir
