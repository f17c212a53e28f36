// Makes clean convex cells from imported surfaces, and checks them.
#pragma once
#include <string>

#include "geometry/polyhedron.h"

namespace voussoir {

/// Merges neighbouring faces of a closed surface into one polygon if their normals differ by at most `angle` (rad) from
/// that of the largest face, joins vertices closer than 1e-6 of the shape's size, and drops vertices on straight edges
/// and collapsed faces. For closed convex surfaces given as triangles (STL, VTK); faces that do not merge into a single
/// loop stay as they are. The order of the result does not depend on the triangles' order beyond ties in size.
Polyhedron merge_coplanar_faces(const Polyhedron& triangulated, double angle);

/// Empty if the shape is a closed convex polyhedron with finite vertices, planar faces that look outwards and a volume;
/// otherwise a text with the fault and its place. Planes hold to 1e-6 of the shape's size.
std::string convexity_error(const Polyhedron& shape);

}  // namespace voussoir
