// Stored energy of a patch.
#pragma once
#include "solver/contact/jump.h"
#include "solver/model/state.h"

namespace voussoir {

/// Elastic energy of one patch, and of the springs of its branches, J.
struct PatchEnergy {
  double elastic = 0.0, branches = 0.0;
};
/// `index`: of Model::joints, or the number of joints plus the slot of a contact. `yielding`: for use between two patch
/// passes. Shear beyond the friction limit is then reduced to the limit, as in the next pass.
PatchEnergy patch_energy(const Model& model, const State& state, const Branches& branches, std::size_t index,
                         bool yielding = false);

}  // namespace voussoir
