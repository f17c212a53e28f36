#include "solver/contact/search.h"

#include <algorithm>
#include <numeric>

#include "solver/base/parallel.h"
#include "solver/contact/contact_slots.h"
#include "solver/contact/interface_search.h"
#include "solver/contact/pairs.h"
#include "solver/contact/patch_energy.h"
#include "solver/model/kernels.h"

namespace voussoir {

void note_place(const State& state, std::size_t body, Array<float>& places) {
  const double* pose = &state.pose[pose_width * body];
  float* place = &places[searched_width * body];
  for (int c = 0; c < 3; ++c) place[c] = float(pose[c] - state.base_displacement()[c]);
  for (int c = 3; c < 7; ++c) place[c] = float(pose[c]);
}

namespace {

/// The cells of some bodies where they are now: a cell has several neighbours.
class PlacedCells {
 public:
  PlacedCells(const Model& model, const State& state) : model_(model), state_(state), first_(model.bodies.size(), -1) {}
  void need(std::int32_t body) {
    if (first_[std::size_t(body)] >= 0) return;
    first_[std::size_t(body)] = std::int32_t(which_.size());
    for (std::size_t c = 0; c < model_.cells[std::size_t(body)].size(); ++c) which_.emplace_back(body, std::int32_t(c));
  }
  void place(int threads) {
    cells_.resize(which_.size());
    for_each(which_.size(), threads, 20,
             [&](std::size_t i) { cells_[i] = placed_cell(model_, state_, which_[i].first, which_[i].second); });
  }
  const Convex& of(std::int32_t body, std::int32_t cell) const {
    return cells_[std::size_t(first_[std::size_t(body)] + cell)];
  }

 private:
  const Model& model_;
  const State& state_;
  std::vector<std::int32_t> first_;  // of each body, −1: not asked for
  std::vector<std::pair<std::int32_t, std::int32_t>> which_;
  std::vector<Convex> cells_;
};

/// One search, from what has moved to the new list.
class Search {
 public:
  Search(const Model& model, State& state, const Branches& branches, int threads)
      : model_(model),
        state_(state),
        branches_(branches),
        threads_(threads),
        slots_(model, state, branches),
        joints_(model),
        moved_(model.bodies.size(), 0),
        stale_(model.bodies.size(), 0) {}

  ContactUpdate run(std::span<const std::int32_t> past) {
    find_moved();
    clip_joints(past);
    look_at_contacts(past);
    if (any_stale_) kernels().list_pairs(model_, state_, stale_, threads_);
    for (const NewContact& contact : clipped_) add(contact);
    examine(due_pairs(model_, state_, moved_, threads_));
    state_.clipped_energy() += energy_before_ - energy_after_;
    update_.listed = any_stale_;
    ++state_.counters[1];
    state_.counters[2] += update_.made;
    return update_;
  }

 private:
  /// Bodies past the share of the skin that counts as having moved, in every search: that all others stand near their
  /// noted places is what the pairs rest on.
  void find_moved() {
    if (!model_.contact.search) return;
    const double near = moved_share * skin(model_);
    const Vec3 base = state_.base_displacement();
    enum : char { stays = 0, moves, strays, falls_out };
    std::vector<char> what(model_.bodies.size());
    for_each(what.size(), threads_, 1000, [&](std::size_t i) {
      if (moved_since(model_, state_, state_.searched, i, base) <= near) return;
      note_place(state_, i, state_.searched);
      what[i] = fallen_out(i) ? falls_out : past_list(model_, state_, i) ? strays : moves;
    });
    for (std::size_t i = 0; i < what.size(); ++i) {
      if (what[i] == stays) continue;
      moved_[i] = 1;
      if (what[i] == falls_out) state_.searched[searched_width * i + 7] = 1.0f;
      if (what[i] != moves) list_anew(std::int32_t(i));
    }
  }

  /// Whether a body has fallen below all that the assembly was: it meets nobody any more but what falls with it.
  bool fallen_out(std::size_t i) const {
    const double* pose = &state_.pose[pose_width * i];
    const Vec3 moved = Vec3(pose[0], pose[1], pose[2]) - state_.base_displacement();
    const Body& body = model_.bodies[i];
    return (body.centroid + moved).dot(model_.up) + body.radius < model_.bottom;
  }
  bool lost(const Patch& p) const { return state_.lost(std::size_t(p.a)) || state_.lost(std::size_t(p.b)); }

  void mark(std::int32_t body) {
    moved_[std::size_t(body)] = 1;
    note_place(state_, std::size_t(body), state_.searched);
    if (past_list(model_, state_, std::size_t(body))) list_anew(body);
  }

  void list_anew(std::int32_t body) {
    stale_[std::size_t(body)] = 1;
    any_stale_ = true;
  }

  bool past(const Patch& p) const {
    return past_limits(model_, p, patch_jump(p, &state_.pose[pose_width * p.a], &state_.pose[pose_width * p.b]));
  }

  /// Joints of these tiles past their limits become contacts, or nothing where the cells have parted.
  void clip_joints(std::span<const std::int32_t> tiles) {
    std::vector<std::vector<std::size_t>> of_tile(tiles.size());
    for_each(tiles.size(), threads_, 2, [&](std::size_t t) {
      const Tile& tile = model_.tiles[std::size_t(tiles[t])];
      for (auto i = std::size_t(tile.first_joint); i < std::size_t(tile.end_joint); ++i) {
        const Patch& p = model_.joints[i];
        if (!(state_.joint.mode[i] & mode_gone) && past(p) && !stays(p)) of_tile[t].push_back(i);
      }
    });
    std::vector<std::size_t> going;
    for (const auto& joints : of_tile) going.insert(going.end(), joints.begin(), joints.end());
    std::vector<Ended> ended(going.size());
    for_each(going.size(), threads_, least_clipped_per_thread, [&](std::size_t k) { ended[k] = end_joint(going[k]); });
    for (std::size_t k = 0; k < going.size(); ++k) {
      const Patch& old = model_.joints[going[k]];
      enter(old, std::move(ended[k]));
      state_.joint.mode[going[k]] |= mode_gone;
      list_anew(old.a), list_anew(old.b);  // the joint was not among the pairs
    }
  }

  /// A joint without limits never leaves its place, nor does a tie.
  bool stays(const Patch& p) const {
    return model_.laws[std::size_t(p.law)].kind == JointLaw::Kind::elastic || p.length > 0.0;
  }

  /// Contacts of these tiles past their limits are clipped anew, parted ones dropped wherever they are.
  void look_at_contacts(std::span<const std::int32_t> tiles) {
    std::vector<char> clips(model_.tiles.size(), 0);
    for (const std::int32_t tile : tiles) clips[std::size_t(tile)] = 1;
    enum : char { stays = 0, is_past, has_gone };
    std::vector<char> what(state_.contacts.size(), stays);
    for_each(what.size(), threads_, 500, [&](std::size_t slot) {
      if (!state_.has_contact(slot)) return;
      const Patch& p = state_.contacts[slot];
      const bool moves = moved_[std::size_t(p.a)] || moved_[std::size_t(p.b)];
      const bool clip = clips[std::size_t(state_.contact_batches[slot / lane_count].tile)] && past(p);
      what[slot] = lost(p) ? has_gone : clip ? is_past : moves && has_parted(slot) ? has_gone : stays;
    });
    const std::vector<std::size_t> going = marked(what);
    std::vector<Ended> ended(going.size());
    for_each(going.size(), threads_, least_clipped_per_thread,
             [&](std::size_t k) { ended[k] = end_contact(going[k], what[going[k]] == is_past); });
    for (std::size_t k = 0; k < going.size(); ++k) {
      const Patch old = state_.contacts[going[k]];
      slots_.remove(going[k]);
      enter(old, std::move(ended[k]));
    }
  }

  /// Whether all points of a contact are two skins apart or more.
  bool has_parted(std::size_t slot) const {
    const Patch& p = state_.contacts[slot];
    const Jump<double> j = patch_jump(p, &state_.pose[pose_width * p.a], &state_.pose[pose_width * p.b]);
    const double parted = 2.0 * skin(model_);
    if (j.n + p.gap[0] < parted) return false;  // at the centroid, which lies among them
    for (int i = 0; i < p.point_count; ++i) {
      const PatchPoint q = patch_point(p, state_.contact_points, i);
      if (point_jump(p, j, q.s, q.t).x < parted) return false;
    }
    return true;
  }

  /// Two bodies have lost a patch: what there is between them is looked at again, farther apart if nothing else holds
  /// them.
  void part(const Patch& old) {
    mark(old.a), mark(old.b);
    const auto [begin, end] = pairs_of(state_, std::min(old.a, old.b), std::max(old.a, old.b));
    const CellPair cells = cells_of(old);
    for (std::size_t i = begin; i < end; ++i) {
      float& allowed = state_.pair_seen[searched_width * i + 7];
      const bool same = std::equal(cells.begin(), cells.end(), &state_.pair_cells[4 * i]);
      if (same || allowed < pair_has_contact) allowed = pair_is_new;
    }
  }

  static std::vector<std::size_t> marked(const std::vector<char>& marks) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < marks.size(); ++i)
      if (marks[i]) places.push_back(i);
    return places;
  }

  /// What a patch that ends held, and what takes its place: of it alone, so that threads can share this.
  struct Ended {
    double energy = 0.0;  // J
    std::optional<NewContact> fresh;
  };

  Ended end_joint(std::size_t i) {
    const double none[4] = {0, 0, 0, 0};
    if (!(state_.joint.mode[i] & mode_points)) joint_to_points(model_, state_, branches_, i);
    Ended ended = {patch_energy(model_, state_, branches_, i, true).elastic, {}};
    ended.fresh = clipped(model_.joints[i], model_.points, state_.joint, ended.energy, none);
    return ended;
  }

  Ended end_contact(std::size_t slot, bool clips) {
    Ended ended = {patch_energy(model_, state_, branches_, model_.joints.size() + slot, true).elastic, {}};
    follow_open_contact(state_, slot);
    if (clips)
      ended.fresh = clipped(state_.contacts[slot], state_.contact_points, state_.contact, ended.energy,
                            &state_.contact_slid[4 * slot]);
    return ended;
  }

  std::optional<NewContact> clipped(const Patch& old, const Array<double>& points, const PatchMemory& memory,
                                    double energy, const double* slid) const {
    if (lost(old)) return {};
    const CellPair cells = {old.a, old.b, old.cell_a, old.cell_b};
    std::optional<NewContact> fresh =
        make_contact(model_, state_, joints_, cells, placed_cell(model_, state_, old.a, old.cell_a),
                     placed_cell(model_, state_, old.b, old.cell_b), skin(model_))
            .contact;
    if (!fresh) return {};
    // The same joint, elsewhere: what is left of its law is the unbonded part.
    fresh->patch.law = old.law;
    carry_over(model_, state_, old, points, memory, energy, *fresh);
    fresh->carried_opening = memory.largest[largest_index(place_of(old), 0)];
    const Vec3 before(slid[0], slid[1], slid[2]), after = before + mean_slip(state_, old, points, memory);
    std::copy(after.begin(), after.end(), fresh->slid);
    fresh->slid[3] = std::max(slid[3], before.norm() + memory.largest[largest_index(place_of(old), 1)]);
    return fresh;
  }

  void enter(const Patch& old, Ended ended) {
    energy_before_ += ended.energy;
    ++(ended.fresh ? update_.clipped : update_.dropped);
    if (ended.fresh) clipped_.push_back(std::move(*ended.fresh));
    part(old);
  }

  void add(const NewContact& contact) {
    const std::size_t slot = slots_.add(contact);
    update_.bodies.insert(update_.bodies.end(), {contact.patch.a, contact.patch.b});
    energy_after_ += patch_energy(model_, state_, branches_, model_.joints.size() + slot).elastic;
    if (const auto pair = find_pair(state_, cells_of(contact.patch)))
      state_.pair_seen[searched_width * *pair + 7] = pair_has_contact;
  }

  /// The narrow phase: each pair for itself, what it finds entered in the order of the pairs.
  void examine(const std::vector<std::size_t>& due) {
    PlacedCells placed(model_, state_);
    std::vector<CellPair> cells;
    for (const std::size_t pair : due) {
      const std::int32_t* c = &state_.pair_cells[4 * pair];
      cells.push_back({c[0], c[1], c[2], c[3]});
      placed.need(c[0]), placed.need(c[1]);
    }
    placed.place(threads_);
    std::vector<Examined> found(due.size());
    for_each(due.size(), threads_, 10, [&](std::size_t i) {
      const auto [a, b, cell_a, cell_b] = cells[i];
      // Bodies that a live patch holds within its limits cannot come at each other unseen: their other cells wait until
      // they touch.
      const double within = joined(model_, state_, a, b) ? 0.0 : skin(model_);
      found[i] = make_contact(model_, state_, joints_, cells[i], placed.of(a, cell_a), placed.of(b, cell_b), within);
    });
    update_.examined += std::int64_t(due.size());
    const double least = least_pair_share * skin(model_);
    const double unseen = (2.0 * search_share + moved_share) * skin(model_);
    for_each(due.size(), threads_, 200,
             [&](std::size_t i) { note_examined(model_, state_, due[i], std::max(least, found[i].apart - unseen)); });
    for (const Examined& pair : found) {
      if (!pair.contact) continue;
      add(*pair.contact);
      ++update_.made;
    }
  }

  static constexpr std::size_t least_clipped_per_thread = 3;

  const Model& model_;
  State& state_;
  const Branches& branches_;
  int threads_;
  ContactUpdate update_;
  ContactSlots slots_;
  JointsOfBodies joints_;
  std::vector<char> moved_, stale_;
  bool any_stale_ = false;
  std::vector<NewContact> clipped_;
  double energy_before_ = 0.0, energy_after_ = 0.0;
};

}  // namespace

ContactUpdate update_contacts(const Model& model, State& state, const Branches& branches,
                              std::span<const std::int32_t> past, int threads) {
  ContactUpdate update = Search(model, state, branches, threads).run(past);
  const InterfaceUpdate fill = update_interface(model, state, branches, !past.empty(), threads);
  update.moved = update.changed() || fill.made + fill.dropped > 0;
  update.made += fill.made, update.clipped += fill.clipped, update.dropped += fill.dropped;
  update.bodies.insert(update.bodies.end(), fill.bodies.begin(), fill.bodies.end());
  update.nodes = fill.nodes;
  return update;
}

ContactUpdate update_contacts(const Model& model, State& state, const Branches& branches, bool clip, int threads) {
  std::vector<std::int32_t> tiles(clip ? model.tiles.size() : 0);
  std::iota(tiles.begin(), tiles.end(), 0);
  return update_contacts(model, state, branches, tiles, threads);
}

}  // namespace voussoir
