// Meshes the space of a fill with Gmsh. Only the implementation of this header uses Gmsh; io/msh reads Gmsh files.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "geometry/masonry.h"

namespace voussoir {

/// The space of a fill: boxes that may touch and do not overlap in the plane x-z, without the space below the extrados
/// of rings and without other polygons.
struct FillSpace {
  std::vector<Box> boxes;
  std::vector<std::int32_t> materials;  // of each box; empty: all 0. No tetrahedron crosses a change of material.
  std::vector<Ring> rings;
  std::vector<Polygon> beside;  // polygons in the plane x-z that are not part of the space
};

/// Parameters of the mesh. The defaults gave the fewest tetrahedra (docs/theory/geometry.md).
struct FillMeshing {
  double edge = 0.5;         // m, upper bound of the edges
  double layer_share = 0.8;  // largest thickness of a layer as a share of the bound; the section gets the rest
  double rim_share = 0.85;   // size for Gmsh between lattice and rim, as a share of the bound of the section
};

/// Meshes the section of the space with triangles and sweeps them across. The tetrahedra are oriented, the surface is
/// set, and every tetrahedron has the material of its box. Equal input gives equal bits. If the bound of the edges
/// cannot be kept, fill_quality() gives the longest edge. Throws InputError if the mesh would have more than about 2e7
/// tetrahedra, and RunError if Gmsh fails or its library cannot be loaded.
FillMesh mesh_fill(const FillSpace& space, const FillMeshing& meshing = {});

}  // namespace voussoir
