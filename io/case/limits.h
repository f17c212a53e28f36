// Limit states of cases and campaigns.
#pragma once
#include "io/case/case.h"
#include "io/toml/table_reader.h"

namespace voussoir {

/// A [[limit_state]]; further keys are left for the caller. Throws InputError with its place.
DemandLimit read_limit(TableReader& table);

}  // namespace voussoir
