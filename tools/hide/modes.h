// Modes as they would be measured on the bridge that voussoir hide makes.
#pragma once
#include "io/measured/measured.h"
#include "solver/diagnosis/response.h"
#include "tools/hide/request.h"

namespace voussoir {

/// The lowest modes that are not local as they are, with the standard deviations that a measurement of them has;
/// `ratio` of damping.
std::vector<MeasuredMode> true_modes(const Response& truth, const HideRequest& request, double ratio);
/// The same as they would be measured by these sensors, with the deviations that the measurement says it has.
std::vector<MeasuredMode> measured_modes(const Response& truth, const std::vector<Sensor>& sensors,
                                         const HideRequest& request, double ratio);

/// Sum of squares, in standard deviations, of what fitted materials leave of what is hidden in these modes if all else
/// is known: without noise, with the true mesh, dimensions and stiffness of parts. Half of it is the most that evidence
/// for it can come to.
double trace_of(const Assembly& bare, const Response& truth, const std::vector<Sensor>& sensors,
                const HideRequest& request, double ratio, double bare_ratio);

}  // namespace voussoir
