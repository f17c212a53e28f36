// Patches between stones and fill that appear, change and vanish during a run (docs/theory/fill.md).
#pragma once
#include "solver/model/state.h"

namespace voussoir {

struct InterfaceUpdate {
  std::int64_t made = 0, clipped = 0, dropped = 0;
  std::vector<std::int32_t> bodies, nodes;  // (of the model) that have got a patch, some more than once
  bool changed() const { return made + clipped + dropped > 0; }
};

/// Looks for stones' faces that triangles of the fill's surface have come near, around what has moved since it was last
/// looked at, and drops patches whose overlap is gone; with `clip`, patches that have slid past the model's limit are
/// clipped anew: tractions are carried over, elastic energy that is lost or won with area is put to
/// State::clipped_energy(). Decided by the state alone, whatever the number of threads. Afterwards
/// Stepper::prepare_contacts() must be called if some were made or dropped: those that are clipped keep their places.
InterfaceUpdate update_interface(const Model& model, State& state, const Branches& branches, bool clip,
                                 int threads = 1);

}  // namespace voussoir
