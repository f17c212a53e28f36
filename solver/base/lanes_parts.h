// Lanes for processors with registers of four (AVX2) or two doubles. Included by lanes.h. The compiler can split
// vectors of eight, but it stores them in memory between operations. Here a vector consists of two halves, and a half
// of two quarters if necessary (docs/developer/performance-notes.md).
#pragma once
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace voussoir {

#define VOUSSOIR_LANES_IN_PARTS
#if defined(__AVX2__)
constexpr int register_lanes = 4;
#else
constexpr int register_lanes = 2;
#endif

namespace parts {

using Register = double __attribute__((vector_size(8 * register_lanes)));
using RegisterSingles = float __attribute__((vector_size(8 * register_lanes)));  // twice as many
using RegisterMask = std::int64_t __attribute__((vector_size(8 * register_lanes)));

/// Two halves of numbers: vectors of T, or again two halves.
template <class Half, class T>
struct alignas(2 * sizeof(Half)) Both {
  Half low, high;

  Both() = default;
  [[gnu::always_inline]] Both(Half l, Half h) : low(l), high(h) {}
  [[gnu::always_inline]] Both(T x) : low(x - Half{}), high(x - Half{}) {}

  [[gnu::always_inline]] T operator[](int i) const { return reinterpret_cast<const T*>(this)[i]; }
  [[gnu::always_inline]] T& operator[](int i) { return reinterpret_cast<T*>(this)[i]; }

  [[gnu::always_inline]] friend Both operator+(Both a, Both b) { return {a.low + b.low, a.high + b.high}; }
  [[gnu::always_inline]] friend Both operator-(Both a, Both b) { return {a.low - b.low, a.high - b.high}; }
  [[gnu::always_inline]] friend Both operator*(Both a, Both b) { return {a.low * b.low, a.high * b.high}; }
  [[gnu::always_inline]] friend Both operator/(Both a, Both b) { return {a.low / b.low, a.high / b.high}; }
  [[gnu::always_inline]] friend Both operator-(Both a) { return {-a.low, -a.high}; }
  [[gnu::always_inline]] Both& operator+=(Both b) { return *this = *this + b; }
  [[gnu::always_inline]] Both& operator-=(Both b) { return *this = *this - b; }
  [[gnu::always_inline]] Both& operator*=(Both b) { return *this = *this * b; }
};

/// The first `count` of the lanes.
[[gnu::always_inline]] inline RegisterMask first_of(const RegisterMask&, int count) {
#if defined(__AVX2__)
  return RegisterMask{0, 1, 2, 3} < std::int64_t(count);
#else
  return RegisterMask{0, 1} < std::int64_t(count);
#endif
}

/// Two halves of a mask: in each lane all bits are set, or none.
template <class Half>
struct Masks {
  Half low{}, high{};

  [[gnu::always_inline]] static Masks first(int count) {
    return {first_of(Half{}, count), first_of(Half{}, count - int(sizeof(Half) / 8))};
  }
  [[gnu::always_inline]] bool operator[](int lane) const { return bits_of(*this) >> lane & 1; }

  [[gnu::always_inline]] Masks operator&(Masks m) const { return {low & m.low, high & m.high}; }
  [[gnu::always_inline]] Masks operator|(Masks m) const { return {low | m.low, high | m.high}; }
  [[gnu::always_inline]] Masks operator^(Masks m) const { return {low ^ m.low, high ^ m.high}; }
  [[gnu::always_inline]] Masks operator~() const { return {~low, ~high}; }
};
template <class Half>
Masks(Half, Half) -> Masks<Half>;

// Operations of a register.

[[gnu::always_inline]] inline RegisterMask less(Register a, Register b) {
  return a < b;
}
[[gnu::always_inline]] inline RegisterMask at_most(Register a, Register b) {
  return a <= b;
}
[[gnu::always_inline]] inline Register magnitude(Register x) {
  return Register(RegisterMask(x) & std::int64_t(0x7fffffffffffffff));
}
[[gnu::always_inline]] inline Register flip(Register x, Register by) {
  return Register(RegisterMask(x) ^ (RegisterMask(by) & std::int64_t(0x8000000000000000)));
}
[[gnu::always_inline]] inline RegisterSingles within(RegisterSingles mask, RegisterSingles x) {
  return RegisterSingles(RegisterMask(mask) & RegisterMask(x));
}

#if defined(__AVX2__)
[[gnu::always_inline]] inline Register select(RegisterMask m, Register a, Register b) {
  return _mm256_blendv_pd(b, a, Register(m));
}
[[gnu::always_inline]] inline RegisterSingles select(RegisterSingles m, RegisterSingles a, RegisterSingles b) {
  return _mm256_blendv_ps(b, a, m);
}
[[gnu::always_inline]] inline Register square_root(Register x) {
  return _mm256_sqrt_pd(x);
}
[[gnu::always_inline]] inline Register larger(Register a, Register b) {
  return _mm256_max_pd(a, b);
}
[[gnu::always_inline]] inline RegisterSingles square_root(RegisterSingles x) {
  return _mm256_sqrt_ps(x);
}
[[gnu::always_inline]] inline RegisterSingles larger(RegisterSingles a, RegisterSingles b) {
  return _mm256_max_ps(a, b);
}
[[gnu::always_inline]] inline RegisterMask not_zero(RegisterMask x) {
  return x != 0;
}
[[gnu::always_inline]] inline bool any(RegisterMask m) {
  return !_mm256_testz_si256(__m256i(m), __m256i(m));
}
[[gnu::always_inline]] inline unsigned bits_of(RegisterMask m) {
  return unsigned(_mm256_movemask_pd(Register(m)));
}
[[gnu::always_inline]] inline void transpose(Register (&r)[4]) {
  const Register a = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6),
                 b = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
  const Register c = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6),
                 d = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
  r[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5), r[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  r[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7), r[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}
#else
// With bit operations, because "m ? a : b" first compares each lane of the mask with zero, for which SSE2 has no single
// instruction.
[[gnu::always_inline]] inline Register select(RegisterMask m, Register a, Register b) {
  return Register((m & RegisterMask(a)) | (~m & RegisterMask(b)));
}
[[gnu::always_inline]] inline RegisterMask not_zero(RegisterMask x) {
  using Halves = std::int32_t __attribute__((vector_size(sizeof(RegisterMask))));
  const auto set = Halves(x) != 0;
  return RegisterMask(set | __builtin_shufflevector(set, set, 1, 0, 3, 2));
}
[[gnu::always_inline]] inline RegisterSingles select(RegisterSingles m, RegisterSingles a, RegisterSingles b) {
  const auto mask = RegisterMask(m);
  return RegisterSingles((mask & RegisterMask(a)) | (~mask & RegisterMask(b)));
}
[[gnu::always_inline]] inline Register larger(Register a, Register b) {
  return a > b ? a : b;
}
[[gnu::always_inline]] inline RegisterSingles larger(RegisterSingles a, RegisterSingles b) {
  return a > b ? a : b;
}
#if defined(__SSE2__)
[[gnu::always_inline]] inline Register square_root(Register x) {
  return _mm_sqrt_pd(x);
}
[[gnu::always_inline]] inline RegisterSingles square_root(RegisterSingles x) {
  return _mm_sqrt_ps(x);
}
[[gnu::always_inline]] inline unsigned bits_of(RegisterMask m) {
  return unsigned(_mm_movemask_pd(Register(m)));
}
#else
[[gnu::always_inline]] inline Register square_root(Register x) {
  return Register{std::sqrt(x[0]), std::sqrt(x[1])};
}
[[gnu::always_inline]] inline RegisterSingles square_root(RegisterSingles x) {
  return RegisterSingles{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
}
[[gnu::always_inline]] inline unsigned bits_of(RegisterMask m) {
  return unsigned(m[0] & 1) | unsigned(m[1] & 2);
}
#endif
[[gnu::always_inline]] inline bool any(RegisterMask m) {
  return bits_of(m) != 0;
}
[[gnu::always_inline]] inline void transpose(Register (&r)[2]) {
  const Register first = __builtin_shufflevector(r[0], r[1], 0, 2);
  r[1] = __builtin_shufflevector(r[0], r[1], 1, 3), r[0] = first;
}
#endif

// The same operations for both halves.

template <class H, class T>
[[gnu::always_inline]] inline auto less(Both<H, T> a, Both<H, T> b) {
  return Masks{less(a.low, b.low), less(a.high, b.high)};
}
template <class H, class T>
[[gnu::always_inline]] inline auto at_most(Both<H, T> a, Both<H, T> b) {
  return Masks{at_most(a.low, b.low), at_most(a.high, b.high)};
}
template <class M, class H, class T>
requires requires(M m) {
  m.low;
}
[[gnu::always_inline]] inline Both<H, T> select(M m, Both<H, T> a, Both<H, T> b) {
  return {select(m.low, a.low, b.low), select(m.high, a.high, b.high)};
}
template <class H, class T>
[[gnu::always_inline]] inline Both<H, T> within(Both<H, T> mask, Both<H, T> x) {
  return {within(mask.low, x.low), within(mask.high, x.high)};
}
template <class H, class T>
[[gnu::always_inline]] inline Both<H, T> square_root(Both<H, T> x) {
  return {square_root(x.low), square_root(x.high)};
}
template <class H, class T>
[[gnu::always_inline]] inline Both<H, T> larger(Both<H, T> a, Both<H, T> b) {
  return {larger(a.low, b.low), larger(a.high, b.high)};
}
/// −x in lanes where `by` is negative, else x.
template <class H, class T>
[[gnu::always_inline]] inline Both<H, T> flip(Both<H, T> x, Both<H, T> by) {
  return {flip(x.low, by.low), flip(x.high, by.high)};
}
template <class H, class T>
[[gnu::always_inline]] inline Both<H, T> magnitude(Both<H, T> x) {
  return {magnitude(x.low), magnitude(x.high)};
}
template <class H>
[[gnu::always_inline]] inline bool any(Masks<H> m) {
  return any(m.low | m.high);
}
/// One bit for each lane.
template <class H>
[[gnu::always_inline]] inline unsigned bits_of(Masks<H> m) {
  return bits_of(m.low) | bits_of(m.high) << (sizeof(H) / 8);
}

template <class H>
[[gnu::always_inline]] inline Masks<H> first_of(const Masks<H>&, int count) {
  return Masks<H>::first(count);
}

/// Transposes a square by its quarters.
template <class H, class T, int n>
[[gnu::always_inline]] inline void transpose(Both<H, T> (&r)[n]) {
  constexpr int half = n / 2;
  H quarter[4][half];
  for (int i = 0; i < half; ++i) {
    quarter[0][i] = r[i].low, quarter[1][i] = r[i + half].low;
    quarter[2][i] = r[i].high, quarter[3][i] = r[i + half].high;
  }
  for (auto& q : quarter) transpose(q);
  for (int i = 0; i < half; ++i) r[i] = {quarter[0][i], quarter[1][i]}, r[i + half] = {quarter[2][i], quarter[3][i]};
}

}  // namespace parts

#if defined(__AVX2__)
using Lanes = parts::Both<parts::Register, double>;
using Singles = parts::RegisterSingles;  // half the bytes, if seven digits are sufficient
using LaneMask = parts::Masks<parts::RegisterMask>;
#else
using Lanes = parts::Both<parts::Both<parts::Register, double>, double>;
using Singles = parts::Both<parts::RegisterSingles, float>;
using LaneMask = parts::Masks<parts::Masks<parts::RegisterMask>>;
#endif
using Pairs = parts::Both<Singles, float>;  // two of them

[[gnu::always_inline]] inline Lanes splat(double x) {
  return x;
}
[[gnu::always_inline]] inline Singles singles(double x) {
  return float(x) - Singles{};
}
[[gnu::always_inline]] inline Pairs pair(Singles low, Singles high) {
  return {low, high};
}
[[gnu::always_inline]] inline Singles low(Pairs x) {
  return x.low;
}
[[gnu::always_inline]] inline Singles high(Pairs x) {
  return x.high;
}
[[gnu::always_inline]] inline Lanes pair(Quad low, Quad high) {
  return {std::bit_cast<decltype(Lanes::low)>(low), std::bit_cast<decltype(Lanes::high)>(high)};
}
[[gnu::always_inline]] inline Quad low(Lanes x) {
  return std::bit_cast<Quad>(x.low);
}
[[gnu::always_inline]] inline Quad high(Lanes x) {
  return std::bit_cast<Quad>(x.high);
}

namespace parts {

// Conversions between doubles and singles, and between bytes and lanes.

#if defined(__AVX2__)
[[gnu::always_inline]] inline Lanes widen(RegisterSingles x) {
  return {_mm256_cvtps_pd(_mm256_castps256_ps128(x)), _mm256_cvtps_pd(_mm256_extractf128_ps(x, 1))};
}
[[gnu::always_inline]] inline RegisterSingles narrow(Lanes x) {
  return _mm256_set_m128(_mm256_cvtpd_ps(x.high), _mm256_cvtpd_ps(x.low));
}
[[gnu::always_inline]] inline LaneMask spread(std::uint64_t bytes) {
  const __m128i all = _mm_cvtsi64_si128(std::int64_t(bytes));
  return {RegisterMask(_mm256_cvtepi8_epi64(all)), RegisterMask(_mm256_cvtepi8_epi64(_mm_srli_si128(all, 4)))};
}
#else
#if defined(__SSE2__)
[[gnu::always_inline]] inline Both<Register, double> widen(RegisterSingles x) {
  return {_mm_cvtps_pd(x), _mm_cvtps_pd(_mm_movehl_ps(x, x))};
}
[[gnu::always_inline]] inline RegisterSingles narrow(Both<Register, double> x) {
  return _mm_movelh_ps(_mm_cvtpd_ps(x.low), _mm_cvtpd_ps(x.high));
}
[[gnu::always_inline]] inline LaneMask spread(std::uint64_t bytes) {
  const auto lanes = [](__m128i x) {
    return Masks<RegisterMask>{RegisterMask(_mm_unpacklo_epi32(x, x)), RegisterMask(_mm_unpackhi_epi32(x, x))};
  };
  const __m128i all = _mm_cvtsi64_si128(std::int64_t(bytes)), twice = _mm_unpacklo_epi8(all, all);
  return {lanes(_mm_unpacklo_epi16(twice, twice)), lanes(_mm_unpackhi_epi16(twice, twice))};
}
#else
[[gnu::always_inline]] inline Both<Register, double> widen(RegisterSingles x) {
  return {Register{x[0], x[1]}, Register{x[2], x[3]}};
}
[[gnu::always_inline]] inline RegisterSingles narrow(Both<Register, double> x) {
  return RegisterSingles{float(x.low[0]), float(x.low[1]), float(x.high[0]), float(x.high[1])};
}
[[gnu::always_inline]] inline LaneMask spread(std::uint64_t bytes) {
  const auto lane = [bytes](int i) { return std::int64_t(std::int8_t(bytes >> (8 * i))); };
  return {{RegisterMask{lane(0), lane(1)}, RegisterMask{lane(2), lane(3)}},
          {RegisterMask{lane(4), lane(5)}, RegisterMask{lane(6), lane(7)}}};
}
#endif
[[gnu::always_inline]] inline Lanes widen(Singles x) {
  return {widen(x.low), widen(x.high)};
}
[[gnu::always_inline]] inline Singles narrow(Lanes x) {
  return {narrow(x.low), narrow(x.high)};
}
#endif
/// Converts masks of doubles to masks of singles.
[[gnu::always_inline]] inline RegisterSingles of_singles(Masks<RegisterMask> m) {
  using Halves = std::int32_t __attribute__((vector_size(sizeof(RegisterMask))));
#if defined(__AVX2__)
  return RegisterSingles(__builtin_shufflevector(Halves(m.low), Halves(m.high), 0, 2, 4, 6, 8, 10, 12, 14));
#else
  return RegisterSingles(__builtin_shufflevector(Halves(m.low), Halves(m.high), 0, 2, 4, 6));
#endif
}
template <class H>
[[gnu::always_inline]] inline Singles of_singles(Masks<Masks<H>> m) {
  return {of_singles(m.low), of_singles(m.high)};
}

}  // namespace parts

using parts::narrow, parts::widen;

/// Zero in lanes outside the mask.
[[gnu::always_inline]] inline Singles within(LaneMask m, Singles x) {
  return parts::within(parts::of_singles(m), x);
}
/// Writes only the lanes of the mask.
[[gnu::always_inline]] inline void store_lanes(LaneMask m, Lanes x, Lanes& to) {
  to = select(m, x, to);
}
[[gnu::always_inline]] inline void store_lanes(LaneMask m, Singles x, Singles& to) {
  to = parts::select(parts::of_singles(m), x, to);
}
[[gnu::always_inline]] inline bool all(LaneMask m) {
  return !any(~m);
}
[[gnu::always_inline]] inline int count_of(LaneMask m) {
  return __builtin_popcount(bits_of(m));
}
/// Lanes whose byte has any of these bits set.
[[gnu::always_inline]] inline LaneMask bytes_with(LaneBytes bytes, int bits) {
  using Signed = std::int8_t __attribute__((vector_size(lane_count)));
  const auto set = Signed((bytes & std::uint8_t(bits)) != 0);
  std::uint64_t packed;
  std::memcpy(&packed, &set, lane_count);
  return parts::spread(packed);
}
/// One byte for each lane: 1 for `first`, 2 for `second`, or their sum.
[[gnu::always_inline]] inline void store_flags(LaneMask first, LaneMask second, std::uint8_t* bytes) {
#if defined(__BMI2__)
  const std::uint64_t packed =
      _pdep_u64(bits_of(first), 0x0101010101010101) | _pdep_u64(bits_of(second), 0x0202020202020202);
  std::memcpy(bytes, &packed, lane_count);
#else
  for (int lane = 0; lane < lane_count; ++lane)
    bytes[lane] = std::uint8_t((first[lane] ? 1 : 0) + (second[lane] ? 2 : 0));
#endif
}

}  // namespace voussoir
