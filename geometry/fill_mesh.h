// The mesh of a deformable fill: its surface, its soundness and its quality.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// Turns every tetrahedron that is numbered the other way round, so that all have positive volume. Programs that mesh
/// differ in this; a mesh that folds over itself does not become sound by it, and check_fill() finds it.
void orient_tets(FillMesh& mesh);

/// Finds the surface: the faces that belong to one tetrahedron only, each beginning with its lowest node, sorted. The
/// same for any order of the tetrahedra.
void find_surface(FillMesh& mesh);

/// Throws InputError that says where: coordinates that are not finite, nodes out of range or unused, a tetrahedron that
/// is inverted or flat (lower than 1e-6 of its longest edge), a face of three tetrahedra, two tetrahedra on one side of
/// a face. `what` begins the message: "the fill", the name of a file.
void check_fill(const FillMesh& mesh, const std::string& what);

/// Throws InputError when the mesh misses the volume that it should have (m3) by more than 0.1 %.
void check_volume(const FillMesh& mesh, double expected);

/// How good a mesh is for the explicit solver, whose step follows the smallest height.
struct FillQuality {
  double volume = 0.0;                             // m3
  double longest_edge = 0.0, shortest_edge = 0.0;  // m
  double edge_ratio = 0.0;                         // longest over shortest edge of one tetrahedron, the worst
  double smallest_angle = 0.0;                     // rad, between two faces of a tetrahedron
  double smallest_height = 0.0;                    // m, of a corner over the face across
  Vec3 lowest = Vec3::Zero();                      // m, centroid of the tetrahedron of that height
};
FillQuality fill_quality(const FillMesh& mesh);

double fill_volume(const FillMesh& mesh);  // m3
Polygon triangle_polygon(const FillMesh& mesh, std::int32_t triangle);

/// The tetrahedron behind each triangle of the surface.
std::vector<std::int32_t> triangle_tets(const FillMesh& mesh);

/// The parts of the mesh that hang together through nodes, as a number for each tetrahedron; parts count from 0 in the
/// order of their first tetrahedron.
std::vector<std::int32_t> fill_parts(const FillMesh& mesh);

}  // namespace voussoir
