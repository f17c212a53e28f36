// Stones whose faces are not quite plane: drawn with few decimals, or slightly warped.
#pragma once
#include <optional>

#include "geometry/polyhedron.h"

namespace voussoir {

struct Flattened {
  Polyhedron shape;    // closed, convex, its faces plane
  double moved = 0.0;  // m: the farthest that a corner went
  double tilt = 0.0;   // rad: how far a face may have turned
};

/// A closed, nearly convex shape made convex with plane faces. Neighbouring faces whose corners all lie within
/// `allowed` (m) of one plane become one face, in the plane that fits its corners best (least squares), so that stones
/// with the same corners get the same plane; corners are where planes meet. Empty when a face is farther from its plane
/// than that, or a corner would go farther than three times that: the shape is another one then.
std::optional<Flattened> flatten(const Polyhedron& shape, double allowed);

}  // namespace voussoir
