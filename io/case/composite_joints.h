// Whether joints of the composite law can be computed with the stiffness they have.
#pragma once
#include "geometry/assembly.h"

namespace voussoir {

/// Throws InputError for the first joint whose compressive energy is too small for its stiffness, so that it would snap
/// back as it crushes, and for joints of that law beside a deformable fill, which have no points that crush.
void check_composite_joints(const Assembly& assembly);

}  // namespace voussoir
