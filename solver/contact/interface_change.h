// Patches with the fill that a search has made, clipped anew or dropped take their places in the interface, with what
// their points remember (docs/theory/fill.md).
#pragma once
#include "solver/model/state.h"

namespace voussoir {

/// What a search found.
struct InterfaceChange {
  std::vector<char> gone;             // of each slot: dropped, or clipped anew
  std::vector<InterfacePatch> fresh;  // clipped anew (`from` is their slot), or made (−1)
  double energy_before = 0.0;         // J, elastic, of the patches that are gone
  bool bonded = false;                // those made have the bond of their law, else none
};

/// Clipped patches take the places of those they come from and dropped ones leave theirs empty; if any has been made,
/// all are put into batches anew. Elastic energy that is lost or won goes to State::clipped_energy().
void change_interface(const Model& model, State& state, int branches, InterfaceChange change);

}  // namespace voussoir
