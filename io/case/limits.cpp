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
    table.fail("demand",
               fmt::format("is \"{}\". It must be a column of the table of a campaign that begins with \"edp.\" "
                           "or \"damage.\", such as \"edp.keystone_x\".",
                           limit.demand));
  limit.threshold = table.required_number("threshold", {0.0, 1e300, "(unit of the column)", true});
  return limit;
}

void read_limits(TableReader& root, Case& c) {
  for (TableReader& table : root.tables("limit_state")) {
    const DemandLimit limit = read_limit(table);
    if (std::ranges::any_of(c.limits, [&](const DemandLimit& other) { return other.name == limit.name; }))
      table.fail("name", fmt::format("\"{}\" is given twice. Give each limit state its own name.", limit.name));
    table.finish();
    c.limits.push_back(limit);
  }
}

}  // namespace voussoir
