// A vehicle on a road: its wheels, sleepers and strips as pressures on rectangles of the road.
#pragma once
#include "io/traffic/vehicle.h"
#include "solver/model/settings.h"

namespace voussoir {

/// The place of the front of a vehicle, and its direction.
struct VehiclePlace {
  double x = 0.0, y = 0.0;    // m, in the axes of the bridge: x of its front, y of its middle line
  bool towards_right = true;  // along +x
};

/// The loads of a vehicle on the road. Strips without an end reach to ±1e6 m; loads beyond the road do not act.
std::vector<RoadLoad> loads_of(const Vehicle& vehicle, const VehiclePlace& place);

/// The same for a strip of a bridge in plane strain, `width` m wide about y = 0: the share of the strip if the load is
/// spread evenly over `effective` m across.
std::vector<RoadLoad> loads_on_strip(const Vehicle& vehicle, const VehiclePlace& place, double width, double effective);

}  // namespace voussoir
