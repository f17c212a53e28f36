// Small campaigns of runs that take well below a second, and what their tables say.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "tests/whole/cases.h"

namespace voussoir::test {

/// Rows of a CSV file, quotes undone; the first is the heading.
std::vector<std::vector<std::string>> csv_rows(const std::string& text);
/// A campaign's table by run and column.
using Rows = std::map<std::string, std::map<std::string, std::string>>;
Rows table_of(const std::string& directory);
/// The table's bytes without the column of wall time.
std::string table_but_seconds(const std::string& directory);

/// A campaign of a wall (wall.toml in the folder), a column that falls, and a case that no run can begin, under two
/// records whose names are full of traps. Returns its file.
std::string write_campaign(const Folder& folder, const std::string& name = "campaign.toml",
                           const std::string& more = "");
/// What that campaign must have come to.
void expect_whole_campaign(const std::string& directory);

/// A wall under `records` pulses, with checkpoints every 0.1 s of 1 s: something to interrupt.
std::string write_long_campaign(const Folder& folder, int records, const std::string& engine = "");

/// Ids of processes that have `word` among their arguments.
std::vector<int> processes_with(const std::string& word);

}  // namespace voussoir::test
