// The case that `rate` loads: without the beam of a loading test, as the whole bridge or as a strip in plane strain.
#pragma once
#include "io/case/case.h"

namespace voussoir {

/// Whether the case is a loading test, that is, a generated bridge with a beam on its road.
bool is_loading_test(const Case& c);
/// The case without the beam, its guides, and all stages from the first that drives it.
Case without_loading_test(const Case& c);

/// The case of a generated bridge (generator "bridge") as a strip: square to its supports, with solid supports, a
/// continuum as fill, the whole weight at once, and the end conditions of the case. `width` in m. Throws InputError
/// for another generator, an imported assembly and a bridge without a fill.
Case strip_case(const Case& c, double width);

/// The changes to the case other than its extent, in words; empty: none.
std::vector<std::string> strip_remarks(const Case& c);

/// Width over which an axle with wheels over `over_wheels` m acts at the crown, m: that width plus 1.5 m plus the
/// cover (CS 454, transverse dispersal), at most the width of the bridge.
double effective_width(double over_wheels, double cover, double bridge_width);

}  // namespace voussoir
