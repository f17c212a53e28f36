// The generators, one file each (generate_NAME.cpp; cs1 and cs2 share generate_cs.cpp); listed in generator.cpp.
#pragma once
#include "geometry/generator.h"
#include "solver/base/constants.h"

namespace voussoir {

Generator cs1_generator();          // four-span road bridge, leaf and infill (S. Chiara)
Generator cs2_generator();          // three-span road bridge, solid piers (Gresal)
Generator bridge_generator();       // any number of spans of any shape
Generator arch_generator();         // one ring of voussoirs between fixed springings
Generator wall_generator();         // running-bond wall of equal blocks
Generator column_generator();       // stack of equal blocks
Generator filled_arch_generator();  // strip of an arch bridge with a deformable fill and a loading beam

/// Materials of the case: first those of the generator in its order, so that it knows their indices, then materials
/// that only the case has, by name.
std::vector<Material> in_order(const std::vector<Material>& defaults, const GeneratorInput& input);

}  // namespace voussoir
