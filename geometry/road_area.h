// A rectangle of the road, in plan.
#pragma once

namespace voussoir {

struct RoadArea {
  double x0 = 0.0, x1 = 0.0;  // m, along the bridge
  double y0 = 0.0, y1 = 0.0;  // m, across
  double area() const { return (x1 - x0) * (y1 - y0); }
};

}  // namespace voussoir
