// A picture of where sensors are on a bridge, and along what they measure.
#pragma once
#include "viz/render.h"

namespace voussoir {

/// Draws an assembly at rest with an arrow for each sensor, which points to where its readings are positive. Title,
/// size, view and hidden components are those of the options. Throws as render_picture().
void draw_sensors(const Assembly& assembly, const std::vector<Sensor>& sensors, RenderOptions options,
                  const std::string& png);

}  // namespace voussoir
