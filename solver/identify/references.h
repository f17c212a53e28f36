// The channels that all others are correlated with.
#pragma once
#include "solver/identify/prepare.h"

namespace voussoir {

/// Up to `count` columns of the signals, ascending: those that see most of what moves, none twice.
std::vector<int> choose_references(const Prepared& prepared, int count);

}  // namespace voussoir
