// Artificial recordings of the true bridge: ambient vibration, or an earthquake.
#pragma once
#include "io/measured/measured.h"
#include "solver/diagnosis/response.h"
#include "tools/hide/request.h"

namespace voussoir {

/// Ambient vibration: each mode under its own white noise, exact for forces that are constant within a time step, plus
/// independent noise of each channel. `ratio` is the damping ratio. The channels have no names yet.
Recording ambient(const Response& response, const std::vector<Sensor>& sensors, const HideRequest& request,
                  double ratio);

/// A synthetic earthquake, recorded at the sensors and, in the last three columns, on the ground. The motion of each
/// sensor is the sum of the ground motion, the resonant modes and the influence of supports that move differently, with
/// noise. `response` must be that of the model and the memory, with participation.
Recording earthquake(const Assembly& assembly, const LinearModel& model, const Response& response,
                     const EigenMemory& memory, const std::vector<Sensor>& sensors, const HideRequest& request,
                     double ratio);

/// Delays the channels with late clocks, by interpolation between samples (cubic, Catmull and Rom 1974).
void set_clocks(const HideRequest& request, const std::vector<MeasuredSensor>& sensors, Recording& record);

}  // namespace voussoir
