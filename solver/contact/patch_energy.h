// What a patch stores.
#pragma once
#include "solver/contact/jump.h"
#include "solver/model/state.h"

namespace voussoir {

/// Elastic energy of one patch with its branches' springs, J.
struct PatchEnergy {
  double elastic = 0.0, branches = 0.0;
};
/// `yielding`: between a patch pass and the next, shear past the cone is cut back to it, as the next pass will do.
PatchEnergy patch_energy(const Model& model, const State& state, const Branches& branches, std::size_t index,
                         bool yielding = false);

}  // namespace voussoir
