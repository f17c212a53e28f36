// The table of a campaign from its runs: one row a run, in the plan's order.
#pragma once
#include "tools/campaign/plan.h"
#include "tools/campaign/table.h"

namespace voussoir::campaign {

/// Of plan, outcomes and summaries.
CampaignTable gather(const Plan& plan, const std::string& directory);
/// Of a column of numbers, for the HDF5 file; empty where the case says it.
std::string unit_of(const Plan& plan, const std::string& column);
/// DIRECTORY/table.csv and table.h5. Throws RunError.
void write_table(const Plan& plan, const std::string& directory);

}  // namespace voussoir::campaign
