// Decides when displacements of bodies are checked, and when they require a contact search (docs/theory/contacts.md).
#pragma once
#include "solver/step/body_pass.h"

namespace voussoir {

/// Result of a check: whether contacts are searched now, and the time step of the next check.
struct Look {
  bool search = false;
  std::int64_t next = 0;  // time step of the next check
};
/// A search is required when a body has moved farther than `distance` (m) since its position was noted. Slow bodies
/// near this distance would cause frequent checks, so they require the search somewhat earlier.
Look look(const BodyReport& bodies, std::int64_t step, double distance, double dt);

}  // namespace voussoir
