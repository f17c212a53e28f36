// Eight tetrahedra at a time: volumes, stresses, nodal forces.
#include <algorithm>

#include "solver/fill/tet_branches.h"
#include "solver/model/with_branches.h"

namespace voussoir {

namespace {

using namespace tet;

template <class L>
[[gnu::always_inline]] inline void add_forces(const TetBatch& batch, const Triple<L> (&f)[4], double* sums) {
  const Lanes zero = splat(0.0);
  for (int k = 0; k < 4; k += 2) {
    const Triple<L>&one = f[k], &two = f[k + 1];
    Lanes rows[lane_count] = {doubles_of(one.x), doubles_of(one.y), doubles_of(one.z), zero,
                              doubles_of(two.x), doubles_of(two.y), doubles_of(two.z), zero};
    transpose(rows);
    for (int lane = 0; lane < batch.count; ++lane) {
      double* a = sums + node_width * std::size_t(batch.sum[k][lane]);
      double* b = sums + node_width * std::size_t(batch.sum[k + 1][lane]);
      const Quad first = load_quad(a) + low(rows[lane]);
      std::memcpy(a, &first, sizeof(first));
      const Quad second = load_quad(b) + high(rows[lane]);
      std::memcpy(b, &second, sizeof(second));
    }
  }
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

constexpr std::uint64_t every_lane = 0x0101010101010101;

/// Forgets which lanes yielded in the pass before.
void begin_yield(std::uint8_t* yield) {
  std::uint64_t flags;
  std::memcpy(&flags, yield, sizeof(flags));
  flags &= ~(every_lane * (yields_in_shear | yields_in_tension));
  std::memcpy(yield, &flags, sizeof(flags));
}

int count_yielding(const std::uint8_t* yield, int count) {
  int sum = 0;
  for (int lane = 0; lane < count; ++lane) sum += (yield[lane] & (yields_in_shear | yields_in_tension)) != 0;
  return sum;
}

/// Batches are passed in order, but each in several arrays: what comes next is asked for before it is needed, a part at
/// a time (see fetch()). Past the tile's `end` nothing is read, others may be at work there.
constexpr std::size_t ahead = 4;  // batches
void fetch_tetrahedra(const FillModel& fill, std::size_t batch, bool single) {
  fetch(&fill.batches[batch], sizeof(TetBatch));
  if (single) fetch(&fill.shapes[shape_rows * lane_count * batch], shape_rows * sizeof(Singles));
}
template <int count>
struct TetsAhead {
  const FillModel& fill;
  const FillMemory& memory;
  std::size_t next, end;
  bool single;

  [[gnu::always_inline]] bool any() const { return next < fill.batches.size(); }
  [[gnu::always_inline]] void tetrahedra() const {
    if (!any()) return;
    fetch_tetrahedra(fill, next, single);
    if constexpr (count > 0) fetch(&memory.last[strain_rows * lane_count * next], strain_rows * sizeof(Singles));
  }
  [[gnu::always_inline]] void branches() const {
    if constexpr (count > 0)
      if (any()) fetch(&memory.branch[6 * lane_count * std::size_t(count) * next], 6 * count * sizeof(Singles));
  }
  [[gnu::always_inline]] void plastic() const {
    if (next < end && has_flowed(&memory.yield[lane_count * next]))
      fetch(&memory.plastic[plastic_index(next, 0)], plastic_width * sizeof(Lanes));
  }
};

/// Eight tetrahedra, computed in Lanes or Floats.
template <int count, class L>
void batch_stresses(const FillPass& pass, std::size_t index, std::size_t end, TileSums& tile) {
  const FillModel& fill = *pass.fill;
  FillMemory& memory = *pass.memory;
  const TetBatch& batch = fill.batches[index];
  const FillLaw& law = fill.law_of(index);
  const LaneMask used = LaneMask::first(batch.count);
  const L zero = all_lanes<L>(0.0);
  auto* plastic = reinterpret_cast<Lanes*>(&memory.plastic[plastic_index(index, 0)]);
  std::uint8_t* yield = &memory.yield[lane_count * index];
  const bool flowed = has_flowed(yield);
  const TetsAhead<count> coming{fill, memory, index + ahead, end, pass.single};
  coming.tetrahedra();

  // 1. strain, elastic trial stress
  const Nodes<L> n = gather_nodes<L>(memory.pose.data(), batch);
  const Shape<L> shape = shape_of<L>(fill, index);
  const L volume = select(used, shape.volume, zero);
  Strain<L> s = strain_of(shape, n, flowed ? plastic : nullptr);
  const LaneMask flat = ~less(all_lanes<L>(least_volume - 1.0), s.change) & used;
  if (any(flat)) note_inverted(fill, index, flat, tile.report);
  const Volumetric<L> grown = volumetric(s.change);
  const Lanes swollen = flowed ? plastic[row_volume] : splat(0.0);
  const L own = grown.strain - numbers_of<L>(swollen);
  const L mean = pass.averaged ? n.mean : own;
  L p = law.bulk * mean;
  const ElasticStrain<L> trial = {s.e, mean, own};
  ElasticStrain<L> strain = trial;

  coming.branches();

  // 2. plastic flow
  const LaneMask yields = may_flow(law, s.e, p);
  if (flowed) begin_yield(yield);
  L lost;
  const bool flows = any(yields) && any(flow(law, s, yields, plastic, yield, s.e, p, lost));
  if (flows) {
    tile.dissipated += doubles_of(volume * lost);
    tile.report.yielding += count_yielding(yield, batch.count);
    strain = {s.e, p / law.bulk, own - numbers_of<L>(plastic[row_volume] - swollen)};
  }

  coming.plastic();

  // 3. the first Piola–Kirchhoff stress times the volume: τ F⁻ᵀ, and F S of the branches
  const Symmetric<L> pull = (shape.volume * grown.by) * kirchhoff(law, s, grown.slope, p);
  const L t[3][3] = {{pull.xx, pull.xy, pull.xz}, {pull.xy, pull.yy, pull.yz}, {pull.xz, pull.yz, pull.zz}};
  Tensor<L> piola;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      piola.m[i][j] = t[i][0] * s.cofactor.m[0][j] + t[i][1] * s.cofactor.m[1][j] + t[i][2] * s.cofactor.m[2][j];
  if constexpr (count > 0) {
    auto* last = reinterpret_cast<Singles*>(&memory.last[strain_rows * lane_count * index]);
    auto* kept = reinterpret_cast<Singles*>(&memory.branch[6 * lane_count * std::size_t(count) * index]);
    Lanes work;
    const L back = flowed ? stretch_back(s.f) : all_lanes<L>(1.0);
    const Symmetric<L> v =
        (shape.volume * back) * viscous<count>(pass.branches, law, s.f, back, strain, trial, flows, last, kept, work);
    tile.work += doubles_of(volume) * work;
    const L w[3][3] = {{v.xx, v.xy, v.xz}, {v.xy, v.yy, v.yz}, {v.xz, v.yz, v.zz}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        piola.m[i][j] += s.f.m[i][0] * w[0][j] + s.f.m[i][1] * w[1][j] + s.f.m[i][2] * w[2][j];
    if (pass.energies) tile.springs += doubles_of(volume) * branch_energy<count>(pass.branches, law, kept);
  }

  // 4. nodal forces
  Triple<L> f[4];
  f[0] = {zero, zero, zero};
  for (int k = 0; k < 3; ++k) {
    const Triple<L>& g = shape.gradient[k];
    L out[3];
    for (int i = 0; i < 3; ++i) out[i] = piola.m[i][0] * g.x + piola.m[i][1] * g.y + piola.m[i][2] * g.z;
    f[k + 1] = {-out[0], -out[1], -out[2]};
    f[0] = f[0] - f[k + 1];
  }
  add_forces(batch, f, pass.sums);
  if (pass.energies) tile.elastic += doubles_of(volume * (law.shear * inner(s.e, s.e) + 0.5 * law.bulk * own * mean));
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

namespace {

/// κ V θ of eight tetrahedra, J.
template <class L>
[[gnu::always_inline]] inline Lanes batch_volumes(const FillPass& pass, std::size_t index) {
  const FillModel& fill = *pass.fill;
  const TetBatch& batch = fill.batches[index];
  const Nodes<L> n = gather_nodes<L>(pass.memory->pose.data(), batch);
  const Shape<L> shape = shape_of<L>(fill, index);
  L strain = volumetric(clipped(volume_change(gradient(shape, n)))).strain;
  if (has_flowed(&pass.memory->yield[lane_count * index])) {
    const auto* plastic = reinterpret_cast<const Lanes*>(&pass.memory->plastic[plastic_index(index, 0)]);
    strain -= numbers_of<L>(plastic[row_volume]);
  }
  return doubles_of(fill.law_of(index).bulk * shape.volume * strain);
}

}  // namespace

void FillPass::volumes(std::size_t tile) const {
  if (!averaged) return;
  const FillTile& t = fill->tiles[tile];
  std::fill(volume_sums + t.first_sum, volume_sums + t.end_sum, 0.0);
  for (auto b = std::size_t(t.first_batch); b < std::size_t(t.end_batch); ++b) {
    const TetBatch& batch = fill->batches[b];
    if (b + ahead < fill->batches.size()) fetch_tetrahedra(*fill, b + ahead, single);
    const Lanes part = single ? batch_volumes<Floats>(*this, b) : batch_volumes<Lanes>(*this, b);
    for (int k = 0; k < 4; ++k)
      for (int lane = 0; lane < batch.count; ++lane) volume_sums[batch.sum[k][lane]] += part[lane];
  }
}

FillReport FillPass::stresses(std::size_t tile) const {
  const FillTile& t = fill->tiles[tile];
  std::fill(sums + node_width * t.first_sum, sums + node_width * t.end_sum, 0.0);
  TileSums found;
  with_branches(branches.count, [&](auto count) {
    const auto end = std::size_t(t.end_batch);
    for (auto b = std::size_t(t.first_batch); b < end; ++b)
      single ? batch_stresses<count, Floats>(*this, b, end, found) : batch_stresses<count, Lanes>(*this, b, end, found);
  });
  double* lost = &memory->lost[4 * tile];
  lost[0] += sum_of(found.dissipated);
  lost[1] += sum_of(found.work);
  if (energies) energies[tile] = {sum_of(found.elastic), sum_of(found.springs)};
  return found.report;
}

}  // namespace voussoir
