#include "io/case/limits.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/case/sections.h"

namespace voussoir {

DemandLimit read_limit(TableReader& table) {
  DemandLimit limit;
  limit.name = table.required_text("name");
  limit.demand = table.required_text("demand");
  if (!limit.demand.starts_with("edp.") && !limit.demand.starts_with("damage."))
    table.fail("demand", fmt::format("is \"{}\": expected a column of a campaign's table that begins with \"edp.\" or "
                                     "\"damage.\", such as \"edp.keystone_x\"",
                                     limit.demand));
  limit.threshold = table.required_number("threshold", {0.0, 1e300, "(the column's unit)", true});
  return limit;
}

void read_limits(TableReader& root, Case& c) {
  for (TableReader& table : root.tables("limit_state")) {
    const DemandLimit limit = read_limit(table);
    if (std::ranges::any_of(c.limits, [&](const DemandLimit& other) { return other.name == limit.name; }))
      table.fail("name", fmt::format("\"{}\" stands twice: give each its own", limit.name));
    table.finish();
    c.limits.push_back(limit);
  }
}

}  // namespace voussoir
