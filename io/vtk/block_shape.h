// The outer surface of one block as indexed loops, for a VTK cell.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// The outer surface of a block as one closed polyhedron. A block of one cell is that cell. For several cells the outer
/// faces are welded, and corners on the edge of another loop are inserted there, so that the surface is closed.
Polyhedron outer_surface(const Block& block);

/// Vertex order of a VTK hexahedron (bottom loop facing up, then the top loop), or nothing if the shape is not a
/// hexahedron.
std::optional<std::array<int, 8>> hexahedron_order(const Polyhedron& shape);

}  // namespace voussoir
