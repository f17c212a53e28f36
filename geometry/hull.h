// The convex hull of points.
#pragma once
#include "geometry/polyhedron.h"

namespace voussoir {

/// The smallest convex polyhedron that contains all points, as outward triangles, by adding point after point (the
/// beneath-beyond method: Preparata & Shamos 1985, section 3.4.2). Points less than `relative` of the size outside of
/// it are left out. No faces when all points lie within that of one plane.
Polyhedron convex_hull(const std::vector<Vec3>& points, double relative = 1e-9);

}  // namespace voussoir
