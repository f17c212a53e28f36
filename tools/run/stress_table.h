// The table of forces and stresses of the joint patches.
#pragma once
#include <string>

#include "geometry/assembly.h"
#include "solver/statics/joint_stresses.h"

namespace voussoir {

/// The text of stresses.csv (docs/formats.md): one row for each joint patch of an equilibrium. The cell of a value that
/// is not finite is empty.
std::string joint_stress_table(const Assembly& assembly, const RestForces& rest);

}  // namespace voussoir
