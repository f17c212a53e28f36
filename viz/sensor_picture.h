// A picture of the positions and directions of sensors on a bridge.
#pragma once
#include "viz/render.h"

namespace voussoir {

/// Draws an undeformed assembly with an arrow for each sensor in the direction of positive readings. Title, size, view
/// and hidden components are those of the options. Throws like render_picture().
void draw_sensors(const Assembly& assembly, const std::vector<Sensor>& sensors, RenderOptions options,
                  const std::string& png);

}  // namespace voussoir
