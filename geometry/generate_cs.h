// The keys of the generators cs1 and cs2.
#pragma once
#include "geometry/generator.h"

namespace voussoir {

/// Keys with the defaults of cs1 or of cs2; those marked * in their help are fitted or assumed.
std::vector<Parameter> bridge_parameters(bool cs1);

}  // namespace voussoir
