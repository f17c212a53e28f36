#include "solver/contact/contact_slots.h"

#include <algorithm>
#include <utility>

namespace voussoir {

namespace {

/// Of a free slot: no points, and bodies that nobody moves while the tile is at work.
Patch no_contact(const Tile& tile) {
  Patch p;
  p.a = p.b = tile.first_body;
  return p;
}

}  // namespace

/// Free slots of a kind, the lowest last; gathered when they are first asked for.
std::vector<std::size_t>& ContactSlots::free_of(Kind kind) {
  const auto [found, is_new] = free_.try_emplace(kind);
  std::vector<std::size_t>& slots = found->second;
  for (std::size_t k = state_.contact_batches.size(); is_new && k-- > 0;) {
    if (state_.contact_tiles[2 * k] != kind.first || state_.contact_tiles[2 * k + 1] != kind.second) continue;
    for (std::size_t slot = lane_count * (k + 1); slot-- > lane_count * k;)
      if (!state_.has_contact(slot)) slots.push_back(slot);
  }
  return slots;
}

std::size_t ContactSlots::first_of_new_batch(Kind kind) {
  append_contact_batch(state_, kind.first, kind.second);
  const std::size_t slot = state_.contacts.size(), points = lane_count * std::size_t(kind.second);
  const auto more = [](auto& array, std::size_t n, auto value) { array.resize(array.size() + n, value); };
  more(state_.contacts, lane_count, no_contact(model_.tiles[std::size_t(kind.first)]));
  state_.contact_tiles.insert(state_.contact_tiles.end(), {kind.first, kind.second});
  more(state_.contact_points, 3 * points, 0.0);
  more(state_.contact_corners, 2 * lane_count * std::size_t(most_corners(kind.second)), 0.0);
  PatchMemory& m = state_.contact;
  more(m.point, 2 * points, 0.0);
  more(m.point_rest, 2 * points, 0.0);
  more(m.broken, points, std::uint8_t(1));
  more(m.point_branch, 3 * std::size_t(branches_) * points, 0.0f);
  more(m.mode, lane_count, std::uint8_t(mode_gone));
  more(m.largest, 2 * lane_count, 0.0);
  more(m.energy, 3 * lane_count, 0.0);
  more(m.last, 6 * lane_count, 0.0f);
  more(state_.contact_slid, 4 * lane_count, 0.0);
  for (std::size_t lane = 0; lane < lane_count; ++lane) fill_contact_lane(state_, slot + lane);
  return slot;
}

std::size_t ContactSlots::free_slot(Kind kind) {
  std::vector<std::size_t>& free = free_of(kind);
  if (free.empty()) {
    const std::size_t first = first_of_new_batch(kind);
    for (std::size_t lane = lane_count; lane-- > 0;) free.push_back(first + lane);
  }
  const std::size_t slot = free.back();
  free.pop_back();
  return slot;
}

namespace {

/// Points and their memory; missing points repeat the last with no weight.
void fill_points(State& state, int branches, const NewContact& c, const Patch& p, std::int32_t rows) {
  PatchMemory& m = state.contact;
  for (int i = 0; i < rows; ++i) {
    const int from = std::min(i, p.point_count - 1);
    const PatchPoint& q = c.points[std::size_t(from)];
    const double columns[3] = {q.s, q.t, i < p.point_count ? q.weight : 0.0};
    for (int k = 0; k < 3; ++k) state.contact_points[point_index(p, i, 3, k)] = columns[k];
    const double* memory = &c.memory[4 * std::size_t(from)];
    const std::size_t first = point_index(p, i, 2, 0), second = point_index(p, i, 2, 1);
    m.point[first] = memory[1], m.point[second] = memory[2];
    m.point_rest[first] = memory[0], m.point_rest[second] = memory[3];
    m.broken[point_index(p, i, 1, 0)] = 1;
    for (int k = 0; k < 3 * branches; ++k) m.point_branch[point_index(p, i, 3 * branches, k)] = 0.0f;
  }
}

}  // namespace

std::size_t ContactSlots::add(const NewContact& c) {
  const auto points = std::int32_t(c.points.size());
  const std::int32_t rows = point_rows(points);
  const std::size_t slot = free_slot({model_.tile_of(std::min(c.patch.a, c.patch.b)), rows});
  const std::size_t index = slot / lane_count, lane = slot % lane_count;
  const ContactBatch& batch = state_.contact_batches[index];
  Patch& p = state_.contacts[slot];
  p = c.patch;
  p.stride = lane_count, p.batch = std::int32_t(index), p.lane = std::int32_t(lane);
  p.first_point = batch.patch.first_point, p.point_count = points;
  p.first_corner = batch.first_corner + std::int32_t(lane) * most_corners(rows);
  p.corner_count = std::int32_t(c.corners.size());
  for (std::size_t i = 0; i < c.corners.size(); ++i) {
    double* corner = &state_.contact_corners[2 * (std::size_t(p.first_corner) + i)];
    corner[0] = c.corners[i].s, corner[1] = c.corners[i].t;
  }
  fill_points(state_, branches_, c, p, rows);
  PatchMemory& m = state_.contact;
  m.mode[slot] = mode_points;
  const BatchPlace at = place_of_slot(slot);
  m.largest[largest_index(at, 0)] = c.carried_opening, m.largest[largest_index(at, 1)] = 0.0;
  for (std::size_t k = 0; k < 3; ++k) m.energy[energy_index(at, k)] = 0.0;
  for (int k = 0; k < 6; ++k) m.last[last_index(index, k) + lane] = 0.0f;  // zero where it is made
  std::copy(c.slid, c.slid + 4, &state_.contact_slid[4 * slot]);
  fill_contact_lane(state_, slot);
  return slot;
}

void ContactSlots::remove(std::size_t slot) {
  for (std::size_t c = 0; c < 3; ++c)
    state_.retired_energy()[c] += std::exchange(state_.contact.energy[energy_index(place_of_slot(slot), c)], 0.0);
  const ContactBatch& batch = state_.contact_batches[slot / lane_count];
  state_.contact.mode[slot] = mode_gone;
  state_.contacts[slot] = no_contact(model_.tiles[std::size_t(batch.tile)]);
  fill_contact_lane(state_, slot);
  const auto known = free_.find({batch.tile, batch.patch.points});
  if (known == free_.end()) return;
  std::vector<std::size_t>& free = known->second;
  free.insert(std::lower_bound(free.begin(), free.end(), slot, std::greater<>()), slot);
}

}  // namespace voussoir
