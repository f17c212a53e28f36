// Plastic flow of eight tetrahedra at a time.
#include "solver/fill/principal.h"
#include "solver/fill/tet_strain.h"

namespace voussoir {

namespace tet {

namespace {

/// Cp⁻¹ − 1 of the elastic left Cauchy–Green tensor b with these principal values less one: Cp⁻¹ = F⁻¹ b F⁻ᵀ, and only
/// its deviation from a multiple of 1 means anything. With G = F⁻¹ − 1 = −F⁻¹ H nothing cancels.
template <class L>
[[gnu::always_inline]] inline Symmetric<L> memory_of(const Strain<L>& s, const L (&less_one)[3],
                                                     const Tensor<L>& axes) {
  const L by = -1.0 / (1.0 + s.change);
  Tensor<L> g, inverse;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const auto& c = s.cofactor.m;
      g.m[i][j] = by * (c[0][i] * s.h.m[0][j] + c[1][i] * s.h.m[1][j] + c[2][i] * s.h.m[2][j]);
      inverse.m[i][j] = i == j ? 1.0 + g.m[i][j] : g.m[i][j];
    }
  const Symmetric<L> z = square_less_one(g) + push(inverse, from_principal(less_one, axes));
  const L mean = (1.0 / 3.0) * trace(z);
  return (1.0 / (1.0 + mean)) * Symmetric<L>{z.xx - mean, z.yy - mean, z.zz - mean, z.xy, z.xz, z.yz};
}

void note_yield(std::uint8_t* yield, LaneMask lanes, const auto& region) {
  constexpr std::uint8_t shear = yields_in_shear | has_yielded_in_shear,
                         tension = yields_in_tension | has_yielded_in_tension;
  constexpr std::uint8_t bits[return_regions] = {0,       shear,   shear,           shear,           tension,
                                                 tension, tension, shear | tension, shear | tension, shear | tension};
  for (int lane = 0; lane < lane_count; ++lane)
    if (lanes[lane]) yield[lane] |= bits[int(region[lane])];
}

}  // namespace

template <class L>
LaneMask flow(const FillLaw& law, const Strain<L>& s, LaneMask lanes, Lanes* plastic, std::uint8_t* yield,
              Symmetric<L>& e, L& p, L& dissipated) {
  const L zero = all_lanes<L>(0.0);
  // The circular cone was on the safe side; only what is past the surface itself needs axes.
  const ApartValue<L> single = apart_value(e);
  const auto [high, low] = extremes(single);
  lanes &= near_surface(law, 2.0 * law.shear * high + p, 2.0 * law.shear * low + p);
  if (!any(lanes)) return lanes;
  const Principal<L> x = principal_axes(e, single);
  L trial[3], stress[3], region;
  for (int i = 0; i < 3; ++i) trial[i] = 2.0 * law.shear * x.value[i] + p;
  return_to_surface(law, trial, stress, &region);
  lanes &= less(all_lanes<L>(0.5), region);
  if (!any(lanes)) return lanes;
  note_yield(yield, lanes, region);
  const L mean = (1.0 / 3.0) * (stress[0] + stress[1] + stress[2]);
  const L swell = (1.0 / law.bulk) * (p - mean);
  L kept[3], stretch[3], work = zero, flowed = zero;
  for (int i = 0; i < 3; ++i) {
    kept[i] = (1.0 / (2.0 * law.shear)) * (stress[i] - mean);
    const L change = x.value[i] - kept[i], y = 2.0 * kept[i];
    work += (stress[i] - mean) * change;
    flowed += change * change;
    stretch[i] = y * (1.0 + y * (0.5 + y * (1.0 / 6.0)));  // exp(2 e) − 1
  }
  const Symmetric<L> memory = memory_of(s, stretch, x.axes);
  const L fresh[6] = {memory.xx, memory.yy, memory.zz, memory.xy, memory.xz, memory.yz};
  for (int c = 0; c < 6; ++c) plastic[c] = select(lanes, doubles_of(fresh[c]), plastic[c]);
  plastic[row_volume] += doubles_of(select(lanes, swell, zero));
  plastic[row_shear] += doubles_of(select(lanes, square_root((2.0 / 3.0) * flowed), zero));
  const Symmetric<L> left = from_principal(kept, x.axes);
  e = {select(lanes, left.xx, e.xx), select(lanes, left.yy, e.yy), select(lanes, left.zz, e.zz),
       select(lanes, left.xy, e.xy), select(lanes, left.xz, e.xz), select(lanes, left.yz, e.yz)};
  work += mean * swell;
  p = select(lanes, mean, p);
  dissipated = select(lanes, work, zero);
  return lanes;
}

template LaneMask flow(const FillLaw&, const Strain<Lanes>&, LaneMask, Lanes*, std::uint8_t*, Symmetric<Lanes>&, Lanes&,
                       Lanes&);
template LaneMask flow(const FillLaw&, const Strain<Floats>&, LaneMask, Lanes*, std::uint8_t*, Symmetric<Floats>&,
                       Floats&, Floats&);

}  // namespace tet

}  // namespace voussoir
