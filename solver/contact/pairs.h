// Pairs of cells that are near each other and have no patch between them: the list that contact searches go through.
// How far a pair has moved since it was last examined is measured in the frame of one of its bodies, so that a bridge
// that sways as a whole asks for nothing.
#pragma once
#include <optional>

#include "solver/model/state.h"

namespace voussoir {

/// Marks in State::pair_seen beside distances (m): never to be examined because a contact holds the pair, or at once.
constexpr float pair_has_contact = 1e6f, pair_is_new = -1.0f;

/// Lists the pairs of all stale bodies anew, from where they are now. What pairs know of each other is kept.
void list_pairs(const Model& model, State& state, const std::vector<char>& stale, int threads);

/// Whether a body has moved so far from where its pairs were listed that it may come near bodies it has no pair with.
bool past_list(const Model& model, const State& state, std::size_t body);

/// Pairs of moved bodies that have moved farther than they may relative to each other, in order.
std::vector<std::size_t> due_pairs(const Model& model, const State& state, const std::vector<char>& moved, int threads);

/// Of a pair that has just been examined: from here it may move by `allowed` (m).
void note_examined(const Model& model, State& state, std::size_t pair, double allowed);

/// The pairs of two bodies a < b: range of indices.
std::pair<std::size_t, std::size_t> pairs_of(const State& state, std::int32_t a, std::int32_t b);
/// The pair of these cells; none if it is not listed.
std::optional<std::size_t> find_pair(const State& state, const CellPair& cells);

/// Whether a joint or a contact holds two bodies a < b together or apart.
bool joined(const Model& model, const State& state, std::int32_t a, std::int32_t b);

}  // namespace voussoir
