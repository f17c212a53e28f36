#pragma once
#include "geometry/assembly.h"
#include "geometry/fill_report.h"

namespace voussoir {

/// Prints counts and masses by component, the smallest and largest block, the fixed blocks, and the deformable fill.
void print_assembly_table(const Assembly& assembly, const FillAim& aim = {});

}  // namespace voussoir
