// Symmetric 3 × 3 tensors and their principal axes, for one element (T double) or eight side by side (T Lanes).
#pragma once
#include "solver/base/floats.h"

namespace voussoir {

// Operations of lanes for a single number.
inline bool less(double a, double b) {
  return a < b;
}
inline bool at_most(double a, double b) {
  return a <= b;
}
inline bool any(bool m) {
  return m;
}
inline bool without(bool a, bool b) {
  return a && !b;
}
inline double select(bool m, double a, double b) {
  return m ? a : b;
}
inline double square_root(double x) {
  return std::sqrt(x);
}
inline double larger(double a, double b) {
  return a > b ? a : b;
}
template <class T>
[[gnu::always_inline]] inline T all_lanes(double x) {
  if constexpr (std::is_same_v<T, Lanes>)
    return splat(x);
  else
    return T(x);
}
template <class T>
[[gnu::always_inline]] inline T magnitude(T x) {
  return larger(x, -x);
}

template <class T>
struct Symmetric {
  T xx, yy, zz, xy, xz, yz;
};
template <class T>
[[gnu::always_inline]] inline Symmetric<T> operator+(const Symmetric<T>& a, const Symmetric<T>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}
template <class T>
[[gnu::always_inline]] inline Symmetric<T> operator-(const Symmetric<T>& a, const Symmetric<T>& b) {
  return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.xz - b.xz, a.yz - b.yz};
}
template <class T>
[[gnu::always_inline]] inline Symmetric<T> operator*(T s, const Symmetric<T>& a) {
  return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.xz, s * a.yz};
}
template <class T>
[[gnu::always_inline]] inline T trace(const Symmetric<T>& a) {
  return a.xx + a.yy + a.zz;
}
/// a : b.
template <class T>
[[gnu::always_inline]] inline T inner(const Symmetric<T>& a, const Symmetric<T>& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.xz * b.xz + a.yz * b.yz);
}
template <class T>
[[gnu::always_inline]] inline Symmetric<T> deviator(const Symmetric<T>& a) {
  const T mean = trace(a) * (1.0 / 3.0);
  return {a.xx - mean, a.yy - mean, a.zz - mean, a.xy, a.xz, a.yz};
}
/// a b for two tensors with common principal axes, so that the product is also symmetric.
template <class T>
[[gnu::always_inline]] inline Symmetric<T> coaxial_product(const Symmetric<T>& a, const Symmetric<T>& b) {
  return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.xy * b.xy + a.yy * b.yy + a.yz * b.yz,
          a.xz * b.xz + a.yz * b.yz + a.zz * b.zz, a.xx * b.xy + a.xy * b.yy + a.xz * b.yz,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.xy * b.xz + a.yy * b.yz + a.yz * b.zz};
}

/// A general 3 × 3 tensor, row by row.
template <class T>
struct Tensor {
  T m[3][3];
};
/// A S Aᵀ.
template <class T>
[[gnu::always_inline]] inline Symmetric<T> push(const Tensor<T>& a, const Symmetric<T>& s) {
  T h[3][3];
  for (int i = 0; i < 3; ++i) {
    h[i][0] = a.m[i][0] * s.xx + a.m[i][1] * s.xy + a.m[i][2] * s.xz;
    h[i][1] = a.m[i][0] * s.xy + a.m[i][1] * s.yy + a.m[i][2] * s.yz;
    h[i][2] = a.m[i][0] * s.xz + a.m[i][1] * s.yz + a.m[i][2] * s.zz;
  }
  const auto row = [&](int i, int j) { return h[i][0] * a.m[j][0] + h[i][1] * a.m[j][1] + h[i][2] * a.m[j][2]; };
  return {row(0, 0), row(1, 1), row(2, 2), row(0, 1), row(0, 2), row(1, 2)};
}
template <class T>
[[gnu::always_inline]] inline Tensor<T> transposed(const Tensor<T>& a) {
  return {{{a.m[0][0], a.m[1][0], a.m[2][0]}, {a.m[0][1], a.m[1][1], a.m[2][1]}, {a.m[0][2], a.m[1][2], a.m[2][2]}}};
}

/// Principal values, the greatest first, and their axes: columns of `axes`.
template <class T>
struct Principal {
  T value[3];
  Tensor<T> axes;
};

namespace detail {

/// One Jacobi rotation in the plane of axes p and q (Golub & Van Loan 2013, 8.5.2).
template <class T>
[[gnu::always_inline]] inline void rotate(T (&a)[3][3], Tensor<T>& v, int p, int q, int r) {
  const T off = a[p][q], apart = a[q][q] - a[p][p];
  const T zero = all_lanes<T>(0.0);
  const T root = square_root(apart * apart + 4.0 * off * off);
  const T below = apart + select(less(apart, zero), -root, root);
  const T t = 2.0 * off / select(less(zero, magnitude(below)), below, all_lanes<T>(1.0));
  const T c = 1.0 / square_root(1.0 + t * t), s = t * c;
  a[p][p] -= t * off, a[q][q] += t * off;
  a[p][q] = a[q][p] = zero;
  const T rp = a[r][p], rq = a[r][q];
  a[r][p] = a[p][r] = c * rp - s * rq;
  a[r][q] = a[q][r] = s * rp + c * rq;
  for (int i = 0; i < 3; ++i) {
    const T vp = v.m[i][p], vq = v.m[i][q];
    v.m[i][p] = c * vp - s * vq, v.m[i][q] = s * vp + c * vq;
  }
}

template <class T>
[[gnu::always_inline]] inline void order(Principal<T>& x, int first, int second) {
  const auto swap = less(x.value[first], x.value[second]);
  const auto exchange = [&](T& a, T& b) {
    const T was = a;
    a = select(swap, b, a), b = select(swap, was, b);
  };
  exchange(x.value[first], x.value[second]);
  for (int i = 0; i < 3; ++i) exchange(x.axes.m[i][first], x.axes.m[i][second]);
}

}  // namespace detail

/// Cyclic Jacobi rotations; five sweeps reduce the off-diagonal entries below rounding.
template <class T>
inline Principal<T> principal(const Symmetric<T>& s) {
  const T zero = all_lanes<T>(0.0), one = all_lanes<T>(1.0);
  T a[3][3] = {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}};
  Principal<T> x;
  x.axes = {{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}};
  for (int sweep = 0; sweep < 5; ++sweep) {
    detail::rotate(a, x.axes, 0, 1, 2);
    detail::rotate(a, x.axes, 0, 2, 1);
    detail::rotate(a, x.axes, 1, 2, 0);
  }
  for (int i = 0; i < 3; ++i) x.value[i] = a[i][i];
  detail::order(x, 0, 1);
  detail::order(x, 1, 2);
  detail::order(x, 0, 1);
  return x;
}

/// The tensor with these principal values and axes.
template <class T>
[[gnu::always_inline]] inline Symmetric<T> from_principal(const T (&value)[3], const Tensor<T>& axes) {
  const T zero = all_lanes<T>(0.0);
  return push(axes, Symmetric<T>{value[0], value[1], value[2], zero, zero, zero});
}

}  // namespace voussoir
