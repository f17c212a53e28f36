// Dependencies between tiles in a time step.
#pragma once
#include "solver/base/parallel.h"
#include "solver/model/state.h"

namespace voussoir {

/// Tiles of bodies come first, then those of the fill. The bodies of a tile can move when no earlier tile still has to
/// read them.
Dependencies order_of_tiles(const Model& model, const State& state);

}  // namespace voussoir
