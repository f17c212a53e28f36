// Between geometry/decompose.cpp and the library that CGAL is compiled into.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// A closed shape whose corners are known exactly: each is where three planes meet. Faces of more than three corners
/// have all their corners in one of these planes.
struct ExactShape {
  std::vector<std::array<Plane, 3>> corners;
  std::vector<std::vector<int>> faces;  // outward
};

/// Of the library: convex pieces, or why there are none.
using CutShape = void(const ExactShape&, std::vector<Polyhedron>& pieces, std::string& trouble);

}  // namespace voussoir
