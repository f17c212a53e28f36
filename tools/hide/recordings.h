// What instruments would record on a bridge that voussoir hide makes: ambient vibration, or an earthquake.
#pragma once
#include "io/measured/measured.h"
#include "solver/diagnosis/response.h"
#include "tools/hide/request.h"

namespace voussoir {

/// Ambient vibration: each mode under white noise of its own, exact for forces that are constant within a step, and
/// noise of each channel's own. `ratio` of damping; channels have no names yet.
Recording ambient(const Response& response, const std::vector<Sensor>& sensors, const HideRequest& request,
                  double ratio);

/// A synthetic earthquake, recorded at the sensors and then, in the last three columns, on the ground: each sensor
/// follows the ground (and supports that go astray, as far as it hangs on them) and the modes resonate. The response is
/// that of the model and the memory, with participation.
Recording earthquake(const Assembly& assembly, const LinearModel& model, const Response& response,
                     const EigenMemory& memory, const std::vector<Sensor>& sensors, const HideRequest& request,
                     double ratio);

/// Channels whose clocks are late: read between their samples (cubic, Catmull and Rom 1974).
void set_clocks(const HideRequest& request, const std::vector<MeasuredSensor>& sensors, Recording& record);

}  // namespace voussoir
