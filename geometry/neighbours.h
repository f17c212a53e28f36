// Broad phase: which boxes meet.
#pragma once
#include <utility>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// Pairs (i, j), i < j, of boxes that come within `distance` (m) of each other along all three axes, sorted. Negative
/// distances ask for boxes that interpenetrate by more than that. Sweep along the axis on which the boxes spread most
/// (after Baraff 1992), column by column of a grid across it, so that the time grows with the number of boxes however
/// many stand side by side (after Tracy, Buss & Woods 2009).
std::vector<std::pair<int, int>> neighbours(const std::vector<Box>& boxes, double distance);

}  // namespace voussoir
