// Eight tetrahedra at a time: volumes, stresses, nodal forces.
#include "solver/fill/principal.h"
#include "solver/fill/tet_strain.h"

namespace voussoir {

namespace tet {

Lanes flow(const FillLaw& law, const Strain& s, LaneMask lanes, Lanes own, Lanes* plastic, std::uint8_t* yield,
           Symmetric<Lanes>& e, Lanes& p) {
  const Principal<Lanes> x = principal_axes(e);
  Lanes trial[3], stress[3], region;
  for (int i = 0; i < 3; ++i) trial[i] = 2.0 * law.shear * x.value[i] + p;
  return_to_surface(law, trial, stress, &region);
  lanes &= less(splat(0.5), region);  // the circular cone was on the safe side
  for (int lane = 0; lane < lane_count; ++lane) {
    if (!lanes[lane]) continue;
    constexpr std::uint8_t shear = yields_in_shear | has_yielded_in_shear,
                           tension = yields_in_tension | has_yielded_in_tension;
    constexpr std::uint8_t bits[return_regions] = {0,       shear,   shear,           shear,           tension,
                                                   tension, tension, shear | tension, shear | tension, shear | tension};
    yield[lane] |= bits[int(region[lane])];
  }
  const Lanes mean = (1.0 / 3.0) * (stress[0] + stress[1] + stress[2]);
  const Lanes swell = (p - mean) / law.bulk;
  Lanes kept[3], stretch[3], work = splat(0.0), flowed = splat(0.0);
  for (int i = 0; i < 3; ++i) {
    kept[i] = (stress[i] - mean) / (2.0 * law.shear);
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
  const LaneMask tears = lanes & at_most(splat(double(ReturnRegion::cut)), region);
  const Lanes dilates = select(without(lanes, tears), swell, splat(0.0)), opens = select(tears, swell, splat(0.0));
  plastic[row_dilation] += dilates;
  plastic[row_tension] += opens;
  plastic[row_shear] += select(lanes, square_root((2.0 / 3.0) * flowed), splat(0.0));
  const Symmetric<Lanes> left = from_principal(kept, x.axes);
  e = {select(lanes, left.xx, e.xx), select(lanes, left.yy, e.yy), select(lanes, left.zz, e.zz),
       select(lanes, left.xy, e.xy), select(lanes, left.xz, e.xz), select(lanes, left.yz, e.yz)};
  work += p * dilates + law.bulk * (own - plastic[row_tension]) * opens;
  p = select(lanes, mean, p);
  return select(lanes, work, splat(0.0));
}

}  // namespace tet

namespace {

using namespace tet;

[[gnu::always_inline]] inline void add_forces(const TetBatch& batch, const Vector (&f)[4], double* sums) {
  const Lanes zero = splat(0.0);
  for (int k = 0; k < 4; k += 2) {
    Lanes rows[lane_count] = {f[k].x, f[k].y, f[k].z, zero, f[k + 1].x, f[k + 1].y, f[k + 1].z, zero};
    transpose(rows);
    for (int lane = 0; lane < batch.count; ++lane) {
      double* a = sums + node_width * std::size_t(batch.sum[k][lane]);
      double* b = sums + node_width * std::size_t(batch.sum[k + 1][lane]);
      const Quad first = load_quad(a) + __builtin_shufflevector(rows[lane], rows[lane], 0, 1, 2, 3);
      std::memcpy(a, &first, sizeof(first));
      const Quad second = load_quad(b) + __builtin_shufflevector(rows[lane], rows[lane], 4, 5, 6, 7);
      std::memcpy(b, &second, sizeof(second));
    }
  }
}

/// Puts `now` in the place of `last`; how much it has changed, of values rounded alike, so that changes add up.
[[gnu::always_inline]] inline Lanes narrow_change(Lanes now, Singles& last) {
  const Singles rounded = narrow(now);
  const Lanes change = widen(rounded) - widen(last);
  last = rounded;
  return change;
}

/// Elastic strain with its mean volumetric part, and the tetrahedron's own volumetric part.
struct ElasticStrain {
  Symmetric<Lanes> e;
  Lanes mean, own;
};

/// Fᵀ (e + ⅓ θ 1) F.
[[gnu::always_inline]] inline Symmetric<Lanes> material(const Tensor<Lanes>& f, const ElasticStrain& s) {
  const Lanes third = (1.0 / 3.0) * s.mean;
  const Symmetric<Lanes> whole = {s.e.xx + third, s.e.yy + third, s.e.zz + third, s.e.xy, s.e.xz, s.e.yz};
  return push(transposed(f), whole);
}

/// The branches' stress on material axes, and the work done on them (J/m3): q ← e q + g Δε of the elastic strain
/// Fᵀ (e + ⅓ θ 1) F, θ the mean one (docs/theory/damping.md). Nodes work on it with all strain, what has flowed
/// included
/// (`trial`: before the flow), and with the tetrahedron's own volumetric part.
template <int count>
[[gnu::always_inline]] inline Symmetric<Lanes> viscous(const Branches& branches, const FillLaw& law,
                                                       const Tensor<Lanes>& f, const ElasticStrain& kept_strain,
                                                       const ElasticStrain& trial, bool flows, Singles* last,
                                                       Singles* kept, Lanes& work) {
  const Symmetric<Lanes> now = material(f, kept_strain);
  const Symmetric<Lanes> plastic = flows ? material(f, trial) - now : Symmetric<Lanes>{};
  const Lanes *strain = &now.xx, *flowed = &plastic.xx;
  Lanes q[6], before[6], change[6];
  Lanes pressures = splat(0.0);
  for (int c = 0; c < 6; ++c) {
    change[c] = narrow_change(strain[c], last[c]);
    q[c] = before[c] = splat(0.0);
    for (int k = 0; k < count; ++k, ++kept) {
      const Lanes then = widen(*kept), next = branches.e[k] * then + branches.g[k] * change[c];
      before[c] += then, q[c] += next;
      *kept = narrow(next);
    }
  }
  const double shear = 2.0 * law.shear, lame = law.lame();
  const Lanes volume = lame * (q[0] + q[1] + q[2]), volume_before = lame * (before[0] + before[1] + before[2]);
  Symmetric<Lanes> stress;
  Lanes* to = &stress.xx;
  for (int c = 0; c < 6; ++c) {
    to[c] = shear * q[c] + (c < 3 ? volume : splat(0.0));
    const Lanes was = shear * before[c] + (c < 3 ? volume_before : splat(0.0));
    change[c] += flowed[c];
    work += (c < 3 ? 0.5 : 1.0) * (to[c] + was) * change[c];
    if (c < 3) pressures += (1.0 / 6.0) * (to[c] + was);
  }
  const Lanes swollen = narrow_change(kept_strain.own, last[6]) + (trial.own - kept_strain.own);
  work += pressures * (swollen - change[0] - change[1] - change[2]);
  return stress;
}

/// Energy in the branches' springs, J/m3.
template <int count>
Lanes branch_energy(const Branches& branches, const FillLaw& law, const Singles* kept) {
  Lanes sum = splat(0.0);
  for (int k = 0; k < count; ++k) {
    Lanes q[6];
    for (int c = 0; c < 6; ++c) q[c] = widen(kept[c * count + k]);
    const Lanes volume = q[0] + q[1] + q[2];
    const Lanes squares = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + 2.0 * (q[3] * q[3] + q[4] * q[4] + q[5] * q[5]);
    sum += branches.stored[k] * (law.shear * squares + 0.5 * law.lame() * volume * volume);
  }
  return sum;
}

/// What a tile's tetrahedra add up to, besides forces.
struct TileSums {
  Lanes dissipated = splat(0.0), work = splat(0.0), elastic = splat(0.0), springs = splat(0.0);
  FillReport report;
};

void note_inverted(const FillModel& fill, std::size_t batch, LaneMask flat, FillReport& report) {
  for (int lane = 0; lane < fill.batches[batch].count; ++lane) {
    const std::int32_t tet = fill.tet_of_lane[lane_count * batch + std::size_t(lane)];
    if (flat[lane] && (report.inverted < 0 || tet < report.inverted)) report.inverted = tet;
  }
}

template <int count>
void batch_stresses(const FillPass& pass, std::size_t index, TileSums& tile) {
  const FillModel& fill = *pass.fill;
  FillMemory& memory = *pass.memory;
  const TetBatch& batch = fill.batches[index];
  const FillLaw& law = fill.law_of(index);
  const LaneMask used = LaneMask::first(batch.count);
  auto* plastic = reinterpret_cast<Lanes*>(&memory.plastic[plastic_index(index, 0)]);
  std::uint8_t* yield = &memory.yield[lane_count * index];

  // 1. strain, elastic trial stress
  const Nodes n = gather_nodes(memory.pose.data(), batch);
  Strain s = strain_of(batch, n, plastic);
  const LaneMask flat = ~less(splat(least_volume - 1.0), s.change) & used;
  if (any(flat)) note_inverted(fill, index, flat, tile.report);
  const Lanes dilated = plastic[row_dilation], own = volumetric(s.change) - dilated;
  const Lanes mean = pass.averaged ? 0.25 * (n.mean[0] + n.mean[1] + n.mean[2] + n.mean[3]) : own;
  const Lanes opened = plastic[row_tension];
  Lanes p = law.bulk * (mean - opened);
  const ElasticStrain trial = {s.e, mean - opened, own - opened};

  // 2. plastic flow
  const LaneMask yields = may_flow(law, s.e, p);
  for (int lane = 0; lane < lane_count; ++lane) yield[lane] &= std::uint8_t(~(yields_in_shear | yields_in_tension));
  if (any(yields)) {
    const Lanes lost = flow(law, s, yields, own, plastic, yield, s.e, p);
    tile.dissipated += select(used, batch.volume * lost, splat(0.0));
    for (int lane = 0; lane < batch.count; ++lane)
      tile.report.yielding += (yield[lane] & (yields_in_shear | yields_in_tension)) != 0;
  }

  // 3. first Piola–Kirchhoff stress: τ F⁻ᵀ, and F S of the branches
  const auto [tau, by] = kirchhoff(law, s, p);
  const Lanes t[3][3] = {{tau.xx, tau.xy, tau.xz}, {tau.xy, tau.yy, tau.yz}, {tau.xz, tau.yz, tau.zz}};
  Tensor<Lanes> piola;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      piola.m[i][j] = by * (t[i][0] * s.cofactor.m[0][j] + t[i][1] * s.cofactor.m[1][j] + t[i][2] * s.cofactor.m[2][j]);
  if constexpr (count > 0) {
    auto* last = reinterpret_cast<Singles*>(&memory.last[strain_rows * lane_count * index]);
    auto* kept = reinterpret_cast<Singles*>(&memory.branch[6 * lane_count * std::size_t(count) * index]);
    Lanes work = splat(0.0);
    const ElasticStrain strain = {s.e, p / law.bulk, own - (plastic[row_dilation] - dilated) - plastic[row_tension]};
    const Symmetric<Lanes> v = viscous<count>(pass.branches, law, s.f, strain, trial, any(yields), last, kept, work);
    tile.work += select(used, batch.volume * work, splat(0.0));
    const Lanes w[3][3] = {{v.xx, v.xy, v.xz}, {v.xy, v.yy, v.yz}, {v.xz, v.yz, v.zz}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        piola.m[i][j] += s.f.m[i][0] * w[0][j] + s.f.m[i][1] * w[1][j] + s.f.m[i][2] * w[2][j];
    if (pass.energies)
      tile.springs += select(used, batch.volume * branch_energy<count>(pass.branches, law, kept), splat(0.0));
  }

  // 4. nodal forces
  Vector f[4];
  const Lanes zero = splat(0.0);
  f[0] = {zero, zero, zero};
  for (int k = 0; k < 3; ++k) {
    const Lanes* g = batch.gradient + 3 * k;
    Lanes out[3];
    for (int i = 0; i < 3; ++i)
      out[i] = -batch.volume * (piola.m[i][0] * g[0] + piola.m[i][1] * g[1] + piola.m[i][2] * g[2]);
    f[k + 1] = {out[0], out[1], out[2]};
    f[0] = f[0] - f[k + 1];
  }
  add_forces(batch, f, pass.sums);
  if (pass.energies) {
    const Lanes pressure = own * (mean - 2.0 * opened) + opened * opened;
    tile.elastic += select(used, batch.volume * (law.shear * inner(s.e, s.e) + 0.5 * law.bulk * pressure), splat(0.0));
  }
}

double sum_of(Lanes x) {
  double sum = 0.0;
  for (int lane = 0; lane < lane_count; ++lane) sum += x[lane];
  return sum;
}

}  // namespace

void FillReport::merge(const FillReport& other) {
  if (other.inverted >= 0 && (inverted < 0 || other.inverted < inverted)) inverted = other.inverted;
  if (other.runaway >= 0 && (runaway < 0 || other.runaway < runaway)) runaway = other.runaway;
  yielding += other.yielding;
  search |= other.search;
}

void FillPass::volumes(std::size_t tile) const {
  if (!averaged) return;
  const FillTile& t = fill->tiles[tile];
  std::fill(volume_sums + t.first_sum, volume_sums + t.end_sum, 0.0);
  for (std::int32_t b = t.first_batch; b < t.end_batch; ++b) {
    const TetBatch& batch = fill->batches[std::size_t(b)];
    const Nodes n = gather_nodes(memory->pose.data(), batch);
    const Lanes change = clipped(volume_change(gradient(batch, n)));
    const auto* plastic = reinterpret_cast<const Lanes*>(&memory->plastic[plastic_index(std::size_t(b), 0)]);
    const Lanes part = fill->law_of(std::size_t(b)).bulk * batch.volume * (volumetric(change) - plastic[row_dilation]);
    for (int k = 0; k < 4; ++k)
      for (int lane = 0; lane < batch.count; ++lane) volume_sums[batch.sum[k][lane]] += part[lane];
  }
}

FillReport FillPass::stresses(std::size_t tile) const {
  const FillTile& t = fill->tiles[tile];
  std::fill(sums + node_width * t.first_sum, sums + node_width * t.end_sum, 0.0);
  TileSums found;
  for (std::int32_t b = t.first_batch; b < t.end_batch; ++b) switch (branches.count) {
      case 0:
        batch_stresses<0>(*this, std::size_t(b), found);
        break;
      case 1:
        batch_stresses<1>(*this, std::size_t(b), found);
        break;
      case 2:
        batch_stresses<2>(*this, std::size_t(b), found);
        break;
      case 3:
        batch_stresses<3>(*this, std::size_t(b), found);
        break;
      default:
        batch_stresses<4>(*this, std::size_t(b), found);
    }
  double* lost = &memory->lost[4 * tile];
  lost[0] += sum_of(found.dissipated);
  lost[1] += sum_of(found.work);
  if (energies) energies[tile] = {sum_of(found.elastic), sum_of(found.springs)};
  return found.report;
}

}  // namespace voussoir
