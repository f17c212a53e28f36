// Makes the faces of stones plane if they are drawn with few decimals or slightly warped.
#pragma once
#include <optional>

#include "geometry/polyhedron.h"

namespace voussoir {

struct Flattened {
  Polyhedron shape;    // closed, convex, its faces plane
  double moved = 0.0;  // m: largest displacement of a corner
  double tilt = 0.0;   // rad: upper bound of the rotation of a face
};

/// A closed, nearly convex shape made convex with plane faces. Neighbouring faces whose corners all lie within
/// `allowed` (m) of one plane become one face in the least-squares plane of its corners, so that stones with the same
/// corners get the same plane. Corners are the intersections of planes. Empty if a face is farther than `allowed` from
/// its plane, or if a corner would move by more than three times `allowed`, which would change the shape.
std::optional<Flattened> flatten(const Polyhedron& shape, double allowed);

}  // namespace voussoir
