// Builds the table of a campaign from its runs: one row for each run, in the order of the plan.
#pragma once
#include "tools/campaign/plan.h"
#include "tools/campaign/table.h"

namespace voussoir::campaign {

/// The table from plan, outcomes and summaries.
CampaignTable gather(const Plan& plan, const std::string& directory);
/// Unit of a column of numbers, for the HDF5 file; empty if the case defines the unit.
std::string unit_of(const Plan& plan, const std::string& column);
/// Writes DIRECTORY/table.csv and table.h5. Throws RunError.
void write_table(const Plan& plan, const std::string& directory);

}  // namespace voussoir::campaign
