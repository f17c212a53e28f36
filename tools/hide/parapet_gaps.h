// Movement joints in the parapets that a case does not have.
#pragma once
#include "geometry/assembly.h"
#include "tools/hide/request.h"

namespace voussoir {

/// Opens the parapets at as many places as the request says, drawn along their length and on either side: from course
/// to course the head joint nearest to the place keeps a thousandth of its stiffness, and so do the bed joints between
/// these. Returns the places in words. Throws InputError for a bridge without parapets that have head joints.
std::vector<std::string> open_parapets(Assembly& assembly, const HideRequest& request);

}  // namespace voussoir
