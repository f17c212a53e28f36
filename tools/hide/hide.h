// Artificial measurements of a bridge with effects that its case does not have.
#pragma once
#include "io/measured/measured.h"
#include "tools/hide/request.h"

namespace voussoir {

struct HiddenBridge {
  Measured measured;
  std::string answer;  // text of answer.toml: the effects and deviations in the measurements
};

/// Throws InputError if the kind of measurement cannot show the effects, if a case without a generator cannot have the
/// requested deviations, and if the bridge does not have the places of effects, loosenings or sensors.
HiddenBridge hide(const HideRequest& request);

}  // namespace voussoir
