// The interface between geometry/decompose.cpp and the library with CGAL.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// A closed shape with exact corners: each is the intersection of three planes. All corners of a face with more than
/// three corners are in one of these planes.
struct ExactShape {
  std::vector<std::array<Plane, 3>> corners;
  std::vector<std::vector<int>> faces;  // outward
};

/// The function of the library: returns convex pieces, or the reason why there are none.
using CutShape = void(const ExactShape&, std::vector<Polyhedron>& pieces, std::string& trouble);

}  // namespace voussoir
