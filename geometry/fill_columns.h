// Where the nodes of a swept fill lie across it: over every node of its section stands a column of them. Columns side
// by side are staggered by a third of a layer, so that a bound of the edges is kept by the fewest tetrahedra
// (docs/theory/geometry.md).
#pragma once
#include "geometry/fill_section.h"

namespace voussoir {

/// Ends of parts of a fill that are nearer than this (m) are one.
constexpr double same_end = 1e-6;

/// y (m) of the nodes over each node of a section, from low to high.
using FillColumns = std::vector<std::vector<double>>;

/// Number of the node of a column at y (m), which must be one of its ends.
std::size_t level_at(const std::vector<double>& column, double y);

/// What a bound of the edges (m) leaves to those of the section, if parts of the fill end at these places across (m)
/// and layers are at most `layer` m thick.
double section_bound(const std::vector<double>& ends, double edge, double layer);

/// A column has a node wherever a triangle around it ends, at y = 0 if one spans it, and between them one for each
/// layer of at most `layer` m. Where an edge of the mesh would be longer than `edge` m for all that, it has more.
/// Symmetric about y = 0 where the fill is.
FillColumns make_columns(const FillSection& section, double edge, double layer);

}  // namespace voussoir
