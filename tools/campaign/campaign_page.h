// The page of a campaign: one HTML file to look at, to print and to send on.
#pragma once
#include <string>

namespace voussoir {

/// DIRECTORY/report.html from table.csv and the runs' pictures: displacements against peak ground acceleration, the
/// damage of the worst record for each case, tables of runs and of damage, what failed. Throws InputError where the
/// table is missing or damaged.
void write_campaign_page(const std::string& directory);

}  // namespace voussoir
