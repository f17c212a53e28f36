// Pairs of nearby cells without a patch between them: the list for contact searches. The motion of a pair since its
// last examination is measured in the frame of one of its bodies, so that rigid motion of the whole bridge needs no
// examination.
#pragma once
#include <optional>

#include "solver/model/state.h"

namespace voussoir {

/// Special values in State::pair_seen instead of distances (m): never to be examined because a contact exists, or to be
/// examined at once.
constexpr float pair_has_contact = 1e6f, pair_is_new = -1.0f;

/// Lists the pairs of all stale bodies again, from their present positions. Data of continuing pairs are kept.
void list_pairs(const Model& model, State& state, const std::vector<char>& stale, int threads);

/// Whether a body has moved so far since its pairs were listed that it can be near bodies without a listed pair.
bool past_list(const Model& model, const State& state, std::size_t body);

/// Pairs of moved bodies whose relative motion exceeds the allowed distance, in order.
std::vector<std::size_t> due_pairs(const Model& model, const State& state, const std::vector<char>& moved, int threads);

/// Notes that a pair has been examined: it may now move by `allowed` (m).
void note_examined(const Model& model, State& state, std::size_t pair, double allowed);

/// The range of indices of the pairs of two bodies a < b.
std::pair<std::size_t, std::size_t> pairs_of(const State& state, std::int32_t a, std::int32_t b);
/// The pair of these cells, or none if it is not listed.
std::optional<std::size_t> find_pair(const State& state, const CellPair& cells);

/// Whether there is a joint or a contact between two bodies a < b.
bool joined(const Model& model, const State& state, std::int32_t a, std::int32_t b);

}  // namespace voussoir
