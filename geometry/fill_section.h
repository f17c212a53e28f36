// The section of a deformable fill in triangles, and what is done so that as few as possible of them keep a bound of
// their edges: equal triangles inside, and at the rim edges that are shortened one by one (docs/theory/geometry.md).
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
    std::int32_t material = 0;
  };
  std::vector<Vec3> nodes;  // m; y = 0
  std::vector<Triangle> triangles;
};

double longest_edge(const FillSection& section);  // m

/// A straight piece of an outline: from and to where, m; y = 0.
using Side = std::array<Vec3, 2>;

/// Nodes of triangles with three edges of `edge` m, or a little less along the outline's highest level side, which they
/// divide evenly; those inside the outline that keep 0.45 edges away from it.
std::vector<Vec3> lattice_inside(const std::vector<Side>& outline, double edge);

/// Moves nodes, turns edges to the other diagonal and, where neither helps, halves them, until none is longer than
/// `bound` m. What lies on the outline, or between parts that reach differently far across, stays as it is.
void shorten_edges(FillSection& section, double bound);

}  // namespace voussoir
