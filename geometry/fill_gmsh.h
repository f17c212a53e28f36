// Tetrahedra from Gmsh: meshing the space of a fill, and meshes made elsewhere. All use of Gmsh is behind this header.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "geometry/masonry.h"

namespace voussoir {

/// The space of a fill: boxes that may touch and do not overlap in the plane x-z, less what lies below the extrados of
/// rings that stand in their height.
struct FillSpace {
  std::vector<Box> boxes;
  std::vector<Ring> rings;
};

/// How the space is meshed. The defaults are what gave the largest smallest height: docs/theory/geometry.md.
struct FillMeshing {
  double edge = 0.5;          // m, bound of the longest edge
  double layer_share = 0.55;  // of the bound: thickness of a layer, at most; the section gets what it leaves
  double first_share = 0.90;  // of the section's bound: size that Gmsh is asked for in the first round
  int rounds = 12;            // at most; each asks for a smaller size than the last
  int algorithm = 6;          // Gmsh's Mesh.Algorithm: 5 Delaunay, 6 frontal-Delaunay
  int smoothing = 10;         // steps of Gmsh's smoother
};

struct MeshedFill {
  FillMesh mesh;         // oriented, with its surface; every tetrahedron of material 0
  int rounds = 0;        // that were needed, or all when the bound was not reached
  double size = 0.0;     // m, asked for in the last
  double longest = 0.0;  // m, edge: above the bound when that was not reached
};

/// Meshes the section of the space with triangles and sweeps them across: the same bits for the same input. Throws
/// RunError when Gmsh fails.
MeshedFill mesh_fill(const FillSpace& space, const FillMeshing& meshing = {});

/// Reads the 4-node tetrahedra of a Gmsh file (.msh, version 2.2 or 4.1) with `scale` m per unit; points, lines and
/// surfaces are passed over. Nodes in the order of the file, oriented, with the surface; every tetrahedron of material
/// 0. Throws InputError for another kind of file, other solid elements, none at all, or a mesh that check_fill()
/// refuses.
FillMesh read_gmsh(const std::string& path, double scale = 1.0);

}  // namespace voussoir
