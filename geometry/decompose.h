// Cuts a shape that is not convex into convex pieces. Only the implementation of this header uses CGAL.
#pragma once
#include "geometry/polyhedron.h"

namespace voussoir {

/// Cuts a closed shape with outward faces, plane to 1e-6 of its size, into convex pieces that do not overlap: exact
/// decomposition along the edges where faces meet at more than 180 degrees (Hachenberger 2007, Nef polyhedra of CGAL),
/// then pieces whose union is convex are joined again, largest common face first. The pieces' volumes add up to that of
/// the shape to 1e-6 of it. Throws InputError if the program was built without CGAL (the message names the package),
/// if CGAL cannot cut the shape (it intersects itself), and if the volumes do not add up. Throws RunError if the
/// library with CGAL cannot be loaded.
std::vector<Polyhedron> decompose(const Polyhedron& shape);

}  // namespace voussoir
