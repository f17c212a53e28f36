// Checks whether joints of the composite law can be computed with their stiffness.
#pragma once
#include "geometry/assembly.h"

namespace voussoir {

/// Throws InputError for the first joint whose compressive energy is too small for its stiffness, so that it would snap
/// back when it crushes, and for joints of that law with a deformable fill, whose points cannot crush.
void check_composite_joints(const Assembly& assembly);

}  // namespace voussoir
