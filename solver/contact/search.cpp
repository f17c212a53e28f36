#include "solver/contact/search.h"

#include <algorithm>
#include <tuple>

#include "geometry/neighbours.h"
#include "solver/contact/make_contact.h"
#include "solver/step/energy.h"

namespace voussoir {

namespace {

using Key = std::tuple<std::int32_t, std::int32_t, std::int32_t, std::int32_t>;  // bodies in order, their cells

Key key_of(const Patch& p) {
  return p.a < p.b ? Key{p.a, p.b, p.cell_a, p.cell_b} : Key{p.b, p.a, p.cell_b, p.cell_a};
}

double skin(const Model& model) {
  return model.contact.skin * model.typical_size;
}

bool past_limits(const Model& model, const State& state, const Patch& p) {
  return past_limits(model, p, patch_jump(p, &state.pose[pose_width * p.a], &state.pose[pose_width * p.b]));
}

double least_gap(const State& state, const Patch& p, const Array<double>& points) {
  const Jump<double> j = patch_jump(p, &state.pose[pose_width * p.a], &state.pose[pose_width * p.b]);
  double least = 1e300;
  for (int i = 0; i < p.point_count; ++i) {
    const PatchPoint q = patch_point(p, points, i);
    least = std::min(least, point_jump(p, j, q.s, q.t).x);
  }
  return least;
}

struct MovedBodies {
  std::vector<char> flag;
};

/// Bodies more than a quarter of the trigger from where they were last looked at; their place is noted anew.
void mark(const State& state, std::int32_t body, State& to, MovedBodies& moved) {
  moved.flag[body] = 1;
  const double* pose = &state.pose[pose_width * std::size_t(body)];
  float* place = &to.searched[searched_width * std::size_t(body)];
  for (int c = 0; c < 3; ++c) place[c] = float(pose[c] - state.base_displacement()[c]);
  for (int c = 3; c < 7; ++c) place[c] = float(pose[c]);
}

MovedBodies find_moved(const Model& model, State& state) {
  MovedBodies moved{std::vector<char>(model.bodies.size(), 0)};
  const double near = 0.2 * skin(model), far = search_distance(model);
  const double* base = state.base_displacement().data();
  bool due = false;  // only a patch asks to be clipped: no need to look around everybody
  for (std::size_t i = 0; i < model.bodies.size() && !due; ++i) due = moved_since_search(model, state, i, base) > far;
  if (!due) return moved;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (moved_since_search(model, state, i, base) > near) mark(state, std::int32_t(i), state, moved);
  return moved;
}

/// A contact of the next list: an old one kept as it is, or a new one.
struct Entry {
  Key key;
  std::int64_t old = -1;  // index in the present list
  std::optional<NewContact> fresh;
};

void retire(State& state, std::size_t contact) {
  for (int c = 0; c < 3; ++c) state.retired_energy()[c] += state.contact.energy[3 * contact + c];
}

void append(State& next, const Branches& branches, const NewContact& c) {
  Patch p = c.patch;
  p.first_point = std::int32_t(next.contact_points.size() / 3);
  p.first_corner = std::int32_t(next.contact_corners.size() / 2);
  for (const PatchPoint& q : c.points) next.contact_points.insert(next.contact_points.end(), {q.s, q.t, q.weight});
  set_reach(next.contact_points, p);
  next.contacts.push_back(p);
  for (const PatchPoint& q : c.corners) next.contact_corners.insert(next.contact_corners.end(), {q.s, q.t});
  PatchMemory& m = next.contact;
  m.point.insert(m.point.end(), c.memory.begin(), c.memory.end());
  m.broken.insert(m.broken.end(), c.points.size(), 1);
  m.point_branch.insert(m.point_branch.end(), 3 * branches.count * c.points.size(), 0.0f);
  m.mode.push_back(mode_points);
  m.largest.insert(m.largest.end(), {c.carried_opening, 0.0});
  next.contact_slid.insert(next.contact_slid.end(), c.slid, c.slid + 4);
  m.energy.insert(m.energy.end(), 3, 0.0);
  m.last.insert(m.last.end(), 6, 0.0);  // a fresh contact's own jump is zero where it is made
}

void copy_old(const State& from, State& next, const Branches& branches, std::size_t i) {
  Patch p = from.contacts[i];
  const std::size_t at = p.first_point, corner = p.first_corner;
  p.first_point = std::int32_t(next.contact_points.size() / 3);
  p.first_corner = std::int32_t(next.contact_corners.size() / 2);
  next.contacts.push_back(p);
  const PatchMemory& m = from.contact;
  PatchMemory& n = next.contact;
  const auto copy = [](const auto& source, auto& to, std::size_t begin, std::size_t count) {
    to.insert(to.end(), source.begin() + long(begin), source.begin() + long(begin + count));
  };
  copy(from.contact_points, next.contact_points, 3 * at, 3 * p.point_count);
  copy(from.contact_corners, next.contact_corners, 2 * corner, 2 * p.corner_count);
  copy(m.point, n.point, 4 * at, 4 * p.point_count);
  copy(m.broken, n.broken, at, p.point_count);
  copy(m.point_branch, n.point_branch, 3 * branches.count * at, 3 * branches.count * p.point_count);
  copy(m.mode, n.mode, i, 1);
  copy(m.largest, n.largest, 2 * i, 2);
  copy(from.contact_slid, next.contact_slid, 4 * i, 4);
  copy(m.energy, n.energy, 3 * i, 3);
  copy(m.last, n.last, 6 * i, 6);
}

/// Joints and contacts past their limits become fresh contacts, or nothing where the cells have parted.
struct Clipper {
  const Model& model;
  State& state;
  const Branches& branches;
  ContactUpdate& update;

  std::optional<NewContact> clip(const Patch& old, const Array<double>& points, const PatchMemory& memory,
                                 double energy, const double* largest, const double* slid) {
    std::optional<NewContact> fresh = make_contact(model, state, old.a, old.cell_a, old.b, old.cell_b, skin(model));
    if (fresh) {
      // The same joint, elsewhere: what is left of a brittle law is its unbonded part.
      fresh->patch.kn = old.kn, fresh->patch.ks = old.ks;
      if (model.laws[std::size_t(old.law)].kind == JointLaw::Kind::brittle) fresh->patch.law = old.law;
      carry_over(model, state, old, points, memory, energy, *fresh);
      fresh->carried_opening = largest[0];
      const Vec3 before(slid[0], slid[1], slid[2]), after = before + mean_slip(state, old, points, memory);
      std::copy(after.begin(), after.end(), fresh->slid);
      fresh->slid[3] = std::max(slid[3], before.norm() + largest[1]);
      ++update.clipped;
    } else {
      ++update.dropped;
    }
    return fresh;
  }
};

Box placed_box(const Model& model, const State& state, std::int32_t body, const Convex& cell) {
  const double* p = &state.pose[pose_width * std::size_t(body)];
  const Mat3 r = rotation_of(state, std::size_t(body)).toRotationMatrix();
  const Vec3 c = model.bodies[body].centroid, u(p[0], p[1], p[2]);
  Box box;
  for (const Vec3& v : cell.vertices) {
    const Vec3 x = c + u + r * (v - c);
    box.low = box.low.cwiseMin(x), box.high = box.high.cwiseMax(x);
  }
  return box;
}

bool boxes_meet(const Box& a, const Box& b, double distance) {
  return (a.low.array() - distance <= b.high.array()).all() && (b.low.array() - distance <= a.high.array()).all();
}

/// A cell where it is now.
struct CellBox {
  std::int32_t body = 0, cell = 0;
  Box box;
};

void place_cells(const Model& model, const State& state, std::int32_t body, std::vector<CellBox>& cells) {
  for (const Convex& cell : model.cells[body])
    cells.push_back({body, std::int32_t(&cell - model.cells[body].data()), placed_box(model, state, body, cell)});
}

/// Whether the sphere about a body comes within a distance of a box.
bool sphere_meets(const Model& model, const State& state, std::int32_t body, const Box& box, double distance) {
  const double* p = &state.pose[pose_width * std::size_t(body)];
  const Vec3 centre = model.bodies[body].centroid + Vec3(p[0], p[1], p[2]);
  const double reach = 1.000001 * model.bodies[body].radius + distance;
  return (centre.cwiseMax(box.low).cwiseMin(box.high) - centre).squaredNorm() <= reach * reach;
}

/// Pairs of cells of different bodies, at least one moved and one free, whose boxes come within the skin.
std::vector<Key> candidate_pairs(const Model& model, const State& state, const MovedBodies& moved) {
  constexpr std::size_t few = 20;  // cells: less work to look past every body than to sort all of them
  std::vector<Key> pairs;
  const auto consider = [&](const CellBox& p, const CellBox& q) {
    const std::int32_t a = p.body, b = q.body;
    if (a == b || (model.bodies[a].still() && model.bodies[b].still()) || !(moved.flag[a] || moved.flag[b])) return;
    pairs.push_back(a < b ? Key{a, b, p.cell, q.cell} : Key{b, a, q.cell, p.cell});
  };
  const auto bodies = std::int32_t(model.bodies.size());
  std::vector<CellBox> from, cells;
  for (std::int32_t i = 0; i < bodies && from.size() <= few; ++i)
    if (moved.flag[i]) place_cells(model, state, i, from);
  if (from.size() <= few) {
    for (std::int32_t i = 0; i < bodies; ++i) {
      const auto near = [&](const CellBox& p) { return sphere_meets(model, state, i, p.box, skin(model)); };
      if (std::any_of(from.begin(), from.end(), near)) place_cells(model, state, i, cells);
    }
    for (const CellBox& p : from)
      for (const CellBox& q : cells)
        if (boxes_meet(p.box, q.box, skin(model))) consider(p, q);
  } else {
    for (std::int32_t i = 0; i < bodies; ++i) place_cells(model, state, i, cells);
    std::vector<Box> boxes;
    for (const CellBox& p : cells) boxes.push_back(p.box);
    for (const auto& [i, j] : neighbours(boxes, skin(model))) consider(cells[std::size_t(i)], cells[std::size_t(j)]);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// Cells in their present placement, each made when it is first asked for: a cell has several neighbours.
class PlacedCells {
 public:
  PlacedCells(const Model& model, const State& state) : model_(model), state_(state) {
    for (const auto& cells : model.cells) first_.push_back(first_.back() + cells.size());
    cells_.resize(first_.back());
  }
  const Convex& of(std::int32_t body, std::int32_t cell) {
    std::optional<Convex>& placed = cells_[first_[std::size_t(body)] + std::size_t(cell)];
    if (!placed) placed = placed_cell(model_, state_, body, cell);
    return *placed;
  }

 private:
  const Model& model_;
  const State& state_;
  std::vector<std::size_t> first_ = {0};
  std::vector<std::optional<Convex>> cells_;
};

}  // namespace

double search_distance(const Model& model) {
  return model.contact.search ? 0.4 * skin(model) : 1e300;
}

ContactUpdate update_contacts(const Model& model, State& state, const Branches& branches, bool clip) {
  ContactUpdate update;
  MovedBodies moved = find_moved(model, state);
  std::vector<Entry> entries;
  Clipper clipper{model, state, branches, update};
  double energy_before = 0.0;
  // 1. Patches past their limits are clipped anew, parted contacts dropped, the others kept.
  for (std::size_t i = 0; clip && i < model.joints.size(); ++i) {
    if ((state.joint.mode[i] & mode_gone) || !past_limits(model, state, model.joints[i])) continue;
    const Patch& old = model.joints[i];
    if (!(state.joint.mode[i] & mode_points)) joint_to_points(model, state, branches, i);
    const double energy = patch_energy(model, state, branches, i, true).elastic;
    energy_before += energy;
    const double none[4] = {0, 0, 0, 0};
    std::optional<NewContact> fresh =
        clipper.clip(old, model.points, state.joint, energy, &state.joint.largest[2 * i], none);
    state.joint.mode[i] |= mode_gone;
    mark(state, old.a, state, moved), mark(state, old.b, state, moved);
    if (fresh) entries.push_back({key_of(old), -1, std::move(fresh)});
  }
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    const Patch& old = state.contacts[i];
    const bool past = clip && past_limits(model, state, old);
    const bool moves = moved.flag[old.a] || moved.flag[old.b];
    if (!past && (!moves || least_gap(state, old, state.contact_points) < 2.0 * skin(model))) {
      entries.push_back({key_of(old), std::int64_t(i), std::nullopt});
      continue;
    }
    const double energy = patch_energy(model, state, branches, model.joints.size() + i, true).elastic;
    energy_before += energy;
    std::optional<NewContact> fresh;
    follow_open_contact(state, i);
    if (past)
      fresh = clipper.clip(old, state.contact_points, state.contact, energy, &state.contact.largest[2 * i],
                           &state.contact_slid[4 * i]);
    else
      ++update.dropped;
    retire(state, i);
    mark(state, old.a, state, moved), mark(state, old.b, state, moved);
    if (fresh) entries.push_back({key_of(old), -1, std::move(fresh)});
  }
  // 2. New meetings.
  std::vector<Key> live;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Patch& p = model.joints[i];
    if (!(state.joint.mode[i] & mode_gone) && (moved.flag[p.a] || moved.flag[p.b])) live.push_back(key_of(p));
  }
  for (const Entry& entry : entries) live.push_back(entry.key);
  std::sort(live.begin(), live.end());
  const auto joined = [&](const Key& key) {  // by another pair of their cells
    const auto next = std::lower_bound(live.begin(), live.end(), Key{std::get<0>(key), std::get<1>(key), -1, -1});
    return next != live.end() && std::get<0>(*next) == std::get<0>(key) && std::get<1>(*next) == std::get<1>(key);
  };
  PlacedCells placed(model, state);
  for (const Key& key : candidate_pairs(model, state, moved)) {
    if (std::binary_search(live.begin(), live.end(), key)) continue;
    ++update.examined;
    const auto [a, b, ca, cb] = key;
    // Bodies that a live patch holds within its limits cannot come at each other unseen: their other cells wait until
    // they touch.
    const double within = joined(key) ? 0.0 : skin(model);
    if (std::optional<NewContact> fresh =
            make_contact(model, state, a, ca, placed.of(a, ca), b, cb, placed.of(b, cb), within)) {
      entries.push_back({key, -1, std::move(fresh)});
      ++update.made;
    }
  }
  ++state.counters[1];
  state.counters[2] += update.made;
  if (!update.changed()) return update;
  // 3. The next list, in canonical order.
  std::sort(entries.begin(), entries.end(), [](const Entry& x, const Entry& y) { return x.key < y.key; });
  State old;
  std::swap(old.contacts, state.contacts);
  std::swap(old.contact_points, state.contact_points);
  std::swap(old.contact_corners, state.contact_corners);
  std::swap(old.contact, state.contact);
  std::swap(old.contact_slid, state.contact_slid);
  double energy_after = 0.0;
  for (const Entry& entry : entries) {
    if (entry.old >= 0) {
      copy_old(old, state, branches, std::size_t(entry.old));
      continue;
    }
    append(state, branches, *entry.fresh);
    const std::size_t last = state.contacts.size() - 1;
    energy_after += patch_energy(model, state, branches, model.joints.size() + last).elastic;
  }
  state.clipped_energy() += energy_before - energy_after;
  return update;
}

}  // namespace voussoir
