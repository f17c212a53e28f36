// Principal axes of symmetric 3 × 3 tensors in closed form, for thousands of yielding elements. principal() in
// symmetric.h computes the same by rotations and without special cases. It is the reference in tests.
#pragma once
#include "solver/fill/symmetric.h"

namespace voussoir {

namespace detail {

/// Lower limit of the size of a deviator, for deviators that consist of rounding errors. The cube of the limit and its
/// inverse are finite.
template <class T>
constexpr double least_size = std::is_same_v<T, Floats> ? 1e-12 : 1e-100;

template <class T>
[[gnu::always_inline]] inline Triple<T> times(const Symmetric<T>& a, const Triple<T>& v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
          a.xz * v.x + a.yz * v.y + a.zz * v.z};
}

/// 2 cos(⅓ arccos r) for r from 0 to 1, the greatest root of x³ − 3 x = 2 r. It is a simple root, so that x(r) is
/// smooth. Its Chebyshev series of degree 8 has an error of 3.2e-9, and one Newton iteration reduces it to rounding.
template <class T>
[[gnu::always_inline]] inline T greatest_root(T r) {
  constexpr double series[9] = {1.87938524119,     0.131643590843,     -0.0128628088564,
                                0.00221362188183,  -0.000467441341792, 0.000108729480224,
                                -2.71702355317e-5, 8.65124696062e-6,   -2.41656397918e-6};
  const T t = 2.0 * r - 1.0;
  T x = all_lanes<T>(series[8]);
  for (int i = 7; i >= 0; --i) x = x * t + series[i];
  return x - ((x * x - 3.0) * x - 2.0 * r) / (3.0 * x * x - 3.0);
}

template <class T>
[[gnu::always_inline]] inline Triple<T> choose(decltype(less(T{}, T{})) m, const Triple<T>& a, const Triple<T>& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}

/// The eigenvector of the greatest or the least eigenvalue, which must differ from the two others. All columns of the
/// adjugate of `a` minus this value are parallel to it; the longest column has the greatest diagonal entry.
template <class T>
[[gnu::always_inline]] inline Triple<T> axis_of(const Symmetric<T>& a, T value) {
  const T xx = a.xx - value, yy = a.yy - value, zz = a.zz - value;
  const T cx = yy * zz - a.yz * a.yz, cy = xx * zz - a.xz * a.xz, cz = xx * yy - a.xy * a.xy;
  const T xy = a.xz * a.yz - a.xy * zz, xz = a.xy * a.yz - a.xz * yy, yz = a.xy * a.xz - a.yz * xx;
  const Triple<T> rows[3] = {{cx, xy, xz}, {xy, cy, yz}, {xz, yz, cz}};
  Triple<T> n = choose(less(cx, cy), rows[1], rows[0]);
  n = choose(less(larger(cx, cy), cz), rows[2], n);
  return (1.0 / square_root(dot(n, n))) * n;
}

}  // namespace detail

/// The principal value of the deviator that differs from both others by at least its own size. `value` is that of the
/// deviator times `scale`, whose principal values are the roots of x³ − 3 x = 2 r with r ≥ 0 (Smith 1961). `scale` is
/// negative if r would otherwise be negative (`over`).
template <class T>
struct ApartValue {
  T value, scale, size;  // size = 1/|scale|
  decltype(less(T{}, T{})) over;
};
template <class T>
[[gnu::always_inline]] inline ApartValue<T> apart_value(const Symmetric<T>& s) {
  const T mean = (1.0 / 3.0) * trace(s);
  const Symmetric<T> d = {s.xx - mean, s.yy - mean, s.zz - mean, s.xy, s.xz, s.yz};
  ApartValue<T> a;
  a.size = larger(square_root((1.0 / 6.0) * inner(d, d)), all_lanes<T>(detail::least_size<T>));
  a.scale = 1.0 / a.size;
  const T r =
      0.5 * a.scale * a.scale * a.scale *
      (d.xx * (d.yy * d.zz - d.yz * d.yz) - d.xy * (d.xy * d.zz - d.yz * d.xz) + d.xz * (d.xy * d.yz - d.yy * d.xz));
  a.over = less(r, all_lanes<T>(0.0));
  a.scale = select(a.over, -a.scale, a.scale);
  const T most = -larger(-magnitude(r), all_lanes<T>(-1.0));
  a.value = detail::greatest_root(most);
  return a;
}

/// Greatest and least principal value of the deviator, without axes. They are accurate to rounding, or to its square
/// root if two values are nearly equal.
template <class T>
struct Extremes {
  T high, low;
};
template <class T>
[[gnu::always_inline]] inline Extremes<T> extremes(const ApartValue<T>& a) {
  // The two other roots are −x/2 ± √(3 − ¾ x²).
  const T across = 0.5 * a.value + square_root(larger(3.0 - 0.75 * a.value * a.value, all_lanes<T>(0.0)));
  return {a.size * select(a.over, across, a.value), -(a.size * select(a.over, a.value, across))};
}

/// One principal value of the deviator differs from both others by at least its own size. It is computed from the cubic
/// in closed form (Smith 1961), and its axis from the adjugate (Scherzinger & Dohrmann 2008). The remainder is a tensor
/// in the normal plane. It gets axes as in Duff et al. (2017), which one Jacobi rotation turns into principal axes
/// (Golub & Van Loan 2013, 8.5.2). All results, and their order, are accurate to rounding of the norm of the deviator.
template <class T>
inline Principal<T> principal_axes(const Symmetric<T>& s, const ApartValue<T>& single) {
  const T zero = all_lanes<T>(0.0), one = all_lanes<T>(1.0);
  const T mean = (1.0 / 3.0) * trace(s);
  const Symmetric<T> d = {s.xx - mean, s.yy - mean, s.zz - mean, s.xy, s.xz, s.yz};
  const auto over = single.over;
  const Triple<T> n = detail::axis_of(single.scale * d, single.value);
  // Two axes normal to it.
  const T sign = select(less(n.z, zero), -one, one), turn = -1.0 / (sign + n.z), both = n.x * n.y * turn;
  const Triple<T> u = {one + sign * n.x * n.x * turn, sign * both, -sign * n.x};
  const Triple<T> w = {both, sign + n.y * n.y * turn, -n.y};
  const Triple<T> du = detail::times(d, u), dw = detail::times(d, w);
  const T uu = dot(u, du), uw = 2.0 * dot(u, dw), ww = dot(w, dw);
  const T apart = ww - uu, root = square_root(apart * apart + uw * uw);
  const T wide = larger(magnitude(apart) + root, all_lanes<T>(detail::least_size<T>));
  const T norm = 1.0 / square_root(wide * wide + uw * uw);
  const auto rises = less(zero, apart);
  const T a = norm * select(rises, uw, wide), b = norm * select(rises, wide, uw);
  const Triple<T> upper = a * u + b * w, lower = b * u - a * w;
  const T middle = mean + 0.5 * (uu + ww), high = middle + 0.5 * root, low = middle - 0.5 * root;
  const T alone = mean - (uu + ww);
  Principal<T> x;
  const Triple<T> first = detail::choose(over, upper, n), second = detail::choose(over, lower, upper),
                  third = detail::choose(over, n, lower);
  x.value[0] = select(over, high, alone), x.value[1] = select(over, low, high), x.value[2] = select(over, alone, low);
  x.axes = {{{first.x, second.x, third.x}, {first.y, second.y, third.y}, {first.z, second.z, third.z}}};
  return x;
}
template <class T>
inline Principal<T> principal_axes(const Symmetric<T>& s) {
  return principal_axes(s, apart_value(s));
}

}  // namespace voussoir
