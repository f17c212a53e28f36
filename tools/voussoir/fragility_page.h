// The page that voussoir fragility writes.
#pragma once
#include <string>

#include "tools/voussoir/fragility_report.h"

namespace voussoir {

std::string fragility_page(const std::string& title, const FragilityReport& report);

/// The curves of each limit, in the report's order.
std::vector<std::vector<const Fragility*>> by_limit(const std::vector<Fragility>& curves);

}  // namespace voussoir
