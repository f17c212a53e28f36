// A vehicle on a road: its wheels, sleepers and strips as pressures on rectangles of the road.
#pragma once
#include "io/traffic/vehicle.h"
#include "solver/model/settings.h"

namespace voussoir {

/// Where the front of a vehicle is, and which way it drives.
struct VehiclePlace {
  double x = 0.0, y = 0.0;    // m, in the axes of the bridge: of its front, of its middle line
  bool towards_right = true;  // along +x
};

/// Strips without an end reach to ±1e6 m: what lies beyond the road does not act.
std::vector<RoadLoad> loads_of(const Vehicle& vehicle, const VehiclePlace& place);

/// The same on a strip of a bridge in plane strain, `width` m wide about y = 0: its share of what is spread evenly over
/// `effective` m across.
std::vector<RoadLoad> loads_on_strip(const Vehicle& vehicle, const VehiclePlace& place, double width, double effective);

}  // namespace voussoir
