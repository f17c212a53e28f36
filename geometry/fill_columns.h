// The nodes of a swept fill across its width: each node of the section has a column of nodes. Adjacent columns are
// staggered by a third of a layer, so that a bound of the edges needs the fewest tetrahedra (docs/theory/geometry.md).
#pragma once
#include "geometry/fill_section.h"

namespace voussoir {

/// Ends of parts of a fill that are closer than this (m) count as one.
constexpr double same_end = 1e-6;

/// y (m) of the nodes of the column of each node of a section, ascending.
using FillColumns = std::vector<std::vector<double>>;

/// Index of the node of a column at y (m), which must be one of its ends.
std::size_t level_at(const std::vector<double>& column, double y);

/// The bound for edges of the section (m) that follows from the bound `edge` (m) of all edges, if parts of the fill end
/// at these y (m) and layers are at most `layer` m thick.
double section_bound(const std::vector<double>& ends, double edge, double layer);

/// A column has a node at every end of a triangle around it, at y = 0 if a triangle spans it, and between these one
/// node for each layer of at most `layer` m. It has more nodes if an edge of the mesh would still be longer than `edge`
/// m. Columns of a fill that is symmetric about y = 0 are symmetric, too.
FillColumns make_columns(const FillSection& section, double edge, double layer);

}  // namespace voussoir
