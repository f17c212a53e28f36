// Maxwell branches of eight tetrahedra at a time (docs/theory/damping.md, fill.md). Rows of a batch: branch by branch
// the six components, two of them side by side in a register. The decay uses 1 − e, because e is near one and its
// rounding in single precision would change the relaxation time.
#pragma once
#include "solver/fill/tet_strain.h"

namespace voussoir::tet {

/// Elastic strain with the mean volumetric part, and the volumetric part of the tetrahedron itself.
template <class L>
struct ElasticStrain {
  Symmetric<L> e;
  L mean, own;
};

/// 3 over the trace of FᵀF. With this factor the convected axes keep their mean length for any plastic flow. Fᵀ e F
/// alone would grow with the square of a stretch, and its nodal forces with the fourth power.
template <class L>
[[gnu::always_inline]] inline L stretch_back(const Tensor<L>& f) {
  L sum = all_lanes<L>(0.0);
  for (const auto& row : f.m)
    for (const L& x : row) sum += x * x;
  return 3.0 / sum;
}

/// Fᵀ (e + ⅓ θ 1) F 3/tr FᵀF.
template <class L>
[[gnu::always_inline]] inline Symmetric<L> material(const Tensor<L>& f, L back, const ElasticStrain<L>& s) {
  const L third = (1.0 / 3.0) * s.mean;
  const Symmetric<L> whole = {s.e.xx + third, s.e.yy + third, s.e.zz + third, s.e.xy, s.e.xz, s.e.yz};
  return back * push(transposed(f), whole);
}

/// The six components two by two: xx yy, zz xy, xz yz.
struct Packed {
  Pairs of[3];
  Singles trace() const { return low(of[0]) + high(of[0]) + low(of[1]); }
};
template <class L>
[[gnu::always_inline]] inline Packed pack(const Symmetric<L>& a) {
  return {{pair(singles_of(a.xx), singles_of(a.yy)), pair(singles_of(a.zz), singles_of(a.xy)),
           pair(singles_of(a.xz), singles_of(a.yz))}};
}
template <class L>
[[gnu::always_inline]] inline Symmetric<L> unpack(const Packed& a) {
  return {numbers_of<L>(low(a.of[0])),  numbers_of<L>(high(a.of[0])), numbers_of<L>(low(a.of[1])),
          numbers_of<L>(high(a.of[1])), numbers_of<L>(low(a.of[2])),  numbers_of<L>(high(a.of[2]))};
}
/// a : b.
[[gnu::always_inline]] inline Singles inner(const Packed& a, const Packed& b) {
  const Pairs first = a.of[0] * b.of[0], second = a.of[1] * b.of[1], third = a.of[2] * b.of[2];
  return low(first) + high(first) + low(second) + 2.0f * (high(second) + low(third) + high(third));
}
[[gnu::always_inline]] inline void save_pair(Pairs x, Singles* rows) {
  std::memcpy(rows, &x, sizeof(x));
}

/// Stress of the branches in material axes, and work on them (J/m3): q ← e q + g Δε with the elastic strain material(),
/// where θ is the mean one; `back`: stretch_back(). The work of the nodes includes the whole strain with plastic flow
/// (`trial`: before the flow) and the volumetric part of the tetrahedron itself. `last`: strain at the last pass,
/// rounded to single precision, so that changes add up.
template <int count, class L>
[[gnu::always_inline]] inline Symmetric<L> viscous(const Branches& branches, const FillLaw& law, const Tensor<L>& f,
                                                   L back, const ElasticStrain<L>& strain,
                                                   const ElasticStrain<L>& trial, bool flows, Singles* last,
                                                   Singles* kept, Lanes& work) {
  const Symmetric<L> now = material(f, back, strain);
  const Packed rounded = pack(now);
  Packed change, q{}, both{};  // sums over the branches, and over both ends of the time step
  for (int c = 0; c < 3; ++c) {
    change.of[c] = rounded.of[c] - load_pair(last + 2 * c);
    save_pair(rounded.of[c], last + 2 * c);
  }
  for (int k = 0; k < count; ++k) {
    const Pairs gain = pair(singles(branches.g[k]), singles(branches.g[k])),
                fade = pair(singles(1.0 - branches.e[k]), singles(1.0 - branches.e[k]));
    for (int c = 0; c < 3; ++c) {
      Singles* row = kept + 6 * k + 2 * c;
      const Pairs then = load_pair(row), next = then + (gain * change.of[c] - fade * then);
      q.of[c] += next, both.of[c] += then + next;
      save_pair(next, row);
    }
  }
  const Singles own = singles_of(strain.own);
  Singles swollen = own - last[6];
  last[6] = own;
  if (flows) {
    const Packed flowed = pack(material(f, back, trial) - now);
    for (int c = 0; c < 3; ++c) change.of[c] += flowed.of[c];
    swollen += singles_of(trial.own - strain.own);
  }
  // With the mean of the stresses at both ends of the time step.
  const Lanes sum = widen(both.trace()), grown = widen(change.trace());
  work =
      law.shear * widen(inner(both, change)) + 0.5 * sum * (law.lame() * grown + law.bulk * (widen(swollen) - grown));

  const Symmetric<L> strains = unpack<L>(q);
  Symmetric<L> stress = all_lanes<L>(2.0 * law.shear) * strains;
  const L volume = law.lame() * trace(strains);
  stress.xx += volume, stress.yy += volume, stress.zz += volume;
  return stress;
}

/// Energy in the springs of the branches, J/m3.
template <int count>
Lanes branch_energy(const Branches& branches, const FillLaw& law, const Singles* kept) {
  Lanes sum = splat(0.0);
  for (int k = 0; k < count; ++k) {
    const Singles* row = kept + 6 * k;
    const Symmetric<Lanes> q = unpack<Lanes>({{load_pair(row), load_pair(row + 2), load_pair(row + 4)}});
    const Lanes volume = trace(q);
    sum += branches.stored[k] * (law.shear * inner(q, q) + 0.5 * law.lame() * volume * volume);
  }
  return sum;
}

}  // namespace voussoir::tet
