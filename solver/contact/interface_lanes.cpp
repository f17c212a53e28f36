// Eight patches between stones and fill at a time, point by point.
#include "solver/contact/lane_points.h"
#include "solver/model/with_branches.h"

namespace voussoir {

namespace {

using Vector = Triple<Lanes>;

/// What an affine jump displaces at a point of the patch.
struct AffineField {
  Vector middle, along_s, along_t;
  [[gnu::always_inline]] Vector at(Lanes s, Lanes t) const {
    return {middle.x + s * along_s.x + t * along_t.x, middle.y + s * along_s.y + t * along_t.y,
            middle.z + s * along_s.z + t * along_t.z};
  }
};

[[gnu::always_inline]] inline Quad load_quad(const double* from) {
  Quad q;
  std::memcpy(&q, from, sizeof(q));
  return q;
}

/// What two corners of each triangle have moved.
[[gnu::always_inline]] inline void node_moves(const double* pose, const std::int32_t* first, const std::int32_t* second,
                                              Vector& a, Vector& b) {
  Lanes rows[lane_count];
  for (int lane = 0; lane < lane_count; ++lane) {
    const Quad p = load_quad(pose + node_width * std::size_t(first[lane]));
    const Quad q = load_quad(pose + node_width * std::size_t(second[lane]));
    rows[lane] = __builtin_shufflevector(p, q, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  transpose(rows);
  a = {rows[0], rows[1], rows[2]}, b = {rows[4], rows[5], rows[6]};
}

/// Adds the forces on the corners of each patch to the tile's sums.
[[gnu::always_inline]] inline void add_forces(const Vector (&f)[3], const InterfaceBatch& b, double* sums) {
  const Lanes zero{};
  Lanes two[lane_count] = {f[0].x, f[0].y, f[0].z, zero, f[1].x, f[1].y, f[1].z, zero};
  Lanes one[lane_count] = {f[2].x, f[2].y, f[2].z, zero, zero, zero, zero, zero};
  transpose(two);
  transpose(one);
  const auto add = [sums](std::int32_t at, const Quad& force) {
    double* sum = sums + node_width * std::size_t(at);
    const Quad now = load_quad(sum) + force;
    std::memcpy(sum, &now, sizeof(now));
  };
  for (int lane = 0; lane < b.patch.count; ++lane) {
    add(b.sum[0][lane], __builtin_shufflevector(two[lane], two[lane], 0, 1, 2, 3));
    add(b.sum[1][lane], __builtin_shufflevector(two[lane], two[lane], 4, 5, 6, 7));
    add(b.sum[2][lane], __builtin_shufflevector(one[lane], one[lane], 0, 1, 2, 3));
  }
}

/// Σ shape[k][c] d_k: the jump in the middle (c = 0), and its slopes.
[[gnu::always_inline]] inline Vector combine(const InterfaceBatch& b, const Vector (&d)[3], int c) {
  return b.shape[0][c] * d[0] + b.shape[1][c] * d[1] + b.shape[2][c] * d[2];
}

/// A batch lies in several arrays: what the next one has there is asked for before it is needed.
template <int count>
void fetch_next(const State& state, std::size_t k) {
  const InterfaceBatch* b = &state.interface.batches[k];
  const PatchMemory& memory = state.interface_memory;
  const auto row = std::size_t(b->patch.first_point + b->patch.points), rows = std::size_t(b->patch.points);
  fetch(b + 1, sizeof(InterfaceBatch));
  fetch(&state.interface.points[3 * lane_count * row], 3 * rows * sizeof(Lanes));
  fetch(&memory.point[2 * lane_count * row], 2 * rows * sizeof(Lanes));
  fetch(&memory.last[9 * lane_count * (k + 1)], 9 * sizeof(Singles));
  if constexpr (count > 0)
    fetch(&memory.point_branch[3 * count * lane_count * row], 3 * count * rows * sizeof(Singles));
}

/// True where a patch has slid past the limit at which it is clipped anew.
template <int count>
bool batch_of(const PatchPass& pass, std::size_t k, TileEnergy* energy) {
  State& state = *pass.state;
  const InterfaceBatch& b = state.interface.batches[k];
  PatchMemory& memory = state.interface_memory;
  const LaneMask used = LaneMask::first(b.patch.count) & less(splat(0.0), b.patch.area);

  // 1. what the corners have moved in the stone's axes
  const LanePoses stone = gather(state.pose.data(), b.patch.a);
  const Quat<Lanes> frame = stone.q * Quat<Lanes>{b.patch.frame[0], load(b.patch.frame + 1)};
  const Vector origin = stone.u + turn_change(stone.q, load(b.patch.arm_a));
  Vector u[3], reach[3], moved[3];
  node_moves(state.fill.pose.data(), b.node[0], b.node[1], u[0], u[1]);
  node_moves(state.fill.pose.data(), b.node[2], b.node[2], u[2], u[2]);
  for (int i = 0; i < 3; ++i) {
    reach[i] = load(b.lever[i]) + u[i];
    moved[i] = turn_back(frame, reach[i] - origin) - load(b.rest[i]);
  }
  const AffineField jump = {combine(b, moved, 0), combine(b, moved, 1), combine(b, moved, 2)};
  AffineField change = jump;
  auto* last = reinterpret_cast<Singles*>(&memory.last[9 * lane_count * k]);
  for (Vector* part : {&change.middle, &change.along_s, &change.along_t}) {
    Lanes* now = &part->x;
    for (int c = 0; c < 3; ++c, ++last) {
      const Singles rounded = narrow(now[c]);
      now[c] = widen(rounded) - widen(*last);
      *last = rounded;
    }
  }

  // 2. tractions
  const PointRows rows(pass.model->rule, state.interface.points, b.patch);
  PointsPass<count, false, AffineField> points(b.patch, strengths(*pass.model, b.patch), jump, pass.branches, used,
                                               LaneMask{}, change, energy != nullptr, memory);
  const LanePoints found = points.run(rows);
  note_points(found, used, b.patch.count, lane_count * k, memory);
  if (energy) {
    energy->elastic += sum_of(select(used, found.elastic, splat(0.0)));
    energy->branches += sum_of(select(used, found.stored, splat(0.0)));
  }

  // 3. forces on the corners; their opposite, where the corners are, on the stone
  const Resultant<Lanes>& q = found.resultant;
  const Vector sum = {q.n, q.s, q.t}, first_s = {q.sn, q.ss, q.st}, first_t = {q.tn, q.ts, q.tt};
  const Vector place = load(b.patch.place);
  Vector force = {Lanes{}, Lanes{}, Lanes{}}, moment = force, pushes[3];
  for (int i = 0; i < 3; ++i) {
    const Vector pull = turn(frame, b.shape[i][0] * sum + b.shape[i][1] * first_s + b.shape[i][2] * first_t);
    force = force + pull;
    moment = moment + cross(place + reach[i], pull);
    pushes[i] = {-pull.x, -pull.y, -pull.z};
  }
  add_forces(pushes, b, pass.interface_forces);
  store_wrenches(force, moment, pass.interface_wrenches + wrench_width * lane_count * k);

  const Lanes slid2 = jump.middle.y * jump.middle.y + jump.middle.z * jump.middle.z;
  return any(used & less(pass.model->slip_limit2(b.patch.area), slid2));
}

}  // namespace

bool PatchPass::interface(std::size_t tile) const {
  const std::vector<std::int32_t>& first = state->interface.first_batch;
  const std::vector<std::int32_t>& first_sum = state->interface.first_sum;
  std::fill(interface_forces + node_width * std::size_t(first_sum[tile]),
            interface_forces + node_width * std::size_t(first_sum[tile + 1]), 0.0);
  TileEnergy* energy = energies ? &energies[tile] : nullptr;
  return with_branches(branches.count, [&](auto count) {
    bool reclip = false;
    const auto end = std::size_t(first[tile + 1]);
    for (auto k = std::size_t(first[tile]); k < end; ++k) {
      if (k + 1 < end) fetch_next<count>(*state, k);
      reclip |= batch_of<count>(*this, k, energy);
    }
    return reclip;
  });
}

}  // namespace voussoir
