// The table of a campaign: one row a run, in the plan's order (docs/formats.md says what the columns are).
#pragma once
#include "tools/campaign/plan.h"

namespace voussoir::campaign {

struct TextColumn {
  std::string name;
  std::vector<std::string> cells;
};
struct ValueColumn {
  std::string name, unit;
  std::vector<double> cells;  // NaN: none
};
struct Table {
  std::vector<TextColumn> texts;    // run, case, record, event, sample, status, reason
  std::vector<ValueColumn> values;  // scale, seconds, material.*, im.*, edp.*, damage.*
  std::vector<std::string> order;   // of all columns
};

/// Of plan, outcomes and summaries.
Table gather(const Plan& plan, const std::string& directory);
/// RFC 4180 with a heading; no value is an empty cell.
std::string csv_of(const Table& table);
/// DIRECTORY/table.csv and table.h5. Throws RunError.
void write_table(const Plan& plan, const std::string& directory);

}  // namespace voussoir::campaign
