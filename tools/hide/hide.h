// Measurements of a bridge that has what its case lacks.
#pragma once
#include "io/measured/measured.h"
#include "tools/hide/request.h"

namespace voussoir {

struct HiddenBridge {
  Measured measured;
  std::string answer;  // text of answer.toml: what was put into the measurements
};

/// Throws InputError for what a measurement of the kind asked for cannot show, for what a case without a generator
/// cannot have otherwise, and for effects, loosenings and sensors whose place the bridge does not have.
HiddenBridge hide(const HideRequest& request);

}  // namespace voussoir
