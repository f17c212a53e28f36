// Plastic flow of eight tetrahedra at a time.
#include "solver/fill/principal.h"
#include "solver/fill/tet_strain.h"

namespace voussoir {

namespace tet {

LaneMask flow(const FillLaw& law, const Strain& s, LaneMask lanes, Lanes* plastic, std::uint8_t* yield,
              Symmetric<Lanes>& e, Lanes& p, Lanes& dissipated) {
  // The circular cone was on the safe side; only what is past the surface itself needs axes.
  const ApartValue<Lanes> single = apart_value(e);
  const auto [high, low] = extremes(single);
  lanes &= near_surface(law, 2.0 * law.shear * high + p, 2.0 * law.shear * low + p);
  if (!any(lanes)) return lanes;
  const Principal<Lanes> x = principal_axes(e, single);
  Lanes trial[3], stress[3], region;
  for (int i = 0; i < 3; ++i) trial[i] = 2.0 * law.shear * x.value[i] + p;
  return_to_surface(law, trial, stress, &region);
  lanes &= less(splat(0.5), region);
  if (!any(lanes)) return lanes;
  for (int lane = 0; lane < lane_count; ++lane) {
    if (!lanes[lane]) continue;
    constexpr std::uint8_t shear = yields_in_shear | has_yielded_in_shear,
                           tension = yields_in_tension | has_yielded_in_tension;
    constexpr std::uint8_t bits[return_regions] = {0,       shear,   shear,           shear,           tension,
                                                   tension, tension, shear | tension, shear | tension, shear | tension};
    yield[lane] |= bits[int(region[lane])];
  }
  const Lanes mean = (1.0 / 3.0) * (stress[0] + stress[1] + stress[2]);
  const Lanes swell = (1.0 / law.bulk) * (p - mean);
  Lanes kept[3], stretch[3], work = splat(0.0), flowed = splat(0.0);
  for (int i = 0; i < 3; ++i) {
    kept[i] = (1.0 / (2.0 * law.shear)) * (stress[i] - mean);
    const Lanes change = x.value[i] - kept[i], y = 2.0 * kept[i];
    work += (stress[i] - mean) * change;
    flowed += change * change;
    stretch[i] = 1.0 + y * (1.0 + y * (0.5 + y * (1.0 / 6.0)));  // exp(2 e)
  }
  // Cp⁻¹ = F⁻¹ b F⁻ᵀ with F⁻¹ = cof(F)ᵀ / J; only its deviation from a multiple of 1 means anything.
  const Symmetric<Lanes> inverse = push(transposed(s.cofactor), from_principal(stretch, x.axes));
  const Lanes scale = 3.0 / trace(inverse);
  const Lanes fresh[6] = {scale * inverse.xx - 1.0, scale * inverse.yy - 1.0, scale * inverse.zz - 1.0,
                          scale * inverse.xy,       scale * inverse.xz,       scale * inverse.yz};
  for (int c = 0; c < 6; ++c) plastic[c] = select(lanes, fresh[c], plastic[c]);
  plastic[row_volume] += select(lanes, swell, splat(0.0));
  plastic[row_shear] += select(lanes, square_root((2.0 / 3.0) * flowed), splat(0.0));
  const Symmetric<Lanes> left = from_principal(kept, x.axes);
  e = {select(lanes, left.xx, e.xx), select(lanes, left.yy, e.yy), select(lanes, left.zz, e.zz),
       select(lanes, left.xy, e.xy), select(lanes, left.xz, e.xz), select(lanes, left.yz, e.yz)};
  work += mean * swell;
  p = select(lanes, mean, p);
  dissipated = select(lanes, work, splat(0.0));
  return lanes;
}

}  // namespace tet

}  // namespace voussoir
