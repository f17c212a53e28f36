// The section of a deformable fill in triangles. To keep a bound of the edges with few triangles, they are equal
// inside, and the edges at the rim are shortened one by one (docs/theory/geometry.md).
#pragma once
#include <array>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// Triangles of the section that share whole edges. Each has the range of y over which the fill reaches.
struct FillSection {
  struct Triangle {
    std::array<std::int32_t, 3> nodes = {};
    double y0 = 0.0, y1 = 0.0;  // m
    std::int32_t material = 0;
  };
  std::vector<Vec3> nodes;  // m; y = 0
  std::vector<Triangle> triangles;
};

double longest_edge(const FillSection& section);  // m

/// A straight piece of an outline: its two ends, m; y = 0.
using Side = std::array<Vec3, 2>;

/// Nodes of equilateral triangles with edges of `edge` m, or slightly shorter ones that divide the highest level side
/// of the outline evenly. Only nodes inside the outline with a distance of at least 0.45 edges from it.
std::vector<Vec3> lattice_inside(const std::vector<Side>& outline, double edge);

/// Moves nodes, flips edges to the other diagonal and, if neither helps, halves them, until no edge is longer than
/// `bound` m. Edges on the outline and between parts with different ranges of y do not change.
void shorten_edges(FillSection& section, double bound);

}  // namespace voussoir
