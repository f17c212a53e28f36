#include "viz/sensor_picture.h"

#include <fmt/format.h>

#include "io/vtk/grid.h"
#include "solver/base/counted.h"

namespace voussoir {

void draw_sensors(const Assembly& assembly, const std::vector<Sensor>& sensors, RenderOptions options,
                  const std::string& png) {
  options.colour = "component";
  options.amplification = 0.0;
  options.cracks = false;
  for (const Sensor& s : sensors) options.arrows.push_back({s.position, s.direction, s.id});
  options.notes = {counted(sensors.size(), "channel"), "arrows point in the direction of positive readings"};
  render_picture(assembly, rest_snapshot(assembly), options, png);
}

}  // namespace voussoir
