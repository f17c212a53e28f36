// Searches for patches between stones and fill that appear, change and disappear during a run (docs/theory/fill.md).
#pragma once
#include "solver/model/state.h"

namespace voussoir {

struct InterfaceUpdate {
  std::int64_t made = 0, clipped = 0, dropped = 0;
  std::vector<std::int32_t> bodies, nodes;  // of the model, with a new or reclipped patch; repetitions are possible
  bool changed() const { return made + clipped + dropped > 0; }
};

/// Searches around the parts that have moved since the last search for faces of stones near triangles of the surface of
/// the fill, and removes patches without overlap. With `clip`, patches that have slid past the limit of the model are
/// reclipped: tractions are transferred, and the change of elastic energy with the area is added to
/// State::clipped_energy(). The result depends only on the state, for any number of threads. Call
/// Stepper::prepare_contacts() afterwards if patches were added or removed; reclipped patches keep their slots.
InterfaceUpdate update_interface(const Model& model, State& state, const Branches& branches, bool clip,
                                 int threads = 1);

}  // namespace voussoir
