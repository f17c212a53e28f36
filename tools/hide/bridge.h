// The bridge that voussoir hide measures: not quite the one that its case describes.
#pragma once
#include "io/case/case.h"
#include "tools/hide/request.h"

namespace voussoir {

/// The bridge as it is, without what is hidden (the request's effects and loosenings): the generator's keys that are
/// otherwise, other blocks, other dimensions, other stiffness in each material and part. Of a case without a generator
/// the blocks and dimensions stay. Throws InputError for a key or value the generator does not take.
Assembly hidden_bridge(const Case& model, const HideRequest& request);

}  // namespace voussoir
