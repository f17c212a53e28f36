// Selects the reference channels, with which all channels are correlated.
#pragma once
#include "solver/identify/prepare.h"

namespace voussoir {

/// Up to `count` columns of the signals, ascending: those with the largest and least collinear motion.
std::vector<int> choose_references(const Prepared& prepared, int count);

}  // namespace voussoir
