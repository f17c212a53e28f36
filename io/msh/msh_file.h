// Meshes of a fill from Gmsh and what writes its files: our own reader, because Gmsh's trusts the numbers in a file.
#pragma once
#include <string>

#include "geometry/assembly.h"

namespace voussoir {

/// Reads the 4-node tetrahedra of a Gmsh file (.msh, version 2.x or 4.1, text or binary) with `scale` m per unit;
/// points, lines and surfaces are passed over. Nodes in the order of their numbers, oriented, with the surface; every
/// tetrahedron of material 0. Throws InputError for another kind of file, other solid elements, none at all, numbers
/// out of range, or a mesh that check_fill() refuses.
FillMesh read_msh(const std::string& path, double scale = 1.0);

/// The same of a file's bytes; `path` is for messages.
FillMesh parse_msh(const std::string& bytes, const std::string& path, double scale);

}  // namespace voussoir
