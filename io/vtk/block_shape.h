// The outer surface of one block as indexed loops, ready to become a VTK cell.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// The block's outer surface as one closed polyhedron. A block of one cell is that cell; for several cells the outer
/// faces are welded, and corners that lie on another loop's edge are inserted there so that the surface is watertight.
Polyhedron outer_surface(const Block& block);

/// Vertex order of a VTK hexahedron (bottom loop facing up, then the top loop), or nothing when the shape is not one.
std::optional<std::array<int, 8>> hexahedron_order(const Polyhedron& shape);

}  // namespace voussoir
