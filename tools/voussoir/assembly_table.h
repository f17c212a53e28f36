#pragma once
#include "geometry/assembly.h"

namespace voussoir {

/// Counts and masses by component, smallest and largest block, what is fixed.
void print_assembly_table(const Assembly& assembly);

}  // namespace voussoir
