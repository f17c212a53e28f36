// Eight doubles side by side: a SIMD lane is a patch. The compiler splits them where registers are narrower, so the
// bits do not depend on how many lanes a register has.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

namespace voussoir {

constexpr int lane_count = 8;
using Lanes = double __attribute__((vector_size(8 * lane_count)));
using LaneMask = long __attribute__((vector_size(8 * lane_count)));  // all bits set where true

using Singles = float __attribute__((vector_size(4 * lane_count)));  // half the bytes, where seven digits do

inline Lanes widen(const Singles& x) {
  return __builtin_convertvector(x, Lanes);
}
inline Singles narrow(const Lanes& x) {
  return __builtin_convertvector(x, Singles);
}

inline Lanes splat(double x) {
  return Lanes{} + x;
}

inline Lanes square_root(Lanes x) {
  Lanes r;
  for (int i = 0; i < lane_count; ++i) r[i] = std::sqrt(x[i]);
  return r;
}

inline bool any(LaneMask m) {
  long bits = 0;
  for (int i = 0; i < lane_count; ++i) bits |= m[i];
  return bits != 0;
}

using LaneBytes = std::uint8_t __attribute__((vector_size(lane_count)));

/// One byte a lane.
inline LaneMask load_bytes(const std::uint8_t* bytes) {
  LaneBytes b;
  std::memcpy(&b, bytes, lane_count);
  return __builtin_convertvector(b, LaneMask);
}
inline void store_bytes(LaneMask m, std::uint8_t* bytes) {
  const LaneBytes b = __builtin_convertvector(m, LaneBytes);
  std::memcpy(bytes, &b, lane_count);
}

/// Rows become columns: eight records of eight numbers to the same number of all eight side by side, and back.
inline void transpose(Lanes (&r)[lane_count]) {
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
inline Triple<T> operator+(const Triple<T>& a, const Triple<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
inline Triple<T> operator-(const Triple<T>& a, const Triple<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
inline Triple<T> operator*(T s, const Triple<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
inline Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
inline T dot(const Triple<T>& a, const Triple<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Unit quaternion w + v, rotating reference into present axes.
template <class T>
struct Quat {
  T w;
  Triple<T> v;
};
template <class T>
inline Quat<T> operator*(const Quat<T>& a, const Quat<T>& b) {
  const Triple<T> c = cross(a.v, b.v);
  return {a.w * b.w - dot(a.v, b.v),
          {a.w * b.v.x + b.w * a.v.x + c.x, a.w * b.v.y + b.w * a.v.y + c.y, a.w * b.v.z + b.w * a.v.z + c.z}};
}
/// R x − x without cancellation: 2 w (v × x) + 2 v × (v × x).
template <class T>
inline Triple<T> turn_change(const Quat<T>& q, const Triple<T>& x) {
  const Triple<T> c = cross(q.v, x);
  const Triple<T> d = cross(q.v, c);
  const T w = q.w;
  return {2.0 * (w * c.x + d.x), 2.0 * (w * c.y + d.y), 2.0 * (w * c.z + d.z)};
}
template <class T>
inline Triple<T> turn(const Quat<T>& q, const Triple<T>& x) {
  return x + turn_change(q, x);
}
template <class T>
inline Triple<T> turn_back(const Quat<T>& q, const Triple<T>& x) {
  return turn(Quat<T>{q.w, {-q.v.x, -q.v.y, -q.v.z}}, x);
}

}  // namespace voussoir
