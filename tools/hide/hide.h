// Measurements of a bridge that has what its case lacks.
#pragma once
#include "io/measured/measured.h"
#include "tools/hide/request.h"

namespace voussoir {

struct HiddenBridge {
  Measured measured;
  std::string answer;  // text of answer.toml: what was put into the measurements
};

/// Throws InputError for a case without a generator, for what a measurement of the kind asked for cannot show, and for
/// effects whose place the bridge does not have.
HiddenBridge hide(const HideRequest& request);

}  // namespace voussoir
