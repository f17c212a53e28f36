// Eight numbers in single precision side by side, with the arithmetic of Lanes: for kernels that support both
// precisions. Comparisons give the masks of Lanes.
#pragma once
#include <type_traits>

#include "solver/base/lanes.h"

namespace voussoir {

struct Floats {
  Singles v;

  Floats() = default;
  [[gnu::always_inline]] Floats(Singles x) : v(x) {}
  [[gnu::always_inline]] Floats(double x) : v(singles(x)) {}
  [[gnu::always_inline]] float operator[](int lane) const { return v[lane]; }

  [[gnu::always_inline]] friend Floats operator+(Floats a, Floats b) { return Floats(a.v + b.v); }
  [[gnu::always_inline]] friend Floats operator-(Floats a, Floats b) { return Floats(a.v - b.v); }
  [[gnu::always_inline]] friend Floats operator*(Floats a, Floats b) { return Floats(a.v * b.v); }
  [[gnu::always_inline]] friend Floats operator/(Floats a, Floats b) { return Floats(a.v / b.v); }
  [[gnu::always_inline]] friend Floats operator-(Floats a) { return Floats(-a.v); }
  [[gnu::always_inline]] Floats& operator+=(Floats b) { return *this = *this + b; }
  [[gnu::always_inline]] Floats& operator-=(Floats b) { return *this = *this - b; }
};

#if defined(VOUSSOIR_LANES_IN_PARTS)
[[gnu::always_inline]] inline LaneMask less(Floats a, Floats b) {
  return less(widen(a.v), widen(b.v));
}
[[gnu::always_inline]] inline LaneMask at_most(Floats a, Floats b) {
  return at_most(widen(a.v), widen(b.v));
}
[[gnu::always_inline]] inline Floats select(LaneMask m, Floats a, Floats b) {
  return Floats(parts::select(parts::of_singles(m), a.v, b.v));
}
[[gnu::always_inline]] inline Floats square_root(Floats x) {
  return Floats(parts::square_root(x.v));
}
[[gnu::always_inline]] inline Floats larger(Floats a, Floats b) {
  return Floats(parts::larger(a.v, b.v));
}
#else
[[gnu::always_inline]] inline LaneMask less(Floats a, Floats b) {
  return {_mm256_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)};
}
[[gnu::always_inline]] inline LaneMask at_most(Floats a, Floats b) {
  return {_mm256_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)};
}
[[gnu::always_inline]] inline Floats select(LaneMask m, Floats a, Floats b) {
  return Floats(_mm256_mask_blend_ps(m.bits, b.v, a.v));
}
[[gnu::always_inline]] inline Floats square_root(Floats x) {
  return Floats(_mm256_sqrt_ps(x.v));
}
[[gnu::always_inline]] inline Floats larger(Floats a, Floats b) {
  return Floats(_mm256_max_ps(a.v, b.v));
}
#endif

/// The same numbers in either precision.
[[gnu::always_inline]] inline Lanes doubles_of(const Lanes& x) {
  return x;
}
[[gnu::always_inline]] inline Lanes doubles_of(const Floats& x) {
  return widen(x.v);
}
[[gnu::always_inline]] inline Singles singles_of(const Lanes& x) {
  return narrow(x);
}
[[gnu::always_inline]] inline Singles singles_of(const Floats& x) {
  return x.v;
}
template <class L>
[[gnu::always_inline]] inline L numbers_of(const Lanes& x) {
  if constexpr (std::is_same_v<L, Lanes>)
    return x;
  else
    return Floats(narrow(x));
}
template <class L>
[[gnu::always_inline]] inline L numbers_of(const Singles& x) {
  if constexpr (std::is_same_v<L, Lanes>)
    return widen(x);
  else
    return Floats(x);
}

}  // namespace voussoir
