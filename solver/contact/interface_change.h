// Updates the interface with the fill after a search: new, reclipped and removed patches, with the memory of their
// points (docs/theory/fill.md).
#pragma once
#include "solver/model/state.h"

namespace voussoir {

/// Result of a search.
struct InterfaceChange {
  std::vector<char> gone;             // of each slot: removed or reclipped
  std::vector<InterfacePatch> fresh;  // reclipped (`from` is their slot) or new (−1)
  double energy_before = 0.0;         // J, elastic energy of the removed and reclipped patches
  bool bonded = false;                // new patches have the bond of their law, else no bond
};

/// Reclipped patches keep their slots, and the slots of removed patches become empty. If there are new patches, all
/// patches are arranged in new batches. The change of elastic energy is added to State::clipped_energy().
void change_interface(const Model& model, State& state, int branches, InterfaceChange change);

}  // namespace voussoir
