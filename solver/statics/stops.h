// The increments of a quasi-static stage.
#pragma once
#include <vector>

#include "solver/model/settings.h"

namespace voussoir {

/// One required equilibrium.
struct Stop {
  double way = 0.0;    // position on the whole path, 0 to 1
  double share = 0.0;  // of loads and drives
};

/// Divides every section of the path between two corners into equal increments: a number in proportion to its length,
/// and at least one. The corners are stops; the beginning, share 0, is not.
std::vector<Stop> stops_of(const QuasiStaticSettings& settings);

}  // namespace voussoir
