// What joint patches carry, as a table.
#pragma once
#include <string>

#include "geometry/assembly.h"
#include "solver/statics/joint_stresses.h"

namespace voussoir {

/// stresses.csv (docs/formats.md): a row a joint patch of an equilibrium. Cells of what is not finite are empty.
std::string joint_stress_table(const Assembly& assembly, const RestForces& rest);

}  // namespace voussoir
