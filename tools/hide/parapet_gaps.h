// Movement joints in the parapets that the case does not have.
#pragma once
#include "geometry/assembly.h"
#include "tools/hide/request.h"

namespace voussoir {

/// Opens the parapets at the requested number of places, drawn along their length and on either side. In each course
/// the head joint nearest to the place keeps a thousandth of its stiffness, and so do the bed joints between these
/// head joints. Returns the places in words. Throws InputError for a bridge without parapets with head joints.
std::vector<std::string> open_parapets(Assembly& assembly, const HideRequest& request);

}  // namespace voussoir
