// Measured modes of the true bridge of voussoir hide.
#pragma once
#include "io/measured/measured.h"
#include "solver/diagnosis/response.h"
#include "tools/hide/request.h"

namespace voussoir {

/// The lowest modes that are not local, without errors but with the standard deviations of a measurement; `ratio` is
/// the damping ratio.
std::vector<MeasuredMode> true_modes(const Response& truth, const HideRequest& request, double ratio);
/// The same with measurement errors at these sensors, and with the standard deviations that the measurement states.
std::vector<MeasuredMode> measured_modes(const Response& truth, const std::vector<Sensor>& sensors,
                                         const HideRequest& request, double ratio);

/// Sum of squares, in standard deviations, of the part of the hidden effects in these modes that fitted materials
/// cannot explain, if all else is known: without noise, with the true mesh, dimensions and stiffness of parts. The
/// evidence for the effects is at most half of it.
double trace_of(const Assembly& bare, const Response& truth, const std::vector<Sensor>& sensors,
                const HideRequest& request, double ratio, double bare_ratio);

}  // namespace voussoir
