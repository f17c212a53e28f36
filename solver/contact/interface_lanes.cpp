// Eight patches between stones and fill at a time, point by point.
#include "solver/contact/lane_points.h"
#include "solver/model/with_branches.h"

namespace voussoir {

namespace {

using Vector = Triple<Lanes>;

/// What an affine jump displaces at a point of the patch.
template <class L>
struct AffineField {
  Triple<L> middle, along_s, along_t;
  [[gnu::always_inline]] Triple<L> at(L s, L t) const {
    return {middle.x + s * along_s.x + t * along_t.x, middle.y + s * along_s.y + t * along_t.y,
            middle.z + s * along_s.z + t * along_t.z};
  }
  template <class Side>
  [[gnu::always_inline]] AffineField<typename Side::Numbers> part() const {
    const auto of = [](const Triple<L>& v) {
      return Triple<typename Side::Numbers>{Side::of(v.x), Side::of(v.y), Side::of(v.z)};
    };
    return {of(middle), of(along_s), of(along_t)};
  }
};

/// What two corners of each triangle have moved.
[[gnu::always_inline]] inline void node_moves(const double* pose, const std::int32_t* first, const std::int32_t* second,
                                              Vector& a, Vector& b) {
  Lanes rows[lane_count];
  for (int lane = 0; lane < lane_count; ++lane) {
    const Quad p = load_quad(pose + node_width * std::size_t(first[lane]));
    const Quad q = load_quad(pose + node_width * std::size_t(second[lane]));
    rows[lane] = pair(p, q);
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
    add(b.sum[0][lane], low(two[lane]));
    add(b.sum[1][lane], high(two[lane]));
    add(b.sum[2][lane], low(one[lane]));
  }
}

/// N_k = n[k][0] + n[k][1] s + n[k][2] t over the triangles, see shape_functions().
struct ShapeFunctions {
  Lanes n[3][3];
  [[gnu::always_inline]] explicit ShapeFunctions(const InterfaceBatch& b) {
    const Lanes *o = b.rest[0], *p = b.rest[1], *q = b.rest[2];
    const Lanes ps = p[1] - o[1], pt = p[2] - o[2], qs = q[1] - o[1], qt = q[2] - o[2];
    const Lanes by = 1.0 / (ps * qt - pt * qs);
    n[1][1] = by * qt, n[1][2] = -by * qs;
    n[2][1] = -by * pt, n[2][2] = by * ps;
    for (int k = 1; k < 3; ++k) n[k][0] = -(n[k][1] * o[1] + n[k][2] * o[2]);
    n[0][0] = 1.0 - n[1][0] - n[2][0];
    for (int c = 1; c < 3; ++c) n[0][c] = -n[1][c] - n[2][c];
  }
  /// Σ n[k][c] d_k: what is displaced in the middle (c = 0), and its slopes.
  [[gnu::always_inline]] Vector combine(const Vector (&d)[3], int c) const {
    return n[0][c] * d[0] + n[1][c] * d[1] + n[2][c] * d[2];
  }
};

/// The four points of moment_points(): two, and two opposite.
struct MomentRows {
  const InterfaceBatch& batch;
  Lanes area() const { return batch.patch.area; }
  template <class Side>
  [[gnu::always_inline]] void each(const auto& jump, const auto& change, const auto& visit) const {
    using L = typename Side::Numbers;
    for (int i = 0; i < batch.patch.points; ++i) {
      const L s = Side::of(batch.point[i % 2][0]), t = Side::of(batch.point[i % 2][1]);
      const RowPlace<L> at = {i < 2 ? s : -s, i < 2 ? t : -t, Side::splat(0.25)};
      visit(i, at, jump.at(at.s, at.t), change.at(at.s, at.t));
    }
  }
};

/// A batch lies in several arrays: what those after batch k have there is asked for while it is computed, a part at a
/// time (see fetch()); points are asked for row by row.
struct InterfaceAhead {
  const State& state;
  std::size_t k;

  [[gnu::always_inline]] bool any() const { return k + 2 < state.interface.batches.size(); }
  /// Of the batch after the next, in three parts.
  [[gnu::always_inline]] void constants(std::size_t part) const {
    if (any()) fetch_part<3>(state.interface.batches[k + 2], part);
  }
  [[gnu::always_inline]] void last_jumps() const {
    if (any()) fetch(&state.interface_memory.last[9 * lane_count * (k + 2)], 9 * sizeof(Singles));
  }
  /// Of the next batch, which by then has been asked for itself.
  [[gnu::always_inline]] void stones() const {
    if (any()) fetch_poses(state.pose.data(), state.interface.batches[k + 1].patch.pose_a);
  }
  [[gnu::always_inline]] void nodes() const {
    if (!any()) return;
    for (const auto& corner : state.interface.batches[k + 1].node)
      for (const std::int32_t node : corner) fetch(&state.fill.pose[node_width * std::size_t(node)], sizeof(Quad));
  }
};

/// True where a patch has slid past the limit at which it is clipped anew.
template <int count>
bool batch_of(const PatchPass& pass, std::size_t k, TileEnergy* energy) {
  State& state = *pass.state;
  const InterfaceBatch& b = state.interface.batches[k];
  PatchMemory& memory = state.interface_memory;
  const LaneMask used = LaneMask::first(b.patch.count) & less(splat(0.0), b.patch.area);

  const InterfaceAhead ahead{state, k};
  ahead.nodes();
  // 1. what the corners have moved in the stone's axes
  const LanePoses stone = gather(state.pose.data(), b.patch.pose_a);
  const Axes<Lanes> axes = axes_of(stone.q * Quat<Lanes>{b.patch.frame[0], load(b.patch.frame + 1)}, splat(2.0));
  const Vector origin = stone.u + turn_change(stone.q, load(b.patch.arm_a));
  Vector u[3], reach[3], moved[3];
  node_moves(state.fill.pose.data(), b.node[0], b.node[1], u[0], u[1]);
  node_moves(state.fill.pose.data(), b.node[2], b.node[2], u[2], u[2]);
  for (int i = 0; i < 3; ++i) {
    reach[i] = load(b.lever[i]) + u[i];
    moved[i] = turn_back(axes, reach[i] - origin) - load(b.rest[i]);
  }
  ahead.constants(0);
  const ShapeFunctions shape(b);
  const AffineField<Lanes> jump = {shape.combine(moved, 0), shape.combine(moved, 1), shape.combine(moved, 2)};
  AffineField<Lanes> change = jump;
  auto* last = reinterpret_cast<Singles*>(&memory.last[9 * lane_count * k]);
  for (Vector* part : {&change.middle, &change.along_s, &change.along_t}) {
    Lanes* now = &part->x;
    for (int c = 0; c < 3; ++c, ++last) {
      const Singles rounded = narrow(now[c]);
      now[c] = widen(rounded) - widen(*last);
      *last = rounded;
    }
  }

  ahead.constants(1);
  // 2. tractions
  const LaneStrength law = strengths(*pass.model, b.patch);
  const PointsTask<count, AffineField<Lanes>> task = {b.patch, law,        pass.branches,     jump,  change,
                                                      used,    LaneMask{}, energy != nullptr, memory};
  const LanePoints found = pass_points<false>(task, MomentRows{b});
  ahead.constants(2);
  note_points(found, used, k, memory);
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
    const Vector pull = turn(axes, shape.n[i][0] * sum + shape.n[i][1] * first_s + shape.n[i][2] * first_t);
    force = force + pull;
    moment = moment + cross(place + reach[i], pull);
    pushes[i] = {-pull.x, -pull.y, -pull.z};
  }
  ahead.last_jumps();
  ahead.stones();
  add_forces(pushes, b, pass.interface_forces);
  store_wrenches(force, moment, pass.interface_wrenches + wrench_width * lane_count * k);

  const Lanes slid2 = jump.middle.y * jump.middle.y + jump.middle.z * jump.middle.z;
  return any(used & less(SlidingLimits(*pass.model).slip_limit2(b.patch.area), slid2));
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
      reclip |= batch_of<count>(*this, k, energy);
    }
    return reclip;
  });
}

}  // namespace voussoir
