#include "solver/contact/pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "geometry/neighbours.h"
#include "solver/base/parallel.h"
#include "solver/contact/lane_patches.h"
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

/// The numbers below `count` that `look` adds for its range, in order.
template <class Look>
std::vector<std::size_t> found_in_order(std::size_t count, int threads, std::size_t least_per_thread,
                                        const Look& look) {
  std::vector<std::vector<std::size_t>> found(std::size_t(std::max(1, threads)));
  share_out(count, threads, least_per_thread,
            [&](int thread, Range range) { look(range, found[std::size_t(thread)]); });
  std::vector<std::size_t> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end());
  return all;
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

/// Cells of a coarse grid near which there is some box: a quick no for nearly all bodies where boxes are few.
class NearMask {
 public:
  /// Spheres of this radius (m) or less are asked for, and may come within `distance` (m) of a box.
  NearMask(const std::vector<Box>& boxes, double radius, double distance) : width_(2.0 * radius), near_(places, 0) {
    for (const Box& box : boxes) {
      const Vec3 from = box.low.array() - (radius + distance), to = box.high.array() + (radius + distance);
      if (!(((to - from) / width_).array().ceil().prod() < double(places))) {
        near_.assign(places, 1);
        return;
      }
      const Cell low = cell_of(from), high = cell_of(to);
      for (std::int64_t x = low[0]; x <= high[0]; ++x)
        for (std::int64_t y = low[1]; y <= high[1]; ++y)
          for (std::int64_t z = low[2]; z <= high[2]; ++z) near_[place_of({x, y, z})] = 1;
    }
  }
  bool may_meet(const Vec3& centre) const { return near_[place_of(cell_of(centre))]; }

 private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr std::size_t places = 1 << 14;  // shared by cells (hash of Teschner et al. 2003)
  Cell cell_of(const Vec3& x) const {
    Cell cell;
    for (int c = 0; c < 3; ++c) cell[std::size_t(c)] = std::int64_t(std::floor(x[c] / width_));
    return cell;
  }
  static std::size_t place_of(const Cell& c) {
    return (std::size_t(c[0]) * 73856093u ^ std::size_t(c[1]) * 19349663u ^ std::size_t(c[2]) * 83492791u) % places;
  }

  double width_;
  std::vector<char> near_;
};

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
    const std::vector<Box> boxes = boxes_of(cells);
    const BoxIndex index(boxes, distance);
    const double usual = 1.5 * model.typical_size;  // radius; of most blocks 0.9
    const NearMask mask(boxes, usual, distance);
    share_out(std::size_t(bodies), threads, 500, [&](int thread, Range range) {
      std::vector<CellBox> own;
      std::vector<int> near;
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const float* p = &state.listed[searched_width * i];
        const Vec3 centre = model.bodies[i].centroid + Vec3(p[0], p[1], p[2]);
        const double radius = 1.000001 * model.bodies[i].radius, reach = radius + distance;
        if (radius <= usual && !mask.may_meet(centre)) continue;
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

template <class T>
struct RelativePlace {
  Triple<T> centre;  // m
  Quat<T> turn;
};
/// `apart`: from the centroid of the one to that of the other as built; both have moved by u and turned by q since.
template <class T>
RelativePlace<T> relative_place(const Triple<T>& apart, const Triple<T>& u_frame, const Quat<T>& q_frame,
                                const Triple<T>& u_moving, const Quat<T>& q_moving) {
  return {turn_back(q_frame, apart + (u_moving - u_frame)),
          Quat<T>{q_frame.w, {-q_frame.v.x, -q_frame.v.y, -q_frame.v.z}} * q_moving};
}

Vec3 apart_as_built(const Model& model, const Sides& s) {
  return model.bodies[std::size_t(s.moving)].centroid - model.bodies[std::size_t(s.frame)].centroid;
}

/// How far any point of the moving body has come in the frame's since each of eight pairs was examined, and how far it
/// may: upper bounds, m.
struct PairMotion {
  Lanes moved, allowed;
};
PairMotion motion_since_examined(const Model& model, const State& state, const std::size_t* pairs) {
  std::int32_t frame[lane_count], moving[lane_count];
  Lanes seen[lane_count], radius;
  Triple<Lanes> apart;
  for (int lane = 0; lane < lane_count; ++lane) {
    const std::int32_t* cells = &state.pair_cells[4 * pairs[lane]];
    const Sides s = sides(model, cells[0], cells[1]);
    frame[lane] = pose_width * s.frame, moving[lane] = pose_width * s.moving;
    const Vec3 d = apart_as_built(model, s);
    apart.x[lane] = d.x(), apart.y[lane] = d.y(), apart.z[lane] = d.z();
    radius[lane] = model.bodies[std::size_t(s.moving)].radius;
    seen[lane] = widen(*reinterpret_cast<const Singles*>(&state.pair_seen[searched_width * pairs[lane]]));
  }
  transpose(seen);
  const LanePoses f = gather(state.pose.data(), frame), m = gather(state.pose.data(), moving);
  const RelativePlace<Lanes> now = relative_place(apart, f.u, f.q, m.u, m.q);
  const Triple<Lanes> d = now.centre - Triple<Lanes>{seen[0], seen[1], seen[2]};
  const Lanes turn[4] = {now.turn.w, now.turn.v.x, now.turn.v.y, now.turn.v.z};
  Lanes same = splat(0.0), other = splat(0.0);  // a quaternion and its negative are the same turn
  for (int c = 0; c < 4; ++c) {
    same += (turn[c] - seen[3 + c]) * (turn[c] - seen[3 + c]);
    other += (turn[c] + seen[3 + c]) * (turn[c] + seen[3 + c]);
  }
  const Lanes turned = square_root(select(less(same, other), same, other));
  return {square_root(dot(d, d)) + quaternion_reach * turned * radius, seen[7]};
}

}  // namespace

bool past_list(const Model& model, const State& state, std::size_t body) {
  return moved_since(model, state, state.listed, body, state.base_displacement()) > list_distance * skin(model);
}

namespace {

/// What becomes of a list when some of its pairs leave and others come in.
struct ListChange {
  std::vector<std::size_t> removed;  // places, in order
  std::vector<CellPair> added;       // in order
  std::vector<std::size_t> before;   // for each of these the place of the listed pair that it precedes
};

/// The places of all pairs of stale bodies.
std::vector<std::size_t> stale_places(const State& state, const std::vector<char>& stale, int threads) {
  constexpr std::size_t least_pairs_per_thread = 20000;
  return found_in_order(pair_count(state), threads, least_pairs_per_thread, [&](Range range, auto& found) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (stale[std::size_t(state.pair_cells[4 * i])] || stale[std::size_t(state.pair_cells[4 * i + 1])])
        found.push_back(i);
  });
}

/// The pairs of stale bodies are to be `fresh`, sorted like the list.
ListChange find_change(const State& state, const std::vector<std::size_t>& listed, const std::vector<CellPair>& fresh) {
  ListChange change;
  auto at = listed.begin();
  const auto remove_before = [&](const CellPair& cells) {
    for (; at != listed.end() && cells_at(state, *at) < cells; ++at) change.removed.push_back(*at);
  };
  for (const CellPair& cells : fresh) {
    remove_before(cells);
    if (at != listed.end() && cells_at(state, *at) == cells) {
      ++at;  // what it knows is kept
    } else {
      change.added.push_back(cells);
      change.before.push_back(lower_bound_pair(state, cells, pair_count(state)));
    }
  }
  change.removed.insert(change.removed.end(), at, listed.end());
  return change;
}

/// Pairs begin … end go to `to`.
struct BlockMove {
  std::size_t begin, end, to;
};

/// What stays, in pieces between what leaves and what comes in.
std::vector<BlockMove> moves_of(const ListChange& change, std::size_t count) {
  std::vector<BlockMove> moves;
  std::size_t begin = 0, to = 0, added = 0, removed = 0;
  const auto stay_until = [&](std::size_t end) {
    if (end > begin) moves.push_back({begin, end, to}), to += end - begin;
    begin = end;
  };
  while (added < change.added.size() || removed < change.removed.size()) {
    const std::size_t next_in = added < change.added.size() ? change.before[added] : count;
    const std::size_t next_out = removed < change.removed.size() ? change.removed[removed] : count;
    stay_until(std::min(next_in, next_out));
    if (next_in <= next_out)
      ++to, ++added;
    else
      ++begin, ++removed;
  }
  stay_until(count);
  return moves;
}

template <class T>
void move_block(std::size_t width, const BlockMove& m, Array<T>& list) {
  std::memmove(&list[width * m.to], &list[width * m.begin], width * (m.end - m.begin) * sizeof(T));
}

/// In place: the list has megabytes, and few pairs change. Pieces that go down one after the other from the first on,
/// then those that go up from the last on: none overwrites what has still to move.
void apply_change(State& state, const ListChange& change) {
  const std::size_t count = pair_count(state), next = count + change.added.size() - change.removed.size();
  const std::vector<BlockMove> moves = moves_of(change, count);
  state.pair_cells.resize(4 * std::max(count, next)), state.pair_seen.resize(searched_width * std::max(count, next));
  const auto move = [&](const BlockMove& m) {
    move_block(4, m, state.pair_cells), move_block(searched_width, m, state.pair_seen);
  };
  for (auto m = moves.begin(); m != moves.end(); ++m)
    if (m->to < m->begin) move(*m);
  for (auto m = moves.rbegin(); m != moves.rend(); ++m)
    if (m->to > m->begin) move(*m);
  state.pair_cells.resize(4 * next), state.pair_seen.resize(searched_width * next);
  constexpr float unseen[searched_width] = {0, 0, 0, 1, 0, 0, 0, pair_is_new};
  auto removed = change.removed.begin();
  for (std::size_t i = 0; i < change.added.size(); ++i) {
    while (removed != change.removed.end() && *removed < change.before[i]) ++removed;
    const std::size_t to = change.before[i] + i - std::size_t(removed - change.removed.begin());
    std::copy(change.added[i].begin(), change.added[i].end(), &state.pair_cells[4 * to]);
    std::copy(unseen, unseen + searched_width, &state.pair_seen[searched_width * to]);
  }
}

}  // namespace

void list_pairs(const Model& model, State& state, const std::vector<char>& stale, int threads) {
  for (std::size_t i = 0; i < stale.size(); ++i)
    if (stale[i]) note_place(state, i, state.listed);
  const std::vector<CellPair> fresh = near_pairs(model, state, stale, threads);
  apply_change(state, find_change(state, stale_places(state, stale, threads), fresh));
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
  return found_in_order(pair_count(state), threads, least_pairs_per_thread, [&](Range range, auto& found) {
    std::size_t asked[lane_count];
    int count = 0;
    const auto ask = [&] {
      for (int lane = count; lane < lane_count; ++lane) asked[lane] = asked[0];
      const PairMotion motion = motion_since_examined(model, state, asked);
      const LaneMask due = less(motion.allowed, motion.moved) & LaneMask::first(count);
      for (int lane = 0; any(due) && lane < count; ++lane)
        if (due[lane]) found.push_back(asked[lane]);
      count = 0;
    };
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const bool moves = moved[std::size_t(state.pair_cells[4 * i])] || moved[std::size_t(state.pair_cells[4 * i + 1])];
      if (!moves || state.pair_seen[searched_width * i + 7] >= pair_has_contact) continue;
      asked[count++] = i;
      if (count == lane_count) ask();
    }
    if (count > 0) ask();
  });
}

void note_examined(const Model& model, State& state, std::size_t pair, double allowed) {
  const CellPair c = cells_at(state, pair);
  const Sides s = sides(model, c[0], c[1]);
  const Vec3 d = apart_as_built(model, s);
  const double *f = &state.pose[pose_width * std::size_t(s.frame)],
               *m = &state.pose[pose_width * std::size_t(s.moving)];
  const RelativePlace<double> now =
      relative_place<double>({d.x(), d.y(), d.z()}, {f[0], f[1], f[2]}, {f[3], {f[4], f[5], f[6]}}, {m[0], m[1], m[2]},
                             {m[3], {m[4], m[5], m[6]}});
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
