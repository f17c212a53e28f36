// How far the centre of a pressure lies off the middle of a plane area, measured against its kern.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// A plane area by its corners, one after the other round it, in two axes of its plane from its centroid, m.
using PlaneCorners = std::vector<Eigen::Vector2d>;

/// Second moments of a plane area about its centroid, m4: xx = ∫ x² dA, and so on.
struct SecondMoments {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};
/// By Green's theorem; the same for either sense of the corners.
SecondMoments second_moments(const PlaneCorners& corners);

/// The eccentricity of a force that goes through `centre` (from the centroid, m), as a share of the depth. Navier's
/// pressure of a force N is N/A (1 + A centreᵀ I⁻¹ x) at x, with the matrix I of second moments; the share is a sixth
/// of how much it falls from the mean to the least corner, over the mean. So 1/6 is the border of the kern (no tension
/// anywhere) for any shape, and of a rectangle with sides b, d it is |e_b|/b + |e_d|/d: 1/2 at the middle of an edge.
double eccentricity_over_depth(const PlaneCorners& corners, const Eigen::Vector2d& centre);
/// The same in space: of a plane polygon with this unit normal, `offset` (m) from its centroid.
double eccentricity_over_depth(const Polygon& polygon, const Vec3& normal, const Vec3& offset);

}  // namespace voussoir
