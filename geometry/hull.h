// The convex hull of points.
#pragma once
#include "geometry/polyhedron.h"

namespace voussoir {

/// The smallest convex polyhedron that contains all points, as outward triangles, by adding point after point (the
/// beneath-beyond method: Preparata & Shamos 1985, section 3.4.2). Points that lie outside it by less than `relative`
/// times the diagonal of the box around all points are left out. The result has no faces if all points lie within that
/// distance of one plane.
Polyhedron convex_hull(const std::vector<Vec3>& points, double relative = 1e-9);

}  // namespace voussoir
