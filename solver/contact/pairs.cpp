#include "solver/contact/pairs.h"

#include <algorithm>

#include "geometry/neighbours.h"
#include "solver/base/parallel.h"
#include "solver/contact/search.h"

namespace voussoir {

namespace {

std::size_t pair_count(const State& state) {
  return state.pair_cells.size() / 4;
}

CellPair cells_at(const State& state, std::size_t pair) {
  const std::int32_t* c = &state.pair_cells[4 * pair];
  return {c[0], c[1], c[2], c[3]};
}

/// The first of the first `count` listed pairs that is not before these cells.
std::size_t lower_bound_pair(const State& state, const CellPair& cells, std::size_t count) {
  std::size_t low = 0, high = count;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (cells_at(state, middle) < cells)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/// Where a body's pairs were listed: displacement and quaternion.
struct Place {
  Vec3 centre;
  Mat3 turn;
};
Place listed_place(const Model& model, const State& state, std::int32_t body) {
  const float* p = &state.listed[searched_width * std::size_t(body)];
  const Eigen::Quaterniond q = Eigen::Quaterniond(p[3], p[4], p[5], p[6]).normalized();
  return {model.bodies[std::size_t(body)].centroid + Vec3(p[0], p[1], p[2]), q.toRotationMatrix()};
}

/// A cell where its body was listed.
struct CellBox {
  std::int32_t body = 0, cell = 0;
  Box box;
};

void place_cells(const Model& model, const State& state, std::int32_t body, std::vector<CellBox>& cells) {
  const Place place = listed_place(model, state, body);
  const Vec3& centroid = model.bodies[std::size_t(body)].centroid;
  for (const Convex& cell : model.cells[std::size_t(body)]) {
    CellBox c;
    c.body = body, c.cell = std::int32_t(&cell - model.cells[std::size_t(body)].data());
    for (const Vec3& v : cell.vertices) {
      const Vec3 x = place.centre + place.turn * (v - centroid);
      c.box.low = c.box.low.cwiseMin(x), c.box.high = c.box.high.cwiseMax(x);
    }
    cells.push_back(c);
  }
}

bool boxes_meet(const Box& a, const Box& b, double distance) {
  return (a.low.array() - distance <= b.high.array()).all() && (b.low.array() - distance <= a.high.array()).all();
}

/// Whether joint `index` of the assembly is still one.
bool lives(const Model& model, const State& state, std::int32_t index) {
  return !(state.joint.mode[std::size_t(model.joint_places[std::size_t(index)].now)] & mode_gone);
}

bool has_live_joint(const Model& model, const State& state, const CellPair& cells) {
  auto at =
      std::lower_bound(model.joint_by_cells.begin(), model.joint_by_cells.end(), std::pair(cells, std::int32_t(0)));
  for (; at != model.joint_by_cells.end() && at->first == cells; ++at)
    if (lives(model, state, at->second)) return true;
  return false;
}

std::vector<Box> boxes_of(const std::vector<CellBox>& cells) {
  std::vector<Box> boxes;
  for (const CellBox& c : cells) boxes.push_back(c.box);
  return boxes;
}

/// Pairs of cells of different bodies, one of them stale and one of them free, whose boxes come near; sorted.
std::vector<CellPair> near_pairs(const Model& model, const State& state, const std::vector<char>& stale, int threads) {
  const double distance = list_margin * skin(model);
  std::vector<std::vector<CellPair>> found(std::size_t(std::max(1, threads)));
  const auto consider = [&](const CellBox& p, const CellBox& q, std::vector<CellPair>& pairs) {
    const std::int32_t a = p.body, b = q.body;
    if (a == b || !(stale[std::size_t(a)] || stale[std::size_t(b)])) return;
    if (model.bodies[std::size_t(a)].still() && model.bodies[std::size_t(b)].still()) return;
    if (state.lost(std::size_t(a)) || state.lost(std::size_t(b))) return;
    const CellPair cells = a < b ? CellPair{a, b, p.cell, q.cell} : CellPair{b, a, q.cell, p.cell};
    if (!has_live_joint(model, state, cells)) pairs.push_back(cells);
  };
  const auto bodies = std::int32_t(model.bodies.size());
  std::vector<CellBox> cells;
  if (std::count(stale.begin(), stale.end(), 1) < bodies / 4) {
    for (std::int32_t i = 0; i < bodies; ++i)
      if (stale[std::size_t(i)] && !state.lost(std::size_t(i))) place_cells(model, state, i, cells);
    const BoxIndex index(boxes_of(cells), distance);
    share_out(std::size_t(bodies), threads, 500, [&](int thread, Range range) {
      std::vector<CellBox> own;
      std::vector<int> near;
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const float* p = &state.listed[searched_width * i];
        const Vec3 centre = model.bodies[i].centroid + Vec3(p[0], p[1], p[2]);
        const double radius = 1.000001 * model.bodies[i].radius, reach = radius + distance;
        own.clear();
        index.near({centre.array() - radius, centre.array() + radius}, near);
        for (const int k : near) {
          const CellBox& c = cells[std::size_t(k)];
          if ((centre.cwiseMax(c.box.low).cwiseMin(c.box.high) - centre).squaredNorm() > reach * reach) continue;
          if (own.empty()) place_cells(model, state, std::int32_t(i), own);
          for (const CellBox& q : own)
            if (boxes_meet(c.box, q.box, distance)) consider(c, q, found[std::size_t(thread)]);
        }
      }
    });
  } else {
    for (std::int32_t i = 0; i < bodies; ++i) place_cells(model, state, i, cells);
    for (const auto& [i, j] : neighbours(boxes_of(cells), distance))
      consider(cells[std::size_t(i)], cells[std::size_t(j)], found.front());
  }
  std::vector<CellPair> pairs;
  for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// The bodies of a pair: its placement is that of `moving` in the frame of `frame`, the larger one, whose turning then
/// counts for no more than the smaller one's reach.
struct Sides {
  std::int32_t frame, moving;
};
Sides sides(const Model& model, std::int32_t a, std::int32_t b) {
  return model.bodies[std::size_t(a)].radius >= model.bodies[std::size_t(b)].radius ? Sides{a, b} : Sides{b, a};
}

struct RelativePlace {
  Triple<double> centre;  // m
  Quat<double> turn;
};
RelativePlace relative_place(const Model& model, const State& state, const Sides& s) {
  const double *pf = &state.pose[pose_width * std::size_t(s.frame)],
               *pm = &state.pose[pose_width * std::size_t(s.moving)];
  const Vec3 &xf = model.bodies[std::size_t(s.frame)].centroid, &xm = model.bodies[std::size_t(s.moving)].centroid;
  const Quat<double> qf = {pf[3], {pf[4], pf[5], pf[6]}}, qm = {pm[3], {pm[4], pm[5], pm[6]}};
  const Triple<double> d = {xm.x() - xf.x() + (pm[0] - pf[0]), xm.y() - xf.y() + (pm[1] - pf[1]),
                            xm.z() - xf.z() + (pm[2] - pf[2])};
  return {turn_back(qf, d), Quat<double>{qf.w, {-qf.v.x, -qf.v.y, -qf.v.z}} * qm};
}

/// How far any point of the moving body has come in the frame's since the pair was examined: an upper bound, m.
double moved_since_examined(const Model& model, const State& state, const Sides& s, const float* seen) {
  const RelativePlace now = relative_place(model, state, s);
  const double d[3] = {now.centre.x - seen[0], now.centre.y - seen[1], now.centre.z - seen[2]};
  const double q[4] = {now.turn.w, now.turn.v.x, now.turn.v.y, now.turn.v.z};
  double same = 0.0, other = 0.0;  // a quaternion and its negative are the same turn
  for (int c = 0; c < 4; ++c) {
    same += (q[c] - seen[3 + c]) * (q[c] - seen[3 + c]);
    other += (q[c] + seen[3 + c]) * (q[c] + seen[3 + c]);
  }
  return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) +
         quaternion_reach * std::sqrt(std::min(same, other)) * model.bodies[std::size_t(s.moving)].radius;
}

}  // namespace

bool past_list(const Model& model, const State& state, std::size_t body) {
  return moved_since(model, state, state.listed, body, state.base_displacement()) > list_distance * skin(model);
}

namespace {

void put_pair(State& state, std::size_t to, const CellPair& cells, const float* seen) {
  std::copy(cells.begin(), cells.end(), &state.pair_cells[4 * to]);
  std::copy(seen, seen + searched_width, &state.pair_seen[searched_width * to]);
}
void move_pair(State& state, std::size_t from, std::size_t to) {
  if (from == to) return;
  put_pair(state, to, cells_at(state, from), &state.pair_seen[searched_width * from]);
}

/// The list without the pairs of stale bodies, and with fresh ones, sorted like it, in their places; what is known of a
/// fresh pair is kept. In place: the list has megabytes, and few pairs change.
void merge_pairs(State& state, const std::vector<char>& stale, const std::vector<CellPair>& fresh) {
  std::vector<CellPair> added;
  std::size_t kept = 0;
  auto next = fresh.begin();
  for (std::size_t i = 0; i < pair_count(state); ++i) {
    const CellPair here = cells_at(state, i);
    for (; next != fresh.end() && *next < here; ++next) added.push_back(*next);
    const bool known = next != fresh.end() && !(here < *next);
    if (known) ++next;
    if (known || !(stale[std::size_t(here[0])] || stale[std::size_t(here[1])])) move_pair(state, i, kept++);
  }
  added.insert(added.end(), next, fresh.end());
  constexpr float unseen[searched_width] = {0, 0, 0, 1, 0, 0, 0, pair_is_new};
  std::size_t to = kept + added.size();
  state.pair_cells.resize(4 * to), state.pair_seen.resize(searched_width * to);
  while (!added.empty()) {  // from the end
    --to;
    if (kept > 0 && added.back() < cells_at(state, kept - 1)) {
      move_pair(state, --kept, to);
    } else {
      put_pair(state, to, added.back(), unseen);
      added.pop_back();
    }
  }
}

}  // namespace

void list_pairs(const Model& model, State& state, const std::vector<char>& stale, int threads) {
  for (std::size_t i = 0; i < stale.size(); ++i)
    if (stale[i]) note_place(state, i, state.listed);
  merge_pairs(state, stale, near_pairs(model, state, stale, threads));
  for (std::size_t slot = 0; slot < state.contacts.size(); ++slot) {
    if (!state.has_contact(slot)) continue;
    const JointBatch& batch = state.contact_batches[slot / lane_count].patch;
    const std::size_t lane = slot % lane_count;
    if (!stale[std::size_t(batch.body_a(lane))] && !stale[std::size_t(batch.body_b(lane))]) continue;
    if (const auto pair = find_pair(state, cells_of(state.contacts[slot])))
      state.pair_seen[searched_width * *pair + 7] = pair_has_contact;
  }
}

std::vector<std::size_t> due_pairs(const Model& model, const State& state, const std::vector<char>& moved,
                                   int threads) {
  constexpr std::size_t least_pairs_per_thread = 3000;
  std::vector<std::vector<std::size_t>> found(std::size_t(std::max(1, threads)));
  share_out(pair_count(state), threads, least_pairs_per_thread, [&](int thread, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const std::int32_t a = state.pair_cells[4 * i], b = state.pair_cells[4 * i + 1];
      if (!(moved[std::size_t(a)] || moved[std::size_t(b)])) continue;
      const float* seen = &state.pair_seen[searched_width * i];
      if (seen[7] >= pair_has_contact) continue;
      if (seen[7] < 0.0f || moved_since_examined(model, state, sides(model, a, b), seen) > double(seen[7]))
        found[std::size_t(thread)].push_back(i);
    }
  });
  std::vector<std::size_t> due;
  for (const auto& part : found) due.insert(due.end(), part.begin(), part.end());
  std::sort(due.begin(), due.end());
  return due;
}

void note_examined(const Model& model, State& state, std::size_t pair, double allowed) {
  const CellPair c = cells_at(state, pair);
  const RelativePlace now = relative_place(model, state, sides(model, c[0], c[1]));
  const double row[8] = {now.centre.x, now.centre.y, now.centre.z, now.turn.w,
                         now.turn.v.x, now.turn.v.y, now.turn.v.z, allowed};
  for (int k = 0; k < 8; ++k) state.pair_seen[searched_width * pair + std::size_t(k)] = float(row[k]);
}

std::pair<std::size_t, std::size_t> pairs_of(const State& state, std::int32_t a, std::int32_t b) {
  const std::size_t n = pair_count(state);
  return {lower_bound_pair(state, {a, b, -1, -1}, n), lower_bound_pair(state, {a, b + 1, -1, -1}, n)};
}

std::optional<std::size_t> find_pair(const State& state, const CellPair& cells) {
  const std::size_t at = lower_bound_pair(state, cells, pair_count(state));
  if (at == pair_count(state) || cells_at(state, at) != cells) return std::nullopt;
  return at;
}

bool joined(const Model& model, const State& state, std::int32_t a, std::int32_t b) {
  auto at = std::lower_bound(model.joint_by_cells.begin(), model.joint_by_cells.end(),
                             std::pair(CellPair{a, b, -1, -1}, std::int32_t(0)));
  for (; at != model.joint_by_cells.end() && at->first[0] == a && at->first[1] == b; ++at)
    if (lives(model, state, at->second)) return true;
  const auto [begin, end] = pairs_of(state, a, b);
  for (std::size_t i = begin; i < end; ++i)
    if (state.pair_seen[searched_width * i + 7] >= pair_has_contact) return true;
  return false;
}

}  // namespace voussoir
