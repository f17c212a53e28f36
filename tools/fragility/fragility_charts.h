// Charts of fragility: curves with their bands, and demands against intensities.
#pragma once
#include <string>
#include <vector>

#include "tools/fragility/fragility.h"

namespace voussoir {

/// The curves of one limit against one intensity, one colour for each case; with the shares at the levels, or the runs
/// as marks at the lower edge (within the limit) and the upper edge (beyond it). Empty if there are no runs.
std::string curves_chart(const std::vector<const Fragility*>& curves);

/// Demand against intensity, both logarithmic: the runs, the line with its scatter, the threshold, and collapses at
/// the top. Empty if no demand is above 0.
std::string demand_chart(const std::vector<const Fragility*>& curves);

}  // namespace voussoir
