// How much of the bond of each part of a structure is lost.
#pragma once
#include <vector>

#include "geometry/assembly.h"
#include "solver/model/state.h"

namespace voussoir {

/// Whether a joint of this law begins with a bond that it can lose; elastic ones count, though they never do.
bool has_bond(const LawConstants& law);

/// Components with joints that began with tensile strength or cohesion, in the order of the enumeration.
std::vector<Component> bonded_components(const Assembly& assembly);

/// Share of the area of those joints whose bond is lost now, 0 to 1; in the order of `components`. A joint counts for
/// the components on both its sides. Summed joint after joint in the assembly's order: the same bits after a restart.
std::vector<double> broken_shares(const Assembly& assembly, const Model& model, const State& state,
                                  const std::vector<Component>& components);

}  // namespace voussoir
