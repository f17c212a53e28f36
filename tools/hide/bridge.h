// The bridge that voussoir hide measures: not quite the one that its case describes.
#pragma once
#include "io/case/case.h"
#include "tools/hide/request.h"

namespace voussoir {

/// The bridge as it is, without the request's effects: other blocks, other dimensions, other stiffness in each part.
/// Throws InputError for a case without a generator.
Assembly hidden_bridge(const Case& model, const HideRequest& request, Noise& noise);

}  // namespace voussoir
