// Eccentricity of a force on a plane area, relative to its kern.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// The corners of a plane area in order around it, in two axes of its plane from its centroid, m.
using PlaneCorners = std::vector<Eigen::Vector2d>;

/// Second moments of a plane area about its centroid, m4: xx = ∫ x² dA, and so on.
struct SecondMoments {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};
/// By Green's theorem; the sense of the corners does not matter.
SecondMoments second_moments(const PlaneCorners& corners);

/// The eccentricity of a force at `centre` (from the centroid, m) as a share of the depth. Navier's pressure of a force
/// N is N/A (1 + A centreᵀ I⁻¹ x) at x, with the matrix I of second moments. The share is a sixth of the difference
/// between the mean pressure and the lowest pressure at a corner, over the mean. So 1/6 is the border of the kern (no
/// tension) for any shape. For a rectangle with sides b and d the share is |e_b|/b + |e_d|/d: 1/2 at the middle of an
/// edge. 0 for corners that enclose no area.
double eccentricity_over_depth(const PlaneCorners& corners, const Eigen::Vector2d& centre);
/// The same for a plane polygon in space with this unit normal; the force is at `offset` (m) from the centroid.
double eccentricity_over_depth(const Polygon& polygon, const Vec3& normal, const Vec3& offset);

}  // namespace voussoir
