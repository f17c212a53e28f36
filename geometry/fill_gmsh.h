// Tetrahedra from Gmsh: meshing the space of a fill. All use of Gmsh is behind this header; files are read by io/msh.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "geometry/masonry.h"

namespace voussoir {

/// The space of a fill: boxes that may touch and do not overlap in the plane x-z, less what lies below the extrados of
/// rings that stand in their height, and less other polygons.
struct FillSpace {
  std::vector<Box> boxes;
  std::vector<std::int32_t> materials;  // of each box; empty: all 0. Tetrahedra end where it changes.
  std::vector<Ring> rings;
  std::vector<Polygon> beside;  // polygons in the plane x-z that are not part of it
};

/// How the space is meshed. The defaults are what gave the fewest tetrahedra: docs/theory/geometry.md.
struct FillMeshing {
  double edge = 0.5;         // m, bound of the longest edge
  double layer_share = 0.8;  // of the bound: thickness of a layer, at most; the section gets what it leaves
  double rim_share = 0.85;   // of the section's bound: size that Gmsh is asked for between the lattice and the rim
};

/// Meshes the section of the space with triangles and sweeps them across: oriented, with its surface, every tetrahedron
/// of the material of its box; the same bits for the same input. Where the bound of the edges cannot be kept they are
/// as long as fill_quality() says. Throws RunError when Gmsh fails.
FillMesh mesh_fill(const FillSpace& space, const FillMeshing& meshing = {});

}  // namespace voussoir
