// When to look how far bodies have moved, and when that calls for a search of contacts (docs/theory/contacts.md).
#pragma once
#include "solver/step/body_pass.h"

namespace voussoir {

/// What was seen of the bodies at the end of a round: whether contacts are looked for now, and when to look again.
struct Look {
  bool search = false;
  std::int64_t next = 0;  // step
};
/// Bodies call for a search when one has moved farther than `distance` (m) since its place was noted. Slow ones that
/// stand near the distance for long would have rounds cut short: they call for one somewhat earlier.
Look look(const BodyReport& bodies, std::int64_t step, double distance, double dt);

}  // namespace voussoir
