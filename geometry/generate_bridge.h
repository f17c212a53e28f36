// The keys of the two bridges.
#pragma once
#include "geometry/generator.h"

namespace voussoir {

/// Keys with the defaults of cs1 or of cs2; those marked * in their help are fitted or assumed.
std::vector<Parameter> bridge_parameters(bool cs1);

/// Space that the backfill of a bridge takes up, m3, from its keys alone.
double bridge_fill_space(const GeneratorInput& input);

}  // namespace voussoir
