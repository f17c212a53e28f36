// A deformable fill from its section: triangles in the plane x-z, swept across into layers of prisms, each of which is
// three tetrahedra.
#pragma once
#include "geometry/fill_section.h"

namespace voussoir {

/// Thickness (m) of the thickest layer of a fill whose parts end at these places across (m), in layers of at most
/// `layer` m.
double thickest_layer(const std::vector<double>& ends, double layer);

/// Sweeps a section in layers of at most `layer` m. A layer ends wherever a part of the fill does; one that spans y = 0
/// has an even number, and a fill that is alike on both sides gets a mesh that is its own mirror image. Longest edge:
/// the root of the squares of the section's and the layer's. Oriented, with its surface; every tetrahedron of material
/// 0.
FillMesh sweep(const FillSection& section, double layer);

}  // namespace voussoir
