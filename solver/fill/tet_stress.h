// The stress of the fill, which the state does not store: computed from its placement and plastic memory.
#pragma once
#include <array>
#include <vector>

#include "solver/model/fill_memory.h"

namespace voussoir {

/// Stress of each tetrahedron, in the order of FillMesh::tets: Cauchy stress xx, yy, zz, xy, yz, xz in world axes, Pa,
/// tension positive. It is the stress of the next time step in the present placement, including the mean volumetric
/// strain about the nodes and plastic flow (docs/theory/fill.md), but without the stress of Maxwell branches, which is
/// damping. The memory does not change.
std::vector<std::array<double, 6>> cauchy_stress(const FillModel& fill, const FillMemory& memory);

}  // namespace voussoir
