// Mohr–Coulomb with tension cut-off and dilation, returned to in principal stresses (de Borst 1987; Clausen, Damkilde &
// Andersen 2006; de Souza Neto, Perić & Owen 2008, ch. 8). Tension is positive, σ1 ≥ σ2 ≥ σ3.
//
//   f = (1 + sin φ) σ1 − (1 − sin φ) σ3 − 2 c cos φ ≤ 0,  flow along the same with ψ for φ
//   σ1 ≤ ft, associated; ft is no more than the apex c cot φ
//
// Elastic stiffness is isotropic: σ_i = λ tr ε + 2 μ ε_i.
#pragma once
#include <algorithm>

#include "geometry/assembly.h"
#include "solver/fill/symmetric.h"

namespace voussoir {

/// Constants of one fill material; SI.
struct FillLaw {
  double density = 0.0;                       // kg/m3
  double bulk = 0.0, shear = 0.0;             // κ, μ, Pa
  double tension = 0.0;                       // ft, Pa
  double major = 1.0, minor = 1.0;            // 1 + sin φ, 1 − sin φ
  double flow_major = 1.0, flow_minor = 1.0;  // the same of ψ
  double strength = 0.0;                      // 2 c cos φ, Pa
  double cone = 1.0;                          // 1 + sin² φ / 3: of the circular cone inside the hexagonal one
  double stiff() const { return bulk + 4.0 / 3.0 * shear; }  // λ + 2 μ
  double lame() const { return bulk - 2.0 / 3.0 * shear; }   // λ
};
/// Throws InputError for moduli that are not positive, or give a Poisson's ratio below 0, and for a dilation above the
/// friction.
FillLaw fill_law(const Material& material);

/// Where on the yield surface a stress was returned to: which planes hold it there.
enum class ReturnRegion { elastic, plane, edge_12, edge_23, cut, cut_12, apex, plane_cut, vertex_23, vertex_12 };
constexpr int return_regions = 10;

/// Whether a stress of deviator with s : s = 2 J2 and mean p surely is elastic: inside the circular cone that touches
/// the hexagonal one from within, and below the cut-off. No root is taken.
template <class T>
[[gnu::always_inline]] inline auto surely_elastic(const FillLaw& law, T two_j2, T p) {
  const T zero = all_lanes<T>(0.0);
  const T room = 0.5 * law.strength - 0.5 * (law.major - law.minor) * p, below = law.tension - p;
  return at_most(zero, room) & at_most(0.5 * law.cone * two_j2, room * room) & at_most(zero, below) &
         at_most((2.0 / 3.0) * two_j2, below * below);
}

/// The admissible stress that a trial stress (sorted, Pa) returns to; `region`, where wanted, says which planes.
template <class T>
inline void return_to_surface(const FillLaw& law, const T (&trial)[3], T (&stress)[3], T* region = nullptr) {
  const double a = law.major, b = law.minor, ag = law.flow_major, bg = law.flow_minor;
  const double P = law.stiff(), L = law.lame(), ft = law.tension, k = law.strength;
  // D r of the plane's flow along the greatest, a middle and the least stress.
  const double up = P * ag - L * bg, mid = L * (ag - bg), down = L * ag - P * bg;
  const double h = a * up - b * down, g12 = a * mid - b * down, g23 = a * up - b * mid;
  const T zero = all_lanes<T>(0.0);
  const T t1 = trial[0], t2 = trial[1], t3 = trial[2];
  const T slack = 1e-10 * (magnitude(t1) + magnitude(t3) + k);
  const T f13 = a * t1 - b * t3 - k, f23 = a * t2 - b * t3 - k, f12 = a * t1 - b * t2 - k;
  // What is found last where nothing before it holds: the corner where cut-off and cone meet, on either side.
  const T corner = all_lanes<T>((a * ft - k) / b), cut = all_lanes<T>(ft);
  T x[3] = {cut, corner, corner};
  T found = all_lanes<T>(double(ReturnRegion::vertex_23));
  const auto take = [&](auto holds, T u, T v, T w, ReturnRegion which) {
    x[0] = select(holds, u, x[0]), x[1] = select(holds, v, x[1]), x[2] = select(holds, w, x[2]);
    found = select(holds, all_lanes<T>(double(which)), found);
  };
  const auto sorted = [&](T u, T v, T w) { return at_most(v, u + slack) & at_most(w, v + slack); };
  const auto inside = [&](T u, T w) { return at_most(a * u - b * w, k + slack) & at_most(u, ft + slack); };

  {  // cone and cut-off
    const double n_cut = a * P - b * L, det = h * P - n_cut * up;
    const T one = (P * f13 - n_cut * (t1 - ft)) / det, two = (h * (t1 - ft) - up * f13) / det;
    const T u = t1 - up * one - P * two, v = t2 - mid * one - L * two, w = t3 - down * one - L * two;
    take(less(u + slack, v), cut, cut, corner, ReturnRegion::vertex_12);
    take(at_most(zero, one) & at_most(zero, two) & sorted(u, v, w), u, v, w, ReturnRegion::plane_cut);
  }
  {                                                            // the cut-off along all three, two, one
    const T e = (t1 + t2 + t3 - 3.0 * ft) / (3.0 * law.bulk);  // tr ε past the apex
    const T least = (t3 - ft - L * e) / (2.0 * law.shear);
    take(at_most(zero, least), cut, cut, cut, ReturnRegion::apex);
    const T both = (t1 + t2 - 2.0 * ft) / (P + L), apart = (t1 - t2) / (P - L);
    const T w2 = t3 - L * both;
    take(at_most(apart, both) & at_most(w2, ft + slack) & inside(cut, w2), cut, cut, w2, ReturnRegion::cut_12);
    const T one = (t1 - ft) / P, v = t2 - L * one, w = t3 - L * one;
    take(at_most(zero, one) & sorted(cut, v, w) & inside(cut, w), cut, v, w, ReturnRegion::cut);
  }
  {  // the cone's edges: greatest and middle equal, middle and least equal
    const double det = h * h - g12 * g12;
    const T one = (h * f13 - g12 * f23) / det, two = (h * f23 - g12 * f13) / det;
    const T u = t1 - up * one - mid * two, w = t3 - down * (one + two);
    take(at_most(zero, one) & at_most(zero, two) & sorted(u, u, w) & inside(u, w), u, u, w, ReturnRegion::edge_12);
  }
  {
    const double det = h * h - g23 * g23;
    const T one = (h * f13 - g23 * f12) / det, two = (h * f12 - g23 * f13) / det;
    const T u = t1 - up * (one + two), w = t3 - down * one - mid * two;
    take(at_most(zero, one) & at_most(zero, two) & sorted(u, w, w) & inside(u, w), u, w, w, ReturnRegion::edge_23);
  }
  {  // the cone's plane
    const T one = f13 / h;
    const T u = t1 - up * one, v = t2 - mid * one, w = t3 - down * one;
    take(at_most(zero, one) & sorted(u, v, w) & inside(u, w), u, v, w, ReturnRegion::plane);
  }
  take(at_most(f13, zero) & at_most(t1, cut), t1, t2, t3, ReturnRegion::elastic);
  for (int i = 0; i < 3; ++i) stress[i] = x[i];
  if (region) *region = found;
}

/// ∂σ_i/∂ε_j of the returned principal stresses with respect to the trial strains, in a region: D − D R (Nᵀ D R)⁻¹ Nᵀ
/// D.
Mat3 return_tangent(const FillLaw& law, ReturnRegion region);

}  // namespace voussoir
