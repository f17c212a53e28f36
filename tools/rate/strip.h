// A bridge as a strip in plane strain: what `rate --strip` loads.
#pragma once
#include "io/case/case.h"

namespace voussoir {

/// The case of a generated bridge (generator "bridge") as a strip: square to its supports, solid supports, a continuum
/// as its fill, all its weight at once, restrained ends as the case has them. `width` in m. Throws InputError for
/// another generator, an imported assembly and a bridge without a fill.
Case strip_case(const Case& c, double width);

/// What was changed beside the extent, in words; empty: nothing.
std::vector<std::string> strip_remarks(const Case& c);

/// Width over which an axle of wheels `over_wheels` m wide is spread at the crown, m: as much and 1.5 m more and the
/// cover (CS 454, dispersal across), at most the width of the bridge.
double effective_width(double over_wheels, double cover, double bridge_width);

}  // namespace voussoir
