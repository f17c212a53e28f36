// Limit states of cases and campaigns.
#pragma once
#include "io/case/case.h"
#include "io/toml/table_reader.h"

namespace voussoir {

/// Reads a [[limit_state]]; further keys are left for the caller. Throws InputError "FILE:LINE: …".
DemandLimit read_limit(TableReader& table);

}  // namespace voussoir
