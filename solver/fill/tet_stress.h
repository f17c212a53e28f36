// The stress of the fill, which no state holds: read off its placement and plastic memory.
#pragma once
#include <array>
#include <vector>

#include "solver/model/fill_memory.h"

namespace voussoir {

/// Of each tetrahedron, in the order of FillMesh::tets: Cauchy stress xx, yy, zz, xy, yz, xz in world axes, Pa, tension
/// positive. It is what the next step takes at the present placement, the mean volumetric strain about the nodes and
/// plastic flow included (docs/theory/fill.md), but for the stress of Maxwell branches, which is damping. The memory
/// does not change.
std::vector<std::array<double, 6>> cauchy_stress(const FillModel& fill, const FillMemory& memory);

}  // namespace voussoir
