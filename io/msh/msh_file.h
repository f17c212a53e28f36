// Reads meshes of a fill from Gmsh files. The program has its own reader, because that of Gmsh does not check the
// numbers in a file.
#pragma once
#include <string>

#include "geometry/assembly.h"

namespace voussoir {

/// Reads the 4-node tetrahedra of a Gmsh file (.msh, version 2.x or 4.1, text or binary) with `scale` m per unit;
/// points, lines and surfaces are ignored. Nodes are in the order of their numbers; the tetrahedra are oriented and
/// have material 0; the surface is set. Throws InputError for another kind of file, other solid elements, no
/// tetrahedra, numbers out of range, or a mesh that check_fill() refuses.
FillMesh read_msh(const std::string& path, double scale = 1.0);

/// The same for the bytes of a file; `path` is used in messages.
FillMesh parse_msh(const std::string& bytes, const std::string& path, double scale);

}  // namespace voussoir
