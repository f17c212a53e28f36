// The mesh of a deformable fill: orientation, surface, checks and quality.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// Renumbers inverted tetrahedra, so that all have positive volume, because meshing programs differ in the order of
/// nodes. A mesh that overlaps itself stays wrong; check_fill() finds it.
void orient_tets(FillMesh& mesh);

/// Finds the surface: the sorted faces that belong to one tetrahedron only, each beginning with its lowest node. The
/// result does not depend on the order of the tetrahedra.
void find_surface(FillMesh& mesh);

/// Throws InputError, with the place of the fault, for coordinates that are not finite, nodes out of range or unused, a
/// tetrahedron that is inverted or flat (lower than 1e-6 of its longest edge), a face of three tetrahedra, and two
/// tetrahedra on one side of a face. `what` is the beginning of the message: "the fill", or the name of a file.
void check_fill(const FillMesh& mesh, const std::string& what);

/// Throws InputError if the volume of the mesh differs from the expected one (m3) by more than 0.1 %.
void check_volume(const FillMesh& mesh, double expected);

/// Quality of a mesh for the explicit solver, whose time step depends on the smallest height.
struct FillQuality {
  double volume = 0.0;                             // m3
  double longest_edge = 0.0, shortest_edge = 0.0;  // m
  double edge_ratio = 0.0;                         // longest over shortest edge of a tetrahedron, the largest of all
  double smallest_angle = 0.0;                     // rad, between two faces of a tetrahedron
  double smallest_height = 0.0;                    // m, of a corner above the opposite face
  Vec3 lowest = Vec3::Zero();                      // m, centroid of the tetrahedron with that height
};
FillQuality fill_quality(const FillMesh& mesh);

double fill_volume(const FillMesh& mesh);  // m3
Polygon triangle_polygon(const FillMesh& mesh, std::int32_t triangle);

/// The tetrahedron behind each triangle of the surface.
std::vector<std::int32_t> triangle_tets(const FillMesh& mesh);

/// The parts of the mesh that are connected by nodes, as a number for each tetrahedron. Parts count from 0 in the order
/// of their first tetrahedra.
std::vector<std::int32_t> fill_parts(const FillMesh& mesh);

}  // namespace voussoir
