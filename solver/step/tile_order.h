// Which tiles wait for which in a step.
#pragma once
#include "solver/base/parallel.h"
#include "solver/model/state.h"

namespace voussoir {

/// The tiles of bodies, then those of the fill. A tile's bodies may move once no tile before it still has to read them.
Dependencies order_of_tiles(const Model& model, const State& state);

}  // namespace voussoir
