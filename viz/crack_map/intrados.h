// The intrados of a vault, unrolled: a cylinder developed into the plane (docs/theory/crack-map.md).
#pragma once
#include <vector>

#include "viz/arrangement/measure.h"

namespace voussoir {

/// A vault as a cylinder over the profile of its intrados square to the barrel.
struct Intrados {
  std::int32_t part = 0;         // of component arch
  Vec3 along = Vec3::UnitX();    // unit vector, horizontal, square to the barrel, from left to right
  Vec3 axis = Vec3::UnitY();     // unit, of the barrel, towards y+
  Vec3 origin = Vec3::Zero();    // m, of both axes
  Polygon profile;               // (along, z, 0), m, from the left springing to the right one
  std::vector<double> arc;       // m, from the left springing to each corner of the profile
  double thickness = kNotKnown;  // m, of the vault at its crown

  struct Place {
    double s = 0.0;    // m, along the intrados from the left springing
    double w = 0.0;    // m, along the barrel from the middle of the bridge
    double off = 0.0;  // m, distance from the intrados, not negative
  };
  Place unrolled(const Vec3& x) const;
  double length() const { return arc.back(); }
  /// Whether a point is on the intrados, with a tolerance of a tenth of the thickness of the vault.
  bool holds(const Vec3& x) const;
  /// Share of the span: 0 at the left springing, 1 at the right one.
  double share_of_span(const Vec3& x) const;
};

/// The intrados of every vault for which it can be measured, from left to right.
std::vector<Intrados> find_intrados(const Measures& measures);

}  // namespace voussoir
