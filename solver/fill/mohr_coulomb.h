// Mohr–Coulomb with tension cut-off and dilation, with the return in principal stresses (de Borst 1987; Clausen,
// Damkilde & Andersen 2006; de Souza Neto, Perić & Owen 2008, ch. 8). Tension is positive, σ1 ≥ σ2 ≥ σ3.
//
//   f = (1 + sin φ) σ1 − (1 − sin φ) σ3 − 2 c cos φ ≤ 0,  plastic potential: f with ψ instead of φ
//   σ1 ≤ ft, associated flow; ft is no more than the apex c cot φ
//
// φ is the friction angle, ψ the dilation angle, c the cohesion and ft the tensile strength (Pa). Elastic stiffness is
// isotropic: σ_i = λ tr ε + 2 μ ε_i.
#pragma once
#include "solver/fill/symmetric.h"
#include "solver/model/fill_law.h"

namespace voussoir {

/// Planes of the yield surface to which a stress was returned.
enum class ReturnRegion { elastic, plane, edge_12, edge_23, cut, cut_12, apex, plane_cut, vertex_23, vertex_12 };
constexpr int return_regions = 10;

/// Whether a stress with deviator s : s = 2 J2 and mean p is certainly elastic: inside the circular cone that is
/// inscribed in the hexagonal one, and below the cut-off. No root is computed.
template <class T>
[[gnu::always_inline]] inline auto surely_elastic(const FillLaw& law, T two_j2, T p) {
  const T zero = all_lanes<T>(0.0);
  const T room = 0.5 * law.strength - 0.5 * (law.major - law.minor) * p, below = law.tension - p;
  return at_most(zero, room) & at_most(0.5 * law.cone * two_j2, room * room) & at_most(zero, below) &
         at_most((2.0 / 3.0) * two_j2, below * below);
}

/// Whether a stress with these greatest and least principal values can be beyond the cone or the cut-off. The values
/// are known to the square root of the rounding error, relative to their difference.
template <class T>
[[gnu::always_inline]] inline auto near_surface(const FillLaw& law, T high, T low) {
  constexpr double root = std::is_same_v<T, Floats> ? 1e-3 : 2e-7;
  const T margin = root * (high - low);
  return less(law.strength - margin, law.major * high - law.minor * low) | less(law.tension - margin, high);
}

/// Returns a trial stress (sorted, Pa) to the admissible stress; `region`, if not null, receives the planes. Rare cases
/// are computed only if a lane needs them.
template <class T>
inline void return_to_surface(const FillLaw& law, const T (&trial)[3], T (&stress)[3], T* region = nullptr) {
  const double a = law.major, b = law.minor, ag = law.flow_major, bg = law.flow_minor;
  const double P = law.stiff(), L = law.lame(), ft = law.tension, k = law.strength;
  // D r of the flow of the plane along the greatest, the middle and the least stress.
  const double up = P * ag - L * bg, mid = L * (ag - bg), down = L * ag - P * bg;
  const double h = a * up - b * down, g12 = a * mid - b * down, g23 = a * up - b * mid;
  const T zero = all_lanes<T>(0.0), cut = all_lanes<T>(ft);
  const T t1 = trial[0], t2 = trial[1], t3 = trial[2];
  constexpr double share = std::is_same_v<T, Floats> ? 2e-6 : 1e-10;
  const T slack = share * (magnitude(t1) + magnitude(t3) + k);
  const T f13 = a * t1 - b * t3 - k;
  const auto sorted = [&](T u, T v, T w) { return at_most(v, u + slack) & at_most(w, v + slack); };
  const auto inside = [&](T u, T w) { return at_most(a * u - b * w, k + slack) & at_most(u, ft + slack); };
  T x[3] = {t1, t2, t3}, found = all_lanes<T>(double(ReturnRegion::elastic));
  auto left = without(at_most(zero, zero), at_most(f13, zero) & at_most(t1, cut));
  /// Marks the remaining lanes for which the condition holds as done; returns whether any lane remains.
  const auto take = [&](auto holds, T u, T v, T w, ReturnRegion which) {
    const auto here = left & holds;
    x[0] = select(here, u, x[0]), x[1] = select(here, v, x[1]), x[2] = select(here, w, x[2]);
    found = select(here, all_lanes<T>(double(which)), found);
    left = without(left, holds);
    return any(left);
  };
  const auto cone = [&] {
    const T one = (1.0 / h) * f13;
    const T u = t1 - up * one, v = t2 - mid * one, w = t3 - down * one;
    return take(at_most(zero, one) & sorted(u, v, w) & inside(u, w), u, v, w, ReturnRegion::plane);
  };
  const auto middle_and_least = [&] {  // equal at the edge of the cone
    const double by = 1.0 / (h * h - g23 * g23);
    const T f12 = a * t1 - b * t2 - k;
    const T one = by * (h * f13 - g23 * f12), two = by * (h * f12 - g23 * f13);
    const T u = t1 - up * (one + two), w = t3 - down * one - mid * two;
    return take(at_most(zero, one) & at_most(zero, two) & sorted(u, w, w) & inside(u, w), u, w, w,
                ReturnRegion::edge_23);
  };
  const auto greatest_and_middle = [&] {
    const double by = 1.0 / (h * h - g12 * g12);
    const T f23 = a * t2 - b * t3 - k;
    const T one = by * (h * f13 - g12 * f23), two = by * (h * f23 - g12 * f13);
    const T u = t1 - up * one - mid * two, w = t3 - down * (one + two);
    return take(at_most(zero, one) & at_most(zero, two) & sorted(u, u, w) & inside(u, w), u, u, w,
                ReturnRegion::edge_12);
  };
  const auto cut_off = [&] {  // along one axis, two, all three
    const T one = (1.0 / P) * (t1 - ft), v = t2 - L * one, w = t3 - L * one;
    take(at_most(zero, one) & sorted(cut, v, w) & inside(cut, w), cut, v, w, ReturnRegion::cut);
    const T both = (1.0 / (P + L)) * (t1 + t2 - 2.0 * ft), apart = (1.0 / (P - L)) * (t1 - t2);
    const T w2 = t3 - L * both;
    take(at_most(apart, both) & at_most(w2, ft + slack) & inside(cut, w2), cut, cut, w2, ReturnRegion::cut_12);
    const T e = (1.0 / (3.0 * law.bulk)) * (t1 + t2 + t3 - 3.0 * ft);  // tr ε past the apex
    const T least = (1.0 / (2.0 * law.shear)) * (t3 - ft - L * e);
    return take(at_most(zero, least), cut, cut, cut, ReturnRegion::apex);
  };
  const auto cone_and_cut_off = [&] {
    const double n_cut = a * P - b * L, by = 1.0 / (h * P - n_cut * up);
    const T one = by * (P * f13 - n_cut * (t1 - ft)), two = by * (h * (t1 - ft) - up * f13);
    const T u = t1 - up * one - P * two, v = t2 - mid * one - L * two, w = t3 - down * one - L * two;
    take(at_most(zero, one) & at_most(zero, two) & sorted(u, v, w), u, v, w, ReturnRegion::plane_cut);
    // The remaining case: the corner between the surfaces, on either side.
    const T corner = all_lanes<T>((a * ft - k) / b);
    take(less(u + slack, v), cut, cut, corner, ReturnRegion::vertex_12);
    take(left, cut, corner, corner, ReturnRegion::vertex_23);
  };
  if (any(left) && cone() && middle_and_least() && greatest_and_middle() && cut_off()) cone_and_cut_off();
  for (int i = 0; i < 3; ++i) stress[i] = x[i];
  if (region) *region = found;
}

}  // namespace voussoir
