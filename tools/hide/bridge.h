// The true bridge of voussoir hide. It differs from the case in the ways of a real survey.
#pragma once
#include "io/case/case.h"
#include "tools/hide/request.h"

namespace voussoir {

/// The true bridge without the hidden effects and loosenings of the request: other values of generator keys, another
/// block size, other dimensions, and another stiffness of each material and part. A case without a generator keeps its
/// blocks and dimensions. Throws InputError for a key or value that the generator does not accept.
Assembly hidden_bridge(const Case& model, const HideRequest& request);

}  // namespace voussoir
