// Eight tetrahedra at a time: volumes, stresses, nodal forces.
#include <algorithm>

#include "solver/fill/tet_branches.h"
#include "solver/model/with_branches.h"

namespace voussoir {

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
template <int count>
struct TetsAhead {
  const FillModel& fill;
  const FillMemory& memory;
  std::size_t next, end;

  [[gnu::always_inline]] bool any() const { return next < fill.batches.size(); }
  [[gnu::always_inline]] void tetrahedra() const {
    if (!any()) return;
    fetch(&fill.batches[next], sizeof(TetBatch));
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

template <int count>
void batch_stresses(const FillPass& pass, std::size_t index, std::size_t end, TileSums& tile) {
  const FillModel& fill = *pass.fill;
  FillMemory& memory = *pass.memory;
  const TetBatch& batch = fill.batches[index];
  const FillLaw& law = fill.law_of(index);
  const LaneMask used = LaneMask::first(batch.count);
  const Lanes zero = splat(0.0);
  auto* plastic = reinterpret_cast<Lanes*>(&memory.plastic[plastic_index(index, 0)]);
  std::uint8_t* yield = &memory.yield[lane_count * index];
  const bool flowed = has_flowed(yield);
  const TetsAhead<count> coming{fill, memory, index + ahead, end};
  coming.tetrahedra();

  // 1. strain, elastic trial stress
  const Nodes n = gather_nodes(memory.pose.data(), batch);
  const Shape shape = shape_of(fill.place.data(), batch);
  const Lanes volume = select(used, (1.0 / 6.0) * shape.volume6, zero);
  Strain s = strain_of(shape, n, flowed ? plastic : nullptr);
  const LaneMask flat = ~less(splat(least_volume - 1.0), s.change) & used;
  if (any(flat)) note_inverted(fill, index, flat, tile.report);
  const Volumetric grown = volumetric(s.change);
  const Lanes swollen = flowed ? plastic[row_volume] : zero, own = grown.strain - swollen;
  const Lanes mean = pass.averaged ? 0.25 * (n.mean[0] + n.mean[1] + n.mean[2] + n.mean[3]) : own;
  Lanes p = law.bulk * mean;
  const ElasticStrain trial = {s.e, mean, own};
  ElasticStrain strain = trial;

  coming.branches();

  // 2. plastic flow
  const LaneMask yields = may_flow(law, s.e, p);
  if (flowed) begin_yield(yield);
  Lanes lost;
  const bool flows = any(yields) && any(flow(law, s, yields, plastic, yield, s.e, p, lost));
  if (flows) {
    tile.dissipated += volume * lost;
    tile.report.yielding += count_yielding(yield, batch.count);
    strain = {s.e, p / law.bulk, own - (plastic[row_volume] - swollen)};
  }

  coming.plastic();

  // 3. a sixth of the first Piola–Kirchhoff stress: τ F⁻ᵀ, and F S of the branches
  const Symmetric<Lanes> pull = ((1.0 / 6.0) * grown.by) * kirchhoff(law, s, grown.slope, p);
  const Lanes t[3][3] = {{pull.xx, pull.xy, pull.xz}, {pull.xy, pull.yy, pull.yz}, {pull.xz, pull.yz, pull.zz}};
  Tensor<Lanes> piola;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      piola.m[i][j] = t[i][0] * s.cofactor.m[0][j] + t[i][1] * s.cofactor.m[1][j] + t[i][2] * s.cofactor.m[2][j];
  if constexpr (count > 0) {
    auto* last = reinterpret_cast<Singles*>(&memory.last[strain_rows * lane_count * index]);
    auto* kept = reinterpret_cast<Singles*>(&memory.branch[6 * lane_count * std::size_t(count) * index]);
    Lanes work;
    const Lanes back = flowed ? stretch_back(s.f) : splat(1.0);
    const Symmetric<Lanes> v =
        (1.0 / 6.0) * back * viscous<count>(pass.branches, law, s.f, back, strain, trial, flows, last, kept, work);
    tile.work += volume * work;
    const Lanes w[3][3] = {{v.xx, v.xy, v.xz}, {v.xy, v.yy, v.yz}, {v.xz, v.yz, v.zz}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        piola.m[i][j] += s.f.m[i][0] * w[0][j] + s.f.m[i][1] * w[1][j] + s.f.m[i][2] * w[2][j];
    if (pass.energies) tile.springs += volume * branch_energy<count>(pass.branches, law, kept);
  }

  // 4. nodal forces
  Vector f[4];
  f[0] = {zero, zero, zero};
  for (int k = 0; k < 3; ++k) {
    const Vector& g = shape.area[k];
    Lanes out[3];
    for (int i = 0; i < 3; ++i) out[i] = piola.m[i][0] * g.x + piola.m[i][1] * g.y + piola.m[i][2] * g.z;
    f[k + 1] = {-out[0], -out[1], -out[2]};
    f[0] = f[0] - f[k + 1];
  }
  add_forces(batch, f, pass.sums);
  if (pass.energies) {
    tile.elastic += volume * (law.shear * inner(s.e, s.e) + 0.5 * law.bulk * own * mean);
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
    if (std::size_t(b) + ahead < fill->batches.size()) fetch(&batch + ahead, sizeof(TetBatch));
    const Nodes n = gather_nodes(memory->pose.data(), batch);
    const Shape shape = shape_of(fill->place.data(), batch);
    const Lanes change = clipped(volume_change(gradient(shape, n)));
    Lanes strain = volumetric(change).strain;
    if (has_flowed(&memory->yield[lane_count * std::size_t(b)])) {
      const auto* plastic = reinterpret_cast<const Lanes*>(&memory->plastic[plastic_index(std::size_t(b), 0)]);
      strain -= plastic[row_volume];
    }
    const Lanes part = fill->law_of(std::size_t(b)).bulk * (1.0 / 6.0) * shape.volume6 * strain;
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
    for (auto b = std::size_t(t.first_batch); b < end; ++b) batch_stresses<count>(*this, b, end, found);
  });
  double* lost = &memory->lost[4 * tile];
  lost[0] += sum_of(found.dissipated);
  lost[1] += sum_of(found.work);
  if (energies) energies[tile] = {sum_of(found.elastic), sum_of(found.springs)};
  return found.report;
}

}  // namespace voussoir
