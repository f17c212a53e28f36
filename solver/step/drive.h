// Fixed blocks that the stages of a run move.
#pragma once
#include "geometry/assembly.h"
#include "solver/step/settings.h"

namespace voussoir {

/// Throws InputError when a stage drives a group that the assembly does not have, a block that is not fixed, or a block
/// twice.
void check_drives(const Assembly& assembly, const std::vector<StageSettings>& stages);

}  // namespace voussoir
