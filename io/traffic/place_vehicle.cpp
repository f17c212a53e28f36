#include "io/traffic/place_vehicle.h"

#include <algorithm>

namespace voussoir {

namespace {

constexpr double no_end = 1e6;  // m

/// A rectangle in the frame of the vehicle, x from `from` to `to` backwards, about y.
RoadArea placed(const VehiclePlace& place, double from, double to, double y, double width) {
  from = std::clamp(from, -no_end, no_end), to = std::clamp(to, -no_end, no_end);
  const double side = place.y + (place.towards_right ? y : -y);
  RoadArea area;
  area.x0 = place.towards_right ? place.x - to : place.x + from;
  area.x1 = place.towards_right ? place.x - from : place.x + to;
  area.y0 = side - 0.5 * width, area.y1 = side + 0.5 * width;
  return area;
}

}  // namespace

std::vector<RoadLoad> loads_of(const Vehicle& vehicle, const VehiclePlace& place) {
  std::vector<RoadLoad> loads;
  for (const LoadPatch& p : vehicle.patches)
    loads.push_back({placed(place, p.x - 0.5 * p.length, p.x + 0.5 * p.length, p.y, p.width),
                     p.force / (p.length * p.width), vehicle.name});
  for (const LoadStrip& s : vehicle.strips)
    loads.push_back({placed(place, s.from, s.to, s.y, s.width), s.pressure, vehicle.name});
  return loads;
}

std::vector<RoadLoad> loads_on_strip(const Vehicle& vehicle, const VehiclePlace& place, double width,
                                     double effective) {
  std::vector<RoadLoad> loads;
  for (const LoadPatch& p : vehicle.patches)
    loads.push_back({placed(place, p.x - 0.5 * p.length, p.x + 0.5 * p.length, 0.0, width),
                     p.force / (p.length * effective), vehicle.name});
  for (const LoadStrip& s : vehicle.strips)
    loads.push_back({placed(place, s.from, s.to, 0.0, width), s.pressure * s.width / effective, vehicle.name});
  for (RoadLoad& load : loads) load.area.y0 = -0.5 * width, load.area.y1 = 0.5 * width;
  return loads;
}

}  // namespace voussoir
