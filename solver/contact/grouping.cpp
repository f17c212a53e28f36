#include "solver/contact/grouping.h"

#include <algorithm>
#include <array>
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

/// Cost of the batches in this order, relative to a batch of intact joints: for each batch the common part, and the
/// points if there are any.
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
  std::size_t source = 0;  // where batch_from is in Moves::sources
};

struct Moves {
  std::vector<LaneMove> lanes;
  std::vector<std::size_t> sources;  // batches that lanes are taken from

  void find_sources() {
    for (const LaneMove& m : lanes) sources.push_back(m.batch_from);
    std::sort(sources.begin(), sources.end());
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    for (LaneMove& m : lanes)
      m.source = std::size_t(std::lower_bound(sources.begin(), sources.end(), m.batch_from) - sources.begin());
  }
};

/// Rows of a table that hold eight patches side by side: those of one batch.
struct Rows {
  std::size_t first = 0, count = 0;
};

/// Lanes of a table of rows with so many columns. A patch with fewer rows than its batch repeats the last one.
template <class T, class RowsOf>
void move_rows(const Moves& moves, std::size_t columns, const RowsOf& rows_of, T* table) {
  const std::size_t width = lane_count * columns;
  std::vector<T> old;  // rows of all sources
  std::vector<std::size_t> first;
  std::size_t size = 0;
  for (const std::size_t batch : moves.sources) first.push_back(size), size += width * rows_of(batch).count;
  old.reserve(size);
  for (const std::size_t batch : moves.sources) {
    const Rows rows = rows_of(batch);
    old.insert(old.end(), table + width * rows.first, table + width * (rows.first + rows.count));
  }
  for (const LaneMove& m : moves.lanes) {
    const std::size_t has = columns * rows_of(m.batch_from).count;
    const Rows rows = rows_of(m.batch_to);
    const T* from = old.data() + first[m.source] + m.lane_from;
    T* to = table + width * rows.first + m.lane_to;
    const std::size_t end = columns * rows.count, common = std::min(has, end);
    for (std::size_t i = 0; i < common; ++i) to[lane_count * i] = from[lane_count * i];
    for (std::size_t i = common; i < end; ++i) to[lane_count * i] = from[lane_count * (has - columns + i % columns)];
  }
}

template <class T>
void move_each(const Moves& moves, std::size_t width, T* list) {
  std::vector<T> taken;
  taken.reserve(width * moves.lanes.size());
  for (const LaneMove& m : moves.lanes) taken.insert(taken.end(), list + width * m.from, list + width * (m.from + 1));
  auto next = taken.begin();
  for (const LaneMove& m : moves.lanes) {
    std::copy_n(next, width, list + width * m.to);
    next += std::ptrdiff_t(width);
  }
}

Rows one_each(std::size_t batch) {
  return {batch, 1};
}

template <class RowsOf>
void move_memory(const Moves& moves, const RowsOf& rows_of, std::size_t branches, PatchMemory& memory) {
  move_rows(moves, 2, rows_of, memory.point.data());
  move_rows(moves, 2, rows_of, memory.point_rest.data());
  if (!memory.point_crush.empty()) move_rows(moves, 3, rows_of, memory.point_crush.data());
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
    const auto add = [&](Moves& moves, std::size_t from, std::size_t to) {
      const std::size_t a = from - first, b = to - first;
      if (a != b)
        moves.lanes.push_back(
            {from, to, batch + a / lane_count, batch + b / lane_count, a % lane_count, b % lane_count});
    };
    for (std::size_t i = 0; i < order.size(); ++i) add(moves_, order[i], first + i);
    moves_.find_sources();
    all_ = moves_;
    if (order.empty() || order.back() == first + order.size() - 1) return;
    const std::size_t last = order.size() - 1, source = moves_.lanes.back().source;
    for (std::size_t i = order.size(); i % lane_count; ++i)
      add(all_, order[last], first + i), all_.lanes.back().source = source;
  }

  void move_model() const {
    const auto corners = [&](std::size_t k) {
      return Rows{std::size_t(model_.batches[k].first_corner) / 2, std::size_t(model_.batches[k].corners)};
    };
    move_rows(all_, 3, points(), model_.points.data());
    move_rows(all_, 2, corners, reinterpret_cast<double*>(model_.batch_corners.data()));
    if (!model_.built.empty()) move_rows(all_, 6, one_each, reinterpret_cast<float*>(model_.built.data()));
    std::vector<JointBatch> old;
    old.reserve(all_.sources.size());
    for (const std::size_t k : all_.sources) old.push_back(model_.batches[k]);
    for (const LaneMove& m : all_.lanes) move_lane(old[m.source], m, model_.batches[m.batch_to]);
    for (std::int32_t k = tile_.first_batch; k < tile_.end_batch; ++k) {
      JointBatch& batch = model_.batches[std::size_t(k)];
      batch.law = common_law(batch), batch.touches_still = touches_still(model_, batch);
    }
    move_each(moves_, 1, model_.joints.data());
    move_each(moves_, 1, model_.joint_of_patch.data());
    for (const LaneMove& m : moves_.lanes) {
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
  Moves moves_, all_;  // all: and lanes past the last joint, which repeat it
};

/// Places of a tile's joints in the order in which they share batches best; none where that is not worth it.
std::vector<std::size_t> grouped_joints(const Model& model, const State& state, const Tile& tile) {
  const auto first = std::size_t(tile.first_joint), count = std::size_t(tile.end_joint) - first;
  std::vector<Way> ways(count), after;
  std::transform(&state.joint.mode[first], &state.joint.mode[first] + count, ways.begin(), way_of_joint);
  std::vector<const JointPlace*> places(count);
  for (std::size_t i = 0; i < count; ++i) places[i] = &model.joint_places[std::size_t(model.joint_of_patch[first + i])];
  std::vector<std::pair<std::uint64_t, std::size_t>> keys(count);  // run of one shape, way, place as built; place now
  std::uint64_t runs = 0, reversed = 0;
  for (std::size_t begin = 0, end = 0; begin < count; begin = end, ++runs, reversed ^= 3) {
    // Shapes lie one after the other. Each begins with the way that the one before ends with, so that the batch they
    // share has one way.
    std::array<std::size_t, 4> like{};
    for (; end < count && places[end]->shape == places[begin]->shape; ++end) {
      const auto way = std::uint64_t(ways[end]) ^ reversed;
      ++like[way];
      keys[end] = {(runs << 2 | way) << 32 | std::uint64_t(places[end]->first), first + end};
    }
    for (std::uint64_t way = 0; way < like.size(); ++way) after.insert(after.end(), like[way], Way(way ^ reversed));
  }
  if (cost_of(after) > worth_grouping * cost_of(ways)) return {};
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  for (const auto& key : keys) order.push_back(key.second);
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
  Moves moves;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const std::size_t from = slots[order[i]], to = slots[i];
    if (from != to)
      moves.lanes.push_back({from, to, from / lane_count, to / lane_count, from % lane_count, to % lane_count});
  }
  moves.find_sources();
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
  for (const LaneMove& m : moves.lanes) {
    const auto at = state.contact_corners.begin() + std::ptrdiff_t(corner_of(m.from));
    taken.insert(taken.end(), at, at + std::ptrdiff_t(corners));
  }
  for (std::size_t i = 0; i < moves.lanes.size(); ++i)
    std::copy_n(&taken[corners * i], corners, &state.contact_corners[corner_of(moves.lanes[i].to)]);
  move_each(moves, 1, state.contacts.data());
  for (const LaneMove& m : moves.lanes) {
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
        throw InputError(
            "the state has joint {} at position {}, which is impossible for this assembly. The state belongs to "
            "another assembly.",
            joint, i);
      order.push_back(std::size_t(at.now));
    }
    if (!order.empty()) Joints(model, tile, order).move_model();
  }
  take_built(model, state);
}

void take_built(Model& model, const State& state) {
  if (model.built.empty()) return;
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    for (std::size_t c = 0; c < 6; ++c)
      model.joints[i].built[c] = state.built[6 * std::size_t(model.joint_of_patch[i]) + c];
  for (std::size_t k = 0; k < model.batches.size(); ++k) {
    const JointBatch& batch = model.batches[k];
    for (int lane = 0; lane < lane_count; ++lane)  // further lanes repeat the last joint
      for (std::size_t c = 0; c < 6; ++c)
        model.built[6 * k + c][lane] =
            float(model.joints[std::size_t(batch.first_joint + std::min(lane, batch.count - 1))].built[c]);
  }
}

}  // namespace voussoir
