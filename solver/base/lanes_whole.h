// Lanes for processors with registers of eight doubles (AVX-512). Included by lanes.h.
#pragma once
#include <immintrin.h>

namespace voussoir {

constexpr int register_lanes = 8;
using Lanes = double __attribute__((vector_size(8 * lane_count)));
using Singles = float __attribute__((vector_size(4 * lane_count)));  // half the bytes, if seven digits are sufficient
using Pairs = float __attribute__((vector_size(8 * lane_count)));    // two of them
using LaneInts = std::int64_t __attribute__((vector_size(8 * lane_count)));

[[gnu::always_inline]] inline Lanes splat(double x) {
  return Lanes{x, x, x, x, x, x, x, x};
}
[[gnu::always_inline]] inline Singles singles(double x) {
  const auto f = float(x);
  return Singles{f, f, f, f, f, f, f, f};
}
[[gnu::always_inline]] inline Lanes pair(Quad low, Quad high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline Quad low(Lanes x) {
  return __builtin_shufflevector(x, x, 0, 1, 2, 3);
}
[[gnu::always_inline]] inline Quad high(Lanes x) {
  return __builtin_shufflevector(x, x, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline Pairs pair(Singles low, Singles high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
[[gnu::always_inline]] inline Singles low(Pairs x) {
  return __builtin_shufflevector(x, x, 0, 1, 2, 3, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline Singles high(Pairs x) {
  return __builtin_shufflevector(x, x, 8, 9, 10, 11, 12, 13, 14, 15);
}

/// A mask: one bit for each lane, in a mask register.
struct LaneMask {
  __mmask8 bits = 0;
  static LaneMask first(int count) { return {__mmask8((1u << count) - 1u)}; }
  bool operator[](int lane) const { return (bits >> lane) & 1; }
  LaneMask operator&(LaneMask m) const { return {__mmask8(bits & m.bits)}; }
  LaneMask operator|(LaneMask m) const { return {__mmask8(bits | m.bits)}; }
  LaneMask operator^(LaneMask m) const { return {__mmask8(bits ^ m.bits)}; }
  LaneMask operator~() const { return {__mmask8(~bits)}; }
};
[[gnu::always_inline]] inline Lanes widen(const Singles& x) {
  return _mm512_cvtps_pd(x);
}
[[gnu::always_inline]] inline Singles narrow(const Lanes& x) {
  return _mm512_cvtpd_ps(x);
}
[[gnu::always_inline]] inline LaneMask less(Lanes a, Lanes b) {
  return {_mm512_cmp_pd_mask(a, b, _CMP_LT_OQ)};
}
[[gnu::always_inline]] inline LaneMask at_most(Lanes a, Lanes b) {
  return {_mm512_cmp_pd_mask(a, b, _CMP_LE_OQ)};
}
[[gnu::always_inline]] inline Lanes select(LaneMask m, Lanes a, Lanes b) {
  return _mm512_mask_blend_pd(m.bits, b, a);
}
[[gnu::always_inline]] inline Lanes square_root(Lanes x) {
  return _mm512_sqrt_pd(x);
}
[[gnu::always_inline]] inline Lanes larger(Lanes a, Lanes b) {
  return _mm512_max_pd(a, b);
}
/// Zero in lanes outside the mask.
[[gnu::always_inline]] inline Singles within(LaneMask m, Singles x) {
  return _mm256_maskz_mov_ps(m.bits, x);
}
/// Writes only the lanes of the mask.
[[gnu::always_inline]] inline void store_lanes(LaneMask m, Lanes x, Lanes& to) {
  _mm512_mask_store_pd(&to, m.bits, x);
}
[[gnu::always_inline]] inline void store_lanes(LaneMask m, Singles x, Singles& to) {
  _mm256_mask_storeu_ps(reinterpret_cast<float*>(&to), m.bits, x);
}
[[gnu::always_inline]] inline bool any(LaneMask m) {
  return m.bits != 0;
}
[[gnu::always_inline]] inline bool all(LaneMask m) {
  return m.bits == 0xff;
}
[[gnu::always_inline]] inline int count_of(LaneMask m) {
  return __builtin_popcount(m.bits);
}
/// Lanes whose byte has any of these bits set.
[[gnu::always_inline]] inline LaneMask bytes_with(LaneBytes bytes, int bits) {
  std::int64_t packed;
  std::memcpy(&packed, &bytes, lane_count);
  return {__mmask8(_mm_test_epi8_mask(_mm_cvtsi64_si128(packed), _mm_set1_epi8(char(bits))))};
}

[[gnu::always_inline]] inline Lanes magnitude(Lanes x) {
  return Lanes(LaneInts(x) & std::int64_t(0x7fffffffffffffff));
}
/// −x in lanes where `by` is negative, else x.
[[gnu::always_inline]] inline Lanes flip(Lanes x, Lanes by) {
  return Lanes(LaneInts(x) ^ (LaneInts(by) & std::int64_t(0x8000000000000000)));
}

/// One byte for each lane: 1 for `first`, 2 for `second`, or their sum.
[[gnu::always_inline]] inline void store_flags(LaneMask first, LaneMask second, std::uint8_t* bytes) {
  const std::uint64_t packed = _pdep_u64(first.bits, 0x0101010101010101) | _pdep_u64(second.bits, 0x0202020202020202);
  std::memcpy(bytes, &packed, lane_count);
}

/// Transposes four records of four pairs of numbers. The selection of the even or odd pairs is one instruction that
/// overwrites neither of its inputs.
[[gnu::always_inline]] inline void transpose_pairs(Lanes (&r)[4]) {
  const auto even = [](Lanes a, Lanes b) { return __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13); };
  const auto odd = [](Lanes a, Lanes b) { return __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15); };
  const Lanes even01 = even(r[0], r[1]), even23 = even(r[2], r[3]), odd01 = odd(r[0], r[1]), odd23 = odd(r[2], r[3]);
  r[0] = even(even01, even23), r[1] = even(odd01, odd23), r[2] = odd(even01, even23), r[3] = odd(odd01, odd23);
}

/// Transposes eight records of eight numbers to eight vectors by number, and back.
[[gnu::always_inline]] inline void transpose(Lanes (&r)[lane_count]) {
  Lanes low[4], high[4];  // of two records: numbers 0, 2, 4, 6, and 1, 3, 5, 7
  for (int i = 0; i < 4; ++i) {
    low[i] = __builtin_shufflevector(r[2 * i], r[2 * i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    high[i] = __builtin_shufflevector(r[2 * i], r[2 * i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  transpose_pairs(low), transpose_pairs(high);
  for (int i = 0; i < 4; ++i) r[2 * i] = low[i], r[2 * i + 1] = high[i];
}

}  // namespace voussoir
