// The page that voussoir fragility writes.
#pragma once
#include <string>

#include "tools/fragility/fragility_report.h"

namespace voussoir {

std::string fragility_page(const std::string& title, const FragilityReport& report);

}  // namespace voussoir
