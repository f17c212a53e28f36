// Sides: a side is the group of lanes that a long kernel processes at a time. With registers of four or two numbers it
// processes the eight lanes register by register. Fewer intermediate values are then stored in memory, and a rare case
// in one lane delays three lanes or one lane instead of seven (docs/developer/performance-notes.md). The results of a
// lane are the same.
#pragma once
#include <type_traits>

#include "solver/base/lanes.h"

namespace voussoir {

/// All lanes at once. A side has its own types for numbers, numbers in single precision and masks, and selects them
/// from those of all lanes with of().
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

  /// Converts records of eight numbers, one for each lane, to numbers by lane, and back.
  static constexpr int lanes = lane_count;
  [[gnu::always_inline]] static void to_lanes(const Lanes (&record)[lane_count], Lanes (&number)[lane_count]) {
    for (int i = 0; i < lane_count; ++i) number[i] = record[i];
    transpose(number);
  }
  [[gnu::always_inline]] static void to_records(const Lanes (&number)[lane_count], Lanes (&record)[lane_count]) {
    to_lanes(number, record);
  }
};

#if defined(VOUSSOIR_LANES_IN_PARTS)

using SideNumbers = parts::Register;
using SideMask = parts::RegisterMask;
using SideFloats = float __attribute__((vector_size(4 * register_lanes)));
using SideBits = std::int32_t __attribute__((vector_size(4 * register_lanes)));
struct SideBytes {
  SideMask of_lane;
};
using parts::any, parts::at_most, parts::flip, parts::larger, parts::less, parts::magnitude, parts::select,
    parts::square_root;

constexpr int register_count = lane_count / register_lanes;
/// Calls f(number) for each of the registers that contain all lanes.
template <class F>
[[gnu::always_inline]] inline void each_register(const F& f) {
  f(std::integral_constant<int, 0>{}), f(std::integral_constant<int, 1>{});
  if constexpr (register_count == 4) f(std::integral_constant<int, 2>{}), f(std::integral_constant<int, 3>{});
}

/// The lanes of one register.
template <int which>
struct RegisterSide {
  using Numbers = SideNumbers;
  using Floats = SideFloats;
  using Mask = SideMask;
  static constexpr int lanes = register_lanes, first_lane = which * lanes;

  template <class T>
  [[gnu::always_inline]] static auto& of(T& all) {
    return register_of<which, register_count>(all);
  }
  [[gnu::always_inline]] static const Floats& of(const Singles& all) {
    return reinterpret_cast<const Floats*>(&all)[which];
  }
  [[gnu::always_inline]] static Floats& of(Singles& all) { return reinterpret_cast<Floats*>(&all)[which]; }
  [[gnu::always_inline]] static Numbers splat(double x) { return x - Numbers{}; }
  [[gnu::always_inline]] static SideBytes load_bytes(const std::uint8_t* bytes) {
    using Bytes = std::uint8_t __attribute__((vector_size(lanes)));
    Bytes few;
    std::memcpy(&few, bytes, sizeof(few));
    return {__builtin_convertvector(few, Mask)};
  }

  [[gnu::always_inline]] static void to_lanes(const Lanes (&record)[lanes], Numbers (&number)[lane_count]) {
    each_register([&](auto k) __attribute__((always_inline)) {
      Numbers square[lanes];
      for (int i = 0; i < lanes; ++i) square[i] = register_of<k, register_count>(record[i]);
      parts::transpose(square);
      for (int i = 0; i < lanes; ++i) number[lanes * k + i] = square[i];
    });
  }
  [[gnu::always_inline]] static void to_records(const Numbers (&number)[lane_count], Lanes (&record)[lanes]) {
    each_register([&](auto k) __attribute__((always_inline)) {
      Numbers square[lanes];
      for (int i = 0; i < lanes; ++i) square[i] = number[lanes * k + i];
      parts::transpose(square);
      for (int i = 0; i < lanes; ++i) register_of<k, register_count>(record[i]) = square[i];
    });
  }

 private:
  /// The register with this number among the `count` registers of these numbers.
  template <int i, int count, class T>
  [[gnu::always_inline]] static auto& register_of(T& all) {
    if constexpr (count == 1)
      return all;
    else if constexpr (i < count / 2)
      return register_of<i, count / 2>(all.low);
    else
      return register_of<i - count / 2, count / 2>(all.high);
  }
};

#if defined(__AVX2__)
[[gnu::always_inline]] inline SideNumbers widen(SideFloats x) {
  return _mm256_cvtps_pd(x);
}
[[gnu::always_inline]] inline SideFloats narrow(SideNumbers x) {
  return _mm256_cvtpd_ps(x);
}
#else
[[gnu::always_inline]] inline SideNumbers widen(SideFloats x) {
  return parts::widen(__builtin_shufflevector(x, SideFloats{}, 0, 1, 2, 3)).low;
}
[[gnu::always_inline]] inline SideFloats narrow(SideNumbers x) {
  return __builtin_convertvector(x, SideFloats);
}
#endif
[[gnu::always_inline]] inline SideMask without(SideMask a, SideMask b) {
  return a & ~b;
}
[[gnu::always_inline]] inline bool all(SideMask m) {
  return !any(~m);
}
[[gnu::always_inline]] inline SideMask bytes_with(SideBytes bytes, int bits) {
  return parts::not_zero(bytes.of_lane & std::int64_t(bits));
}
[[gnu::always_inline]] inline SideFloats of_floats(SideMask m) {
  using Halves = std::int32_t __attribute__((vector_size(sizeof(SideMask))));
#if defined(__AVX2__)
  return SideFloats(__builtin_shufflevector(Halves(m), Halves(m), 0, 2, 4, 6));
#else
  return SideFloats(__builtin_shufflevector(Halves(m), Halves(m), 0, 2));
#endif
}
[[gnu::always_inline]] inline SideFloats within(SideMask m, SideFloats x) {
  return SideFloats(SideBits(of_floats(m)) & SideBits(x));
}
[[gnu::always_inline]] inline void store_lanes(SideMask m, SideNumbers x, SideNumbers& to) {
  to = parts::select(m, x, to);
}
[[gnu::always_inline]] inline void store_lanes(SideMask m, SideFloats x, SideFloats& to) {
#if defined(__AVX2__)
  to = _mm_blendv_ps(to, x, of_floats(m));
#else
  const auto mask = SideBits(of_floats(m));
  to = SideFloats((mask & SideBits(x)) | (~mask & SideBits(to)));
#endif
}
[[gnu::always_inline]] inline void store_flags(SideMask first, SideMask second, std::uint8_t* bytes) {
  using Bytes = std::uint8_t __attribute__((vector_size(register_lanes)));
  const auto few = __builtin_convertvector((first & 1) | (second & 2), Bytes);
  std::memcpy(bytes, &few, sizeof(few));
}

#endif

/// Masks of any side that are known at compile time: code for unset lanes is not compiled.
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

/// Calls f(side) for each of the sides that together contain all lanes.
template <class F>
[[gnu::always_inline]] inline void each_side(const F& f) {
#if defined(VOUSSOIR_LANES_IN_PARTS)
  each_register([&f](auto which) __attribute__((always_inline)) { f(RegisterSide<which>{}); });
#else
  f(WholeSide{});
#endif
}

}  // namespace voussoir
