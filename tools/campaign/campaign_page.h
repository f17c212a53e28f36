// The page of a campaign: one HTML file.
#pragma once
#include <string>

namespace voussoir {

/// Writes DIRECTORY/report.html from table.csv and the pictures of the runs: displacements against peak ground
/// acceleration, the damage under the worst record for each case, tables of runs and of damage, and failed runs.
/// Throws InputError if the table is missing or damaged.
void write_campaign_page(const std::string& directory);

}  // namespace voussoir
