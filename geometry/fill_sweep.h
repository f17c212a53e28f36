// A deformable fill from its section: triangles in the plane x-z, swept across into layers of prisms, each of which is
// three tetrahedra.
#pragma once
#include <array>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// Triangles of the fill's section that share whole edges, each with how far across the fill reaches there.
struct FillSection {
  struct Triangle {
    std::array<std::int32_t, 3> nodes = {};
    double y0 = 0.0, y1 = 0.0;  // m
  };
  std::vector<Vec3> nodes;  // m; y = 0
  std::vector<Triangle> triangles;
};

double longest_edge(const FillSection& section);  // m

/// Sweeps a section in layers of at most `layer` m. A layer ends wherever a part of the fill does; one that spans y = 0
/// has an even number, and a fill that is alike on both sides gets a mesh that is its own mirror image. Longest edge:
/// the root of the squares of the section's and the layer's. Oriented, with its surface; every tetrahedron of material
/// 0.
FillMesh sweep(const FillSection& section, double layer);

}  // namespace voussoir
