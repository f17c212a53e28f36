// Modes as they would be measured on the bridge that voussoir hide makes.
#pragma once
#include "io/measured/measured.h"
#include "solver/diagnosis/response.h"
#include "tools/hide/request.h"

namespace voussoir {

/// The lowest modes that are not local, as they would be measured; `ratio` of damping.
std::vector<MeasuredMode> measured_modes(const Response& truth, const HideRequest& request, double ratio, Noise& noise);

/// Sum of squares, in standard deviations, of what fitted materials leave of the effects in these modes if all else is
/// known: without noise, with the true mesh, dimensions and stiffness of parts. Half of it is the most that evidence
/// for the effects can come to.
double trace_of(const Assembly& bare, const Response& truth, const std::vector<Sensor>& sensors,
                const HideRequest& request, double ratio, double bare_ratio);

}  // namespace voussoir
