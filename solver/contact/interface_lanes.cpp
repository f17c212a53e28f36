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

[[gnu::always_inline]] inline Vector node_moves(const double* pose, const std::int32_t* nodes) {
  Lanes rows[lane_count];
  for (int lane = 0; lane < lane_count; ++lane) {
    Quad q;
    std::memcpy(&q, pose + node_width * std::size_t(nodes[lane]), sizeof(q));
    rows[lane] = __builtin_shufflevector(q, q, 0, 1, 2, 3, 0, 1, 2, 3);
  }
  transpose(rows);
  return {rows[0], rows[1], rows[2]};
}

[[gnu::always_inline]] inline void store_forces(const Vector& f, double* slots, int corner) {
  Lanes rows[lane_count] = {f.x, f.y, f.z, Lanes{}, Lanes{}, Lanes{}, Lanes{}, Lanes{}};
  transpose(rows);
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    std::memcpy(slots + node_width * (3 * lane + std::size_t(corner)), &rows[lane], sizeof(Quad));
}

[[gnu::always_inline]] inline LaneStrength strengths(const Model& model, const JointBatch& batch) {
  LaneStrength s{};
  for (int lane = 0; lane < lane_count; ++lane) {
    const LawConstants& law = model.laws[std::size_t(batch.law_of[lane])];
    const bool elastic = law.kind == JointLaw::Kind::elastic;
    s.tension[lane] = elastic ? 1e300 : law.tension;
    s.cohesion[lane] = elastic ? 1e300 : law.cohesion;
    s.tangent[lane] = elastic ? 0.0 : law.tan_friction;
    s.residual_cohesion[lane] = law.residual_cohesion;
    s.residual_tangent[lane] = law.residual_tan_friction;
    s.dilation[lane] = law.tan_dilation;
  }
  return s;
}

/// Σ shape[k][c] d_k: the jump in the middle (c = 0), and its slopes.
[[gnu::always_inline]] inline Vector combine(const InterfaceBatch& b, const Vector (&d)[3], int c) {
  return b.shape[0][c] * d[0] + b.shape[1][c] * d[1] + b.shape[2][c] * d[2];
}

/// True where a patch has slid past the limit at which it is clipped anew.
template <int count>
bool batch_of(const PatchPass& pass, std::size_t k, TileEnergy* energy) {
  State& state = *pass.state;
  const InterfaceBatch& b = state.interface.batches[k];
  PatchMemory& memory = state.interface_memory;
  const LaneMask used = LaneMask::first(b.patch.count);

  // 1. what the corners have moved in the stone's axes
  const LanePoses stone = gather(state.pose.data(), b.patch.a);
  const Quat<Lanes> frame = stone.q * Quat<Lanes>{b.patch.frame[0], load(b.patch.frame + 1)};
  const Vector origin = stone.u + turn_change(stone.q, load(b.patch.arm_a));
  Vector reach[3], moved[3];
  for (int i = 0; i < 3; ++i) {
    const Vector u = node_moves(state.fill.pose.data(), b.node[i]);
    reach[i] = load(b.lever[i]) + u;
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
  Vector force = {Lanes{}, Lanes{}, Lanes{}}, moment = force;
  double* slots = pass.interface_forces + 3 * node_width * lane_count * k;
  for (int i = 0; i < 3; ++i) {
    const Vector pull = turn(frame, b.shape[i][0] * sum + b.shape[i][1] * first_s + b.shape[i][2] * first_t);
    force = force + pull;
    moment = moment + cross(place + reach[i], pull);
    store_forces({-pull.x, -pull.y, -pull.z}, slots, i);
  }
  store_wrenches(force, moment, pass.interface_wrenches + wrench_width * lane_count * k);

  const Lanes slid2 = jump.middle.y * jump.middle.y + jump.middle.z * jump.middle.z;
  return any(used & less(pass.model->slip_limit2(b.patch.area), slid2));
}

}  // namespace

bool PatchPass::interface(std::size_t tile) const {
  const std::vector<std::int32_t>& first = state->interface.first_batch;
  TileEnergy* energy = energies ? &energies[tile] : nullptr;
  return with_branches(branches.count, [&](auto count) {
    bool reclip = false;
    for (auto k = std::size_t(first[tile]); k < std::size_t(first[tile + 1]); ++k)
      reclip |= batch_of<count>(*this, k, energy);
    return reclip;
  });
}

}  // namespace voussoir
