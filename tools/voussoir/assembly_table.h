#pragma once
#include "geometry/assembly.h"
#include "geometry/fill_report.h"

namespace voussoir {

/// Counts and masses by component, smallest and largest block, what is fixed, and the deformable fill.
void print_assembly_table(const Assembly& assembly, const FillAim& aim = {});

}  // namespace voussoir
