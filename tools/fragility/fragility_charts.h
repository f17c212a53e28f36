// Charts of fragility: curves with their bands, and demands over intensities.
#pragma once
#include <string>
#include <vector>

#include "tools/fragility/fragility.h"

namespace voussoir {

/// The curves of one limit, a colour a case, over one intensity; the shares at the levels, or the runs as a rug: within
/// below, beyond above. Empty where there are no runs at all.
std::string curves_chart(const std::vector<const Fragility*>& curves);

/// Demand over intensity, both logarithmic: the runs, the line with its scatter, the threshold; collapses at the top.
/// Empty where no demand is above 0.
std::string demand_chart(const std::vector<const Fragility*>& curves);

}  // namespace voussoir
