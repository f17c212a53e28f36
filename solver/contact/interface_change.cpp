#include "solver/contact/interface_change.h"

#include <algorithm>
#include <utility>

#include "solver/contact/interface_jump.h"

namespace voussoir {

namespace {

/// Data that a reclipped patch keeps: bonds, and the means of its branches.
struct Kept {
  std::uint8_t broken = 0;
  std::vector<double> means;
};

Kept kept_of(const Interface& interface, const PatchMemory& memory, std::size_t slot, int branches) {
  const std::size_t columns = 3 * std::size_t(branches);
  Kept kept;
  kept.means.assign(columns, 0.0);
  double area = 0.0;
  const std::vector<PatchPoint>& points = interface.patches[slot].points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    area += points[i].weight;
    kept.broken |= std::uint8_t(memory.broken[interface.point_index(slot, i, 1, 0)] & 1);
    for (std::size_t c = 0; c < columns; ++c)
      kept.means[c] += points[i].weight * double(memory.point_branch[interface.point_index(slot, i, columns, c)]);
  }
  for (double& mean : kept.means) mean /= area;
  return kept;
}

void begin_again(const Interface& interface, std::size_t slot, const Kept& kept, PatchMemory& memory) {
  for (std::size_t i = 0; i < interface.patches[slot].points.size(); ++i) {
    for (std::size_t c = 0; c < 2; ++c) {
      memory.point[interface.point_index(slot, i, 2, c)] = 0.0;
      memory.point_rest[interface.point_index(slot, i, 2, c)] = 0.0;
    }
    memory.broken[interface.point_index(slot, i, 1, 0)] = kept.broken;
    for (std::size_t c = 0; c < kept.means.size(); ++c)
      memory.point_branch[interface.point_index(slot, i, kept.means.size(), c)] = float(kept.means[c]);
  }
  const double* slid = interface.patches[slot].slid;
  double& most = memory.largest[largest_index(place_of_slot(slot), 1)];
  most = std::max(most, Vec3(slid).norm());
}

/// A reclipped patch begins with the same shear at all points. Where this exceeds friction, the excess is counted as
/// earlier slip. Otherwise it would slip in the next pass and add friction energy without external work.
void begin_within_friction(const Model& model, State& state, std::size_t slot) {
  const InterfacePatch& patch = state.interface.patches[slot];
  const Mat3 shape = shape_functions(patch);
  const InterfaceJump j = interface_jump(model, state, patch);
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    const Vec3 slips =
        j.point(shape, patch.points[i].s, patch.points[i].t) - elastic_point(model, state, slot, j, shape, i);
    for (std::size_t c = 0; c < 2; ++c)
      state.interface_memory.point[state.interface.point_index(slot, i, 2, c)] = slips[Eigen::Index(c) + 1];
  }
}

/// What a slot's points remember, from another interface.
void carry_memory(const Interface& from, const PatchMemory& old, const Interface& to, std::size_t slot, int branches,
                  PatchMemory& memory) {
  const InterfacePatch& patch = to.patches[slot];
  const auto before = std::size_t(patch.from);
  const BatchPlace at = place_of_slot(slot), was_at = place_of_slot(before);
  for (std::size_t c = 0; c < 2; ++c) memory.largest[largest_index(at, c)] = old.largest[largest_index(was_at, c)];
  for (std::size_t c = 0; c < 3; ++c) memory.energy[energy_index(at, c)] = old.energy[energy_index(was_at, c)];
  memory.mode[slot] = old.mode[before];
  if (patch.again) return begin_again(to, slot, kept_of(from, old, before, branches), memory);
  const std::size_t columns = 3 * std::size_t(branches);
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    const auto copy = [&](auto& now, const auto& was, std::size_t width, std::size_t c) {
      now[to.point_index(slot, i, width, c)] = was[from.point_index(before, i, width, c)];
    };
    for (std::size_t c = 0; c < 2; ++c)
      copy(memory.point, old.point, 2, c), copy(memory.point_rest, old.point_rest, 2, c);
    copy(memory.broken, old.broken, 1, 0);
    for (std::size_t c = 0; c < columns; ++c) copy(memory.point_branch, old.point_branch, columns, c);
  }
}

/// The present jump of a slot, rounded as in the passes, for the branches.
void note_jump(const Model& model, const State& state, std::size_t slot, PatchMemory& memory) {
  const InterfacePatch& patch = state.interface.patches[slot];
  const Mat3 shape = shape_functions(patch);
  const InterfaceJump j = interface_jump(model, state, patch);
  const std::size_t first = 9 * lane_count * (slot / lane_count) + slot % lane_count;
  for (std::size_t part = 0; part < 3; ++part)
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        sum += shape(Eigen::Index(k), Eigen::Index(part)) * j.moved[k][Eigen::Index(c)];
      memory.last[first + lane_count * (3 * part + c)] = float(sum);
    }
}

void bond(const Interface& interface, std::size_t slot, PatchMemory& memory) {
  for (std::size_t i = 0; i < interface.patches[slot].points.size(); ++i)
    memory.broken[interface.point_index(slot, i, 1, 0)] = 0;
}

/// Arranges all patches in new batches.
void rebuild(const Model& model, State& state, int branches, InterfaceChange& change) {
  const Interface before = std::move(state.interface);
  const PatchMemory old = std::move(state.interface_memory);
  for (std::size_t slot = 0; slot < change.gone.size(); ++slot) {
    if (!before.used(slot) || change.gone[slot]) continue;
    change.fresh.push_back(before.patches[slot]);
    change.fresh.back().from = std::int32_t(slot);
  }
  state.interface = make_interface(std::move(change.fresh), model);
  Interface& now = state.interface;
  PatchMemory memory;
  memory.resize(now.patches.size(), now.batches.size(), lane_count * now.point_rows);
  memory.point_branch.assign(3 * std::size_t(branches) * lane_count * now.point_rows, 0.0f);
  memory.last.assign(9 * lane_count * now.batches.size(), 0.0f);
  std::fill(memory.broken.begin(), memory.broken.end(), std::uint8_t(1));
  for (std::size_t slot = 0; slot < now.patches.size(); ++slot) {
    const std::int32_t from = now.patches[slot].from;
    if (from < 0 || !now.used(slot)) {
      if (change.bonded && has_bond(model.laws[std::size_t(now.patches[slot].law)])) bond(now, slot, memory);
      note_jump(model, state, slot, memory);
      continue;
    }
    carry_memory(before, old, now, slot, branches, memory);
    if (now.patches[slot].again) {
      note_jump(model, state, slot, memory);
      continue;
    }
    const auto lane_of = [](std::size_t s) { return 9 * lane_count * (s / lane_count) + s % lane_count; };
    for (std::size_t c = 0; c < 9; ++c)
      memory.last[lane_of(slot) + lane_count * c] = old.last[lane_of(std::size_t(from)) + lane_count * c];
  }
  state.interface_memory = std::move(memory);
  double energy_after = 0.0;
  for (std::size_t slot = 0; slot < now.patches.size(); ++slot) {
    InterfacePatch& patch = now.patches[slot];
    if (now.used(slot) && patch.again) begin_within_friction(model, state, slot);
    if (now.used(slot) && (patch.again || patch.from < 0)) energy_after += interface_energy(model, state, slot);
    patch.from = -1, patch.again = false;
  }
  state.clipped_energy() += change.energy_before - energy_after;
}

/// Nothing has come: clipped patches take the places of those they come from, dropped ones leave theirs empty.
void put_in_place(const Model& model, State& state, int branches, InterfaceChange& change) {
  Interface& interface = state.interface;
  PatchMemory& memory = state.interface_memory;
  double energy_after = 0.0;
  for (InterfacePatch& patch : change.fresh) {
    const auto slot = std::size_t(std::exchange(patch.from, -1));
    patch.again = false, change.gone[slot] = 0;
    const Kept kept = kept_of(interface, memory, slot, branches);
    replace_patch(slot, patch, model, interface);
    begin_again(interface, slot, kept, memory);
    note_jump(model, state, slot, memory);
    begin_within_friction(model, state, slot);
    energy_after += interface_energy(model, state, slot);
  }
  for (std::size_t slot = 0; slot < change.gone.size(); ++slot) {
    if (!change.gone[slot]) continue;
    empty_patch(slot, model, interface);
    for (std::size_t c = 0; c < 3; ++c)
      memory.energy[energy_index(place_of_slot(slot), c)] = 0.0;  // it has been retired
  }
  state.clipped_energy() += change.energy_before - energy_after;
}

}  // namespace

void change_interface(const Model& model, State& state, int branches, InterfaceChange change) {
  const bool made =
      std::any_of(change.fresh.begin(), change.fresh.end(), [](const InterfacePatch& p) { return p.from < 0; });
  if (made)
    rebuild(model, state, branches, change);
  else
    put_in_place(model, state, branches, change);
}

}  // namespace voussoir
