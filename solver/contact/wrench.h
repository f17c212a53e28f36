// From tractions to the wrench a patch puts on its bodies.
#pragma once
#include "solver/contact/jump.h"

namespace voussoir {

/// Sums of traction over a patch in local axes: resultant, and the moments of second order that turn with the bodies.
template <class T>
struct Resultant {
  T n, s, t;         // ∫ σ, τs, τt
  T sn, tn, st, ts;  // ∫ s σ, t σ, s τt, t τs
  T ss, tt;          // ∫ s τs, t τt
};

/// Force and moment about the world's origin on body a, with the exact arms H Q r.
template <class T>
[[gnu::always_inline]] inline void world_wrench(const Resultant<T>& q, const Jump<T>& j, Triple<T>& force,
                                                Triple<T>& moment) {
  const Triple<T> m0 = {q.st - q.ts, q.tn, -q.sn};
  const Triple<T> turn_vector = {j.rn, j.rs, j.rt};
  const Triple<T> g = {j.rs * q.sn + j.rt * q.tn, j.rs * q.ss + j.rt * q.ts, j.rs * q.st + j.rt * q.tt};
  const Triple<T> local = j.cosine * m0 + j.share * cross(turn_vector, g);
  force = turn(j.frame, Triple<T>{q.n, q.s, q.t});
  moment = turn(j.frame, local) + cross(j.place, force);
}

}  // namespace voussoir
