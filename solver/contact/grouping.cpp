#include "solver/contact/grouping.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "solver/base/error.h"
#include "solver/base/parallel.h"

namespace voussoir {

namespace {

/// How a patch is computed; patches of a tile are put in this order.
enum class Way : std::uint8_t { intact, open, points, gone };

Way way_of_joint(std::uint8_t mode) {
  return mode & mode_gone ? Way::gone : mode & mode_points ? Way::points : mode & mode_open ? Way::open : Way::intact;
}

/// A contact that is wholly open is known by its jump alone.
Way way_of_contact(std::uint8_t mode) {
  return mode & mode_gone ? Way::gone : mode & mode_open ? Way::open : Way::points;
}

/// What the batches of patches in this order cost, in that of one whose joints are all intact: for each what is common
/// to all ways, and the points if there are any.
double cost_of(const std::vector<Way>& ways) {
  double sum = 0.0;
  for (auto begin = ways.begin(); begin != ways.end();) {
    const auto end = begin + std::min<std::ptrdiff_t>(lane_count, ways.end() - begin);
    if (!std::all_of(begin, end, [](Way w) { return w == Way::gone; })) sum += 1.0;
    if (std::find(begin, end, Way::points) != end) sum += 3.5;
    begin = end;
  }
  return sum;
}
constexpr double worth_grouping = 0.9;  // of the present cost, or less

/// A patch's way from one lane to another.
struct LaneMove {
  std::size_t from = 0, to = 0;  // places in the list of patches
  std::size_t batch_from = 0, batch_to = 0, lane_from = 0, lane_to = 0;
};

/// Rows of a table that hold eight patches side by side: those of one batch.
struct Rows {
  std::size_t first = 0, count = 0;
};

/// Lanes of a table of rows with so many columns. A patch with fewer rows than its batch repeats the last one.
template <class T, class RowsOf>
void move_rows(const std::vector<LaneMove>& moves, std::size_t columns, const RowsOf& rows_of, T* table) {
  std::vector<T> taken;
  const auto each = [&](const LaneMove& m, const auto& visit) {
    const Rows from = rows_of(m.batch_from), to = rows_of(m.batch_to);
    for (std::size_t r = 0; r < to.count; ++r)
      for (std::size_t c = 0; c < columns; ++c)
        visit(lane_count * (columns * (from.first + std::min(r, from.count - 1)) + c) + m.lane_from,
              lane_count * (columns * (to.first + r) + c) + m.lane_to);
  };
  for (const LaneMove& m : moves) each(m, [&](std::size_t from, std::size_t) { taken.push_back(table[from]); });
  auto next = taken.begin();
  for (const LaneMove& m : moves) each(m, [&](std::size_t, std::size_t to) { table[to] = *next++; });
}

template <class T>
void move_each(const std::vector<LaneMove>& moves, std::size_t width, T* list) {
  std::vector<T> taken;
  for (const LaneMove& m : moves) taken.insert(taken.end(), list + width * m.from, list + width * (m.from + 1));
  auto next = taken.begin();
  for (const LaneMove& m : moves) {
    std::copy_n(next, width, list + width * m.to);
    next += std::ptrdiff_t(width);
  }
}

Rows one_each(std::size_t batch) {
  return {batch, 1};
}

template <class RowsOf>
void move_memory(const std::vector<LaneMove>& moves, const RowsOf& rows_of, std::size_t branches, PatchMemory& memory) {
  move_rows(moves, 2, rows_of, memory.point.data());
  move_rows(moves, 2, rows_of, memory.point_rest.data());
  move_rows(moves, 1, rows_of, memory.broken.data());
  move_rows(moves, 3 * branches, rows_of, memory.point_branch.data());
  move_rows(moves, 2, one_each, memory.largest.data());
  move_rows(moves, 3, one_each, memory.energy.data());
  move_rows(moves, 6, one_each, memory.last.data());
  move_each(moves, 1, memory.mode.data());
}

/// The joints of one tile in another order.
class Joints {
 public:
  /// `order`: for each place of the tile the place whose joint goes there.
  Joints(Model& model, const Tile& tile, const std::vector<std::size_t>& order) : model_(model), tile_(tile) {
    const auto first = std::size_t(tile.first_joint), batch = std::size_t(tile.first_batch);
    const auto add = [&](std::vector<LaneMove>& moves, std::size_t from, std::size_t to) {
      const std::size_t a = from - first, b = to - first;
      if (a != b)
        moves.push_back({from, to, batch + a / lane_count, batch + b / lane_count, a % lane_count, b % lane_count});
    };
    for (std::size_t i = 0; i < order.size(); ++i) add(moves_, order[i], first + i);
    all_ = moves_;
    if (order.empty() || order.back() == first + order.size() - 1) return;
    for (std::size_t i = order.size(); i % lane_count; ++i) add(all_, order.back(), first + i);
  }

  void move_model() const {
    const auto corners = [&](std::size_t k) {
      return Rows{std::size_t(model_.batches[k].first_corner) / 2, std::size_t(model_.batches[k].corners)};
    };
    move_rows(all_, 3, points(), model_.points.data());
    move_rows(all_, 2, corners, reinterpret_cast<double*>(model_.batch_corners.data()));
    const std::vector<JointBatch> old(model_.batches.begin() + tile_.first_batch,
                                      model_.batches.begin() + tile_.end_batch);
    for (const LaneMove& m : all_)
      move_lane(old[m.batch_from - std::size_t(tile_.first_batch)], m, model_.batches[m.batch_to]);
    for (std::int32_t k = tile_.first_batch; k < tile_.end_batch; ++k) {
      JointBatch& batch = model_.batches[std::size_t(k)];
      batch.law = common_law(batch), batch.touches_still = touches_still(model_, batch);
    }
    move_each(moves_, 1, model_.joints.data());
    move_each(moves_, 1, model_.joint_of_patch.data());
    for (const LaneMove& m : moves_) {
      Patch& patch = model_.joints[m.to];
      patch.batch = std::int32_t(m.batch_to), patch.lane = std::int32_t(m.lane_to);
      patch.first_point = model_.batches[m.batch_to].first_point;
      model_.joint_places[std::size_t(model_.joint_of_patch[m.to])].now = std::int32_t(m.to);
    }
  }

  void move_state(State& state) const {
    const std::size_t branches = state.branch.size() / (6 * lane_count * model_.batches.size());
    move_memory(moves_, points(), branches, state.joint);
    move_rows(moves_, 3, one_each, state.slip.data());
    move_rows(moves_, 6 * branches, one_each, state.branch.data());
    move_each(moves_, 1, state.joint_order.data());
  }

 private:
  struct PointRowsOf {
    const Model& model;
    Rows operator()(std::size_t k) const {
      return {std::size_t(model.batches[k].first_point), std::size_t(model.batches[k].points)};
    }
  };
  PointRowsOf points() const { return {model_}; }

  static void move_lane(const JointBatch& from, const LaneMove& m, JointBatch& to) {
    const std::size_t a = m.lane_from, b = m.lane_to;
    const auto move = [&](const Lanes* source, Lanes* target, int n) {
      for (int i = 0; i < n; ++i) target[i][b] = source[i][a];
    };
    move(from.arm_a, to.arm_a, 3), move(from.arm_b, to.arm_b, 3), move(from.place, to.place, 3);
    move(from.frame, to.frame, 4);
    for (const auto field : {&PatchBatch::kn, &PatchBatch::ks, &PatchBatch::area})
      move(&(from.*field), &(to.*field), 1);
    for (const auto field : {&JointBatch::ss, &JointBatch::tt, &JointBatch::half_s, &JointBatch::half_t})
      move(&(from.*field), &(to.*field), 1);
    to.pose_a[b] = from.pose_a[a], to.pose_b[b] = from.pose_b[a], to.law_of[b] = from.law_of[a];
    to.sum_a[b] = from.sum_a[a], to.sum_b[b] = from.sum_b[a];
  }

  Model& model_;
  const Tile& tile_;
  std::vector<LaneMove> moves_, all_;  // all: and lanes past the last joint, which repeat it
};

/// Places of a tile's joints in the order in which they share batches best; none where that is not worth it.
std::vector<std::size_t> grouped_joints(const Model& model, const State& state, const Tile& tile) {
  const auto first = std::size_t(tile.first_joint), end = std::size_t(tile.end_joint);
  std::vector<Way> ways(end - first);
  std::transform(&state.joint.mode[first], &state.joint.mode[0] + end, ways.begin(), way_of_joint);
  std::vector<std::pair<std::uint64_t, std::size_t>> keys;  // shape, way, place as built; place now
  std::uint64_t reversed = 0, shape = 0;
  for (std::size_t i = first; i < end; ++i) {
    const JointPlace& at = model.joint_places[std::size_t(model.joint_of_patch[i])];
    // Shapes lie one after the other. Each begins with the way that the one before ends with, so that the batch they
    // share has one way.
    if (i > first && std::uint64_t(at.shape) != shape) reversed ^= 3;
    shape = std::uint64_t(at.shape);
    const auto kind = shape << 2 | (std::uint64_t(ways[i - first]) ^ reversed);
    keys.emplace_back(kind << 32 | std::uint64_t(at.first), i);
  }
  std::sort(keys.begin(), keys.end());
  const double before = cost_of(ways);
  std::vector<std::size_t> order;
  std::vector<Way> after;
  for (const auto& key : keys) order.push_back(key.second), after.push_back(ways[key.second - first]);
  if (cost_of(after) > worth_grouping * before) order.clear();
  return order;
}

/// Slots of each kind: of a tile, and for a number of points.
std::vector<std::vector<std::size_t>> kinds_of_slots(const State& state) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>> kinds;
  for (std::size_t slot = 0; slot < state.contacts.size(); ++slot) {
    const ContactBatch& batch = state.contact_batches[slot / lane_count];
    kinds[{batch.tile, batch.patch.points}].push_back(slot);
  }
  std::vector<std::vector<std::size_t>> slots;
  for (auto& kind : kinds) slots.push_back(std::move(kind.second));
  return slots;
}

/// Contacts in slots of one kind change places.
void group_slots(State& state, const std::vector<std::size_t>& slots) {
  std::vector<Way> ways(slots.size()), after;
  std::transform(slots.begin(), slots.end(), ways.begin(),
                 [&](std::size_t slot) { return way_of_contact(state.contact.mode[slot]); });
  std::vector<std::size_t> order(slots.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return ways[i] < ways[j]; });
  for (const std::size_t i : order) after.push_back(ways[i]);
  if (cost_of(after) > worth_grouping * cost_of(ways)) return;
  std::vector<LaneMove> moves;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const std::size_t from = slots[order[i]], to = slots[i];
    if (from != to) moves.push_back({from, to, from / lane_count, to / lane_count, from % lane_count, to % lane_count});
  }
  const auto rows_of = [&](std::size_t k) {
    const JointBatch& batch = state.contact_batches[k].patch;
    return Rows{std::size_t(batch.first_point), std::size_t(batch.points)};
  };
  const std::size_t branches =
      state.contact.point_branch.size() / std::max<std::size_t>(1, state.contact_points.size());
  const auto corners = std::size_t(2 * most_corners(state.contact_batches[slots.front() / lane_count].patch.points));
  move_memory(moves, rows_of, branches, state.contact);
  move_rows(moves, 3, rows_of, state.contact_points.data());
  move_each(moves, 4, state.contact_slid.data());
  const auto corner_of = [&](std::size_t slot) {
    return std::size_t(2 * state.contact_batches[slot / lane_count].first_corner) + corners * (slot % lane_count);
  };
  std::vector<double> taken;
  for (const LaneMove& m : moves) {
    const auto at = state.contact_corners.begin() + std::ptrdiff_t(corner_of(m.from));
    taken.insert(taken.end(), at, at + std::ptrdiff_t(corners));
  }
  for (std::size_t i = 0; i < moves.size(); ++i)
    std::copy_n(&taken[corners * i], corners, &state.contact_corners[corner_of(moves[i].to)]);
  move_each(moves, 1, state.contacts.data());
  for (const LaneMove& m : moves) {
    Patch& patch = state.contacts[m.to];
    patch.batch = std::int32_t(m.batch_to), patch.lane = std::int32_t(m.lane_to);
    if (patch.point_count > 0) {
      patch.first_point = std::int32_t(rows_of(m.batch_to).first);
      patch.first_corner = std::int32_t(corner_of(m.to) / 2);
    }
    fill_contact_lane(state, m.to);
  }
}

}  // namespace

void group_patches(Model& model, State& state, int threads) {
  constexpr std::size_t least_tiles_per_thread = 4;
  for_each(model.tiles.size(), threads, least_tiles_per_thread, [&](std::size_t t) {
    const Tile& tile = model.tiles[t];
    if (tile.first_joint == tile.end_joint) return;
    const std::vector<std::size_t> order = grouped_joints(model, state, tile);
    if (order.empty()) return;
    const Joints joints(model, tile, order);
    joints.move_model();
    joints.move_state(state);
  });
  const std::vector<std::vector<std::size_t>> kinds = kinds_of_slots(state);
  for_each(kinds.size(), threads, least_tiles_per_thread, [&](std::size_t k) { group_slots(state, kinds[k]); });
  state.grouped_at() = state.step();
}

void take_joint_order(Model& model, const State& state) {
  for (const Tile& tile : model.tiles) {
    std::vector<std::size_t> order;
    std::vector<char> taken(std::size_t(tile.end_joint - tile.first_joint), 0);
    for (std::int32_t i = tile.first_joint; i < tile.end_joint; ++i) {
      const std::int32_t joint = state.joint_order.at(std::size_t(i));
      const bool known = joint >= 0 && std::size_t(joint) < model.joint_places.size();
      const JointPlace at = known ? model.joint_places[std::size_t(joint)] : JointPlace{};
      const bool here = known && at.now >= tile.first_joint && at.now < tile.end_joint;
      const std::int64_t present = model.joint_of_patch[std::size_t(i)];
      if (!here || taken[std::size_t(at.now - tile.first_joint)]++ ||
          at.shape != model.joint_places[std::size_t(present)].shape)
        throw InputError("the state has joint {} in place {}, where it cannot be: it belongs to another assembly",
                         joint, i);
      order.push_back(std::size_t(at.now));
    }
    if (!order.empty()) Joints(model, tile, order).move_model();
  }
}

}  // namespace voussoir
