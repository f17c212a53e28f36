// Eight doubles side by side: a SIMD lane is a patch (or a body). The compiler splits them where registers are
// narrower, so the bits do not depend on how many lanes a register has.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace voussoir {

constexpr int lane_count = 8;
using Lanes = double __attribute__((vector_size(8 * lane_count)));
using Singles = float __attribute__((vector_size(4 * lane_count)));  // half the bytes, where seven digits do
using Pairs = float __attribute__((vector_size(8 * lane_count)));    // two of them
using LaneInts = std::int64_t __attribute__((vector_size(8 * lane_count)));
using SingleInts = std::int32_t __attribute__((vector_size(4 * lane_count)));
using LaneBytes = std::uint8_t __attribute__((vector_size(lane_count)));

[[gnu::always_inline]] inline Lanes splat(double x) {
  return Lanes{x, x, x, x, x, x, x, x};
}
[[gnu::always_inline]] inline Singles singles(double x) {
  const auto f = float(x);
  return Singles{f, f, f, f, f, f, f, f};
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
[[gnu::always_inline]] inline Pairs load_pair(const Singles* rows) {
  Pairs x;
  std::memcpy(&x, rows, sizeof(x));
  return x;
}

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__) && defined(__AVX512BW__)
/// True or false in each lane: one bit a lane, in a mask register.
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
/// Zero outside the mask.
[[gnu::always_inline]] inline Singles within(LaneMask m, Singles x) {
  return _mm256_maskz_mov_ps(m.bits, x);
}
/// Lanes of the mask alone are written.
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
#else
struct LaneMask {
  LaneInts bits = {};  // all of a lane's set where true
  static LaneMask first(int count) {
    LaneMask m;
    for (int i = 0; i < count; ++i) m.bits[i] = -1;
    return m;
  }
  bool operator[](int lane) const { return bits[lane] != 0; }
  LaneMask operator&(LaneMask m) const { return {bits & m.bits}; }
  LaneMask operator|(LaneMask m) const { return {bits | m.bits}; }
  LaneMask operator^(LaneMask m) const { return {bits ^ m.bits}; }
  LaneMask operator~() const { return {~bits}; }
};
[[gnu::always_inline]] inline Lanes widen(const Singles& x) {
  return __builtin_convertvector(x, Lanes);
}
[[gnu::always_inline]] inline Singles narrow(const Lanes& x) {
  return __builtin_convertvector(x, Singles);
}
[[gnu::always_inline]] inline LaneMask less(Lanes a, Lanes b) {
  return {a < b};
}
[[gnu::always_inline]] inline LaneMask at_most(Lanes a, Lanes b) {
  return {a <= b};
}
[[gnu::always_inline]] inline Lanes select(LaneMask m, Lanes a, Lanes b) {
  return m.bits ? a : b;
}
[[gnu::always_inline]] inline Lanes square_root(Lanes x) {
  Lanes r;
  for (int i = 0; i < lane_count; ++i) r[i] = std::sqrt(x[i]);
  return r;
}
[[gnu::always_inline]] inline Lanes larger(Lanes a, Lanes b) {
  return a > b ? a : b;
}
[[gnu::always_inline]] inline Singles select(LaneMask m, Singles a, Singles b) {
  return __builtin_convertvector(m.bits, SingleInts) ? a : b;
}
[[gnu::always_inline]] inline Singles within(LaneMask m, Singles x) {
  return select(m, x, Singles{});
}
[[gnu::always_inline]] inline void store_lanes(LaneMask m, Lanes x, Lanes& to) {
  to = select(m, x, to);
}
[[gnu::always_inline]] inline void store_lanes(LaneMask m, Singles x, Singles& to) {
  to = select(m, x, to);
}
[[gnu::always_inline]] inline int count_of(LaneMask m) {
  std::int64_t n = 0;
  for (int i = 0; i < lane_count; ++i) n -= m.bits[i];
  return int(n);
}
[[gnu::always_inline]] inline bool any(LaneMask m) {
  return count_of(m) != 0;
}
[[gnu::always_inline]] inline bool all(LaneMask m) {
  return count_of(m) == lane_count;
}
[[gnu::always_inline]] inline LaneMask bytes_with(LaneBytes bytes, int bits) {
  return {(__builtin_convertvector(bytes, LaneInts) & std::int64_t(bits)) != 0};
}
#endif

[[gnu::always_inline]] inline Lanes magnitude(Lanes x) {
  return Lanes(LaneInts(x) & std::int64_t(0x7fffffffffffffff));
}
/// x, and −x where `by` is negative.
[[gnu::always_inline]] inline Lanes flip(Lanes x, Lanes by) {
  return Lanes(LaneInts(x) ^ (LaneInts(by) & std::int64_t(0x8000000000000000)));
}

[[gnu::always_inline]] inline LaneMask& operator&=(LaneMask& a, LaneMask b) {
  return a = a & b;
}
[[gnu::always_inline]] inline LaneMask& operator|=(LaneMask& a, LaneMask b) {
  return a = a | b;
}
[[gnu::always_inline]] inline LaneMask without(LaneMask a, LaneMask b) {
  return a & ~b;
}

/// A byte a lane: 1 where `first`, 2 where `second`, or their sum.
[[gnu::always_inline]] inline void store_flags(LaneMask first, LaneMask second, std::uint8_t* bytes) {
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__) && defined(__BMI2__)
  const std::uint64_t packed = _pdep_u64(first.bits, 0x0101010101010101) | _pdep_u64(second.bits, 0x0202020202020202);
  std::memcpy(bytes, &packed, lane_count);
#else
  for (int lane = 0; lane < lane_count; ++lane)
    bytes[lane] = std::uint8_t((first[lane] ? 1 : 0) + (second[lane] ? 2 : 0));
#endif
}

/// The first `count` bytes, zeros in the other lanes.
[[gnu::always_inline]] inline LaneBytes load_bytes(const std::uint8_t* bytes, int count = lane_count) {
  LaneBytes b = {};
  if (count == lane_count)
    std::memcpy(&b, bytes, lane_count);
  else
    std::memcpy(&b, bytes, std::size_t(count));
  return b;
}

/// Rows become columns: eight records of eight numbers to the same number of all eight side by side, and back.
[[gnu::always_inline]] inline void transpose(Lanes (&r)[lane_count]) {
  Lanes pairs[8], fours[8];
  for (int i = 0; i < 8; i += 2) {
    pairs[i] = __builtin_shufflevector(r[i], r[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pairs[i + 1] = __builtin_shufflevector(r[i], r[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int i = 0; i < 8; i += 4)
    for (int odd = 0; odd < 2; ++odd) {
      fours[i + odd] = __builtin_shufflevector(pairs[i + odd], pairs[i + 2 + odd], 0, 1, 8, 9, 4, 5, 12, 13);
      fours[i + 2 + odd] = __builtin_shufflevector(pairs[i + odd], pairs[i + 2 + odd], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (int i = 0; i < 4; ++i) {
    r[i] = __builtin_shufflevector(fours[i], fours[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    r[i + 4] = __builtin_shufflevector(fours[i], fours[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

/// Three lanes-vectors, with the few operations the kernels need; T is double or Lanes.
template <class T>
struct Triple {
  T x, y, z;
};
template <class T>
[[gnu::always_inline]] inline Triple<T> operator+(const Triple<T>& a, const Triple<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
[[gnu::always_inline]] inline Triple<T> operator-(const Triple<T>& a, const Triple<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
[[gnu::always_inline]] inline Triple<T> operator*(T s, const Triple<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
[[gnu::always_inline]] inline Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
[[gnu::always_inline]] inline T dot(const Triple<T>& a, const Triple<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Unit quaternion w + v, rotating reference into present axes.
template <class T>
struct Quat {
  T w;
  Triple<T> v;
};
template <class T>
[[gnu::always_inline]] inline Quat<T> operator*(const Quat<T>& a, const Quat<T>& b) {
  const Triple<T> c = cross(a.v, b.v);
  return {a.w * b.w - dot(a.v, b.v),
          {a.w * b.v.x + b.w * a.v.x + c.x, a.w * b.v.y + b.w * a.v.y + c.y, a.w * b.v.z + b.w * a.v.z + c.z}};
}
/// R x − x without cancellation: 2 w (v × x) + 2 v × (v × x).
template <class T>
[[gnu::always_inline]] inline Triple<T> turn_change(const Quat<T>& q, const Triple<T>& x) {
  const Triple<T> c = cross(q.v + q.v, x);
  return q.w * c + cross(q.v, c);
}
template <class T>
[[gnu::always_inline]] inline Triple<T> turn(const Quat<T>& q, const Triple<T>& x) {
  return x + turn_change(q, x);
}
template <class T>
[[gnu::always_inline]] inline Triple<T> turn_back(const Quat<T>& q, const Triple<T>& x) {
  return turn(Quat<T>{q.w, {-q.v.x, -q.v.y, -q.v.z}}, x);
}

/// The same rotation as a matrix, by its columns: cheaper from the second vector on.
template <class T>
struct Axes {
  Triple<T> x, y, z;
};
/// Of a quaternion of any length, `twice` = 2/|q|².
template <class T>
[[gnu::always_inline]] inline Axes<T> axes_of(const Quat<T>& q, T twice) {
  const Triple<T>& v = q.v;
  const Triple<T> t = twice * v;
  const T xy = v.x * t.y, xz = v.x * t.z, yz = v.y * t.z;
  return {{1.0 - v.y * t.y - v.z * t.z, xy + q.w * t.z, xz - q.w * t.y},
          {xy - q.w * t.z, 1.0 - v.x * t.x - v.z * t.z, yz + q.w * t.x},
          {xz + q.w * t.y, yz - q.w * t.x, 1.0 - v.x * t.x - v.y * t.y}};
}
template <class T>
[[gnu::always_inline]] inline Triple<T> turn(const Axes<T>& axes, const Triple<T>& x) {
  return x.x * axes.x + x.y * axes.y + x.z * axes.z;
}
template <class T>
[[gnu::always_inline]] inline Triple<T> turn_back(const Axes<T>& axes, const Triple<T>& x) {
  return {dot(axes.x, x), dot(axes.y, x), dot(axes.z, x)};
}

}  // namespace voussoir
