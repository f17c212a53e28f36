// The wrench of a patch on its bodies, from its tractions.
#pragma once
#include "solver/contact/jump.h"

namespace voussoir {

/// Integrals of the tractions over a patch in local axes: resultant (N) and first moments (N m).
template <class T>
struct Resultant {
  T n, s, t;         // ∫ σ, τs, τt
  T sn, tn, st, ts;  // ∫ s σ, t σ, s τt, t τs
  T ss, tt;          // ∫ s τs, t τt
};

/// Force (N) on body a and moment (N m) about the world's origin, world axes, with the exact arms H Q r (jump.h).
template <class T>
struct WorldWrench {
  Triple<T> force, moment;

  [[gnu::always_inline]] WorldWrench(const Resultant<T>& q, const Jump<T>& j)
      : WorldWrench(q, j, {j.rs * q.sn + j.rt * q.tn, j.rs * q.ss + j.rt * q.ts, j.rs * q.st + j.rt * q.tt}) {}

  /// The same for tractions whose moments ss and tt are zero.
  [[gnu::always_inline]] static WorldWrench of_springs(const Resultant<T>& q, const Jump<T>& j) {
    return {q, j, {j.rs * q.sn + j.rt * q.tn, j.rt * q.ts, j.rs * q.st}};
  }

 private:
  [[gnu::always_inline]] WorldWrench(const Resultant<T>& q, const Jump<T>& j, const Triple<T>& g) {
    const Triple<T> m0 = {q.st - q.ts, q.tn, -q.sn};
    const Triple<T> local = j.cosine * m0 + j.share * cross(Triple<T>{j.rn, j.rs, j.rt}, g);
    force = turn(j.axes, Triple<T>{q.n, q.s, q.t});
    moment = turn(j.axes, local) + cross(j.place, force);
  }
};

}  // namespace voussoir
