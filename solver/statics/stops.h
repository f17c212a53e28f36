// The steps of a quasi-static stage.
#pragma once
#include <vector>

#include "solver/model/settings.h"

namespace voussoir {

/// One equilibrium that is asked for.
struct Stop {
  double way = 0.0;    // of the whole path, 0 to 1
  double share = 0.0;  // of loads and drives
};

/// Every leg of the path from corner to corner in equal steps, as many as its part of the whole way asks for and at
/// least one. The corners themselves are stops; the beginning, share 0, is none.
std::vector<Stop> stops_of(const QuasiStaticSettings& settings);

}  // namespace voussoir
