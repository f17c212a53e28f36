// A case as `rate` loads it: without the beam of a loading test, whole or as a strip in plane strain.
#pragma once
#include "io/case/case.h"

namespace voussoir {

/// Whether the case is a loading test: a generated bridge with a beam on its road.
bool is_loading_test(const Case& c);
/// Without the beam, its guides, and the stages from the first that drives it on.
Case without_loading_test(const Case& c);

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
