// Eight doubles side by side: a SIMD lane is a patch (or a body). A register contains eight, four or two of them. The
// source code for a lane is the same in all cases.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace voussoir {

constexpr int lane_count = 8;
using LaneBytes = std::uint8_t __attribute__((vector_size(lane_count)));
/// Four doubles, half the lanes: x, y, z of a node and one more number.
using Quad = double __attribute__((vector_size(32)));
[[gnu::always_inline]] inline Quad load_quad(const double* from) {
  Quad q;
  std::memcpy(&q, from, sizeof(q));
  return q;
}

}  // namespace voussoir

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__) && defined(__AVX512BW__) && defined(__BMI2__)
#include "solver/base/lanes_whole.h"
#else
#include "solver/base/lanes_parts.h"
#endif

namespace voussoir {

[[gnu::always_inline]] inline Pairs load_pair(const Singles* rows) {
  Pairs x;
  std::memcpy(&x, rows, sizeof(x));
  return x;
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

/// The first `count` bytes, zeros in the other lanes.
[[gnu::always_inline]] inline LaneBytes load_bytes(const std::uint8_t* bytes, int count = lane_count) {
  LaneBytes b = {};
  if (count == lane_count)
    std::memcpy(&b, bytes, lane_count);
  else
    std::memcpy(&b, bytes, std::size_t(count));
  return b;
}

/// A vector of three components with the operations that the kernels need; T is double or Lanes.
template <class T>
struct Triple {
  T x, y, z;
  [[gnu::always_inline]] T& operator[](int c) { return c == 0 ? x : c == 1 ? y : z; }
  [[gnu::always_inline]] const T& operator[](int c) const { return c == 0 ? x : c == 1 ? y : z; }
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

/// Unit quaternion w + v, which rotates reference axes to present axes.
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

/// The same rotation as the columns of a matrix, which is faster for two or more vectors.
template <class T>
struct Axes {
  Triple<T> x, y, z;
};
/// The same for a quaternion of any length; `twice` = 2/|q|².
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
