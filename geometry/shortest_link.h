// The normal of two convex cells that meet at edges or corners, where no face determines it: the direction of the
// shortest link between both cells, each slightly shrunk (docs/theory/contacts.md).
#pragma once
#include <optional>

#include "geometry/convex.h"

namespace voussoir {

/// The line of shortest distance between two cells that have been shrunk.
struct ShortestLink {
  Vec3 normal = Vec3::UnitZ();  // unit, from a to b
  double distance = 0.0;        // m, between the shrunk cells
  // Vertices of each that span the features at its ends: a corner, an edge or three corners of a face; and the point
  // of the cell as it is, not shrunk, that has the same weights in these.
  std::vector<int> of_a, of_b;
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();
};

/// Vertices of a cell whose faces have all moved inwards by `shrink` (m). Vertices of a sharp tip move at most four
/// times as far. Corners within an edge or a face move with it, so that the shrunk cell does not depend on them.
std::vector<Vec3> shrunk_vertices(const Convex& shape, double shrink);

/// The shortest link (Gilbert, Johnson & Keerthi 1988); empty if the shrunk cells overlap. Its direction is a
/// continuous function of the two sets of points and depends on nothing else.
std::optional<ShortestLink> shortest_link(const Convex& a, const Convex& b, double shrink);

/// The contact of two cells at edges or corners, by the shortest link of the shrunk cells: Kind::edge with one pair of
/// points, or with two pairs at the ends of the common part of parallel edges; Kind::apart (with normal and separation)
/// if the distance along the link is larger than `within`. Empty if the shrunk cells overlap.
std::optional<Meeting> sharp_meeting(const Convex& a, const Convex& b, double within, double shrink);

/// Whether the cells have faces in one plane, within 10⁻³ rad and `within` (m), and are on opposite sides of it.
bool lie_flush(const Convex& a, const Convex& b, double within);

/// Whether two faces that meet are open towards one side, so that they may touch along an edge only: they are not flat
/// on each other, and their smallest gap is within `margin` (m) of the border of the face that gave the normal. `m`
/// must be of Kind::face with points.
bool opens_at_an_edge(const Convex& a, const Convex& b, const Meeting& m, double margin);

/// The two faces of a meeting of Kind::face, clipped on the common plane whose normal is that of the shortest link. The
/// result is the meeting unchanged if the shrunk cells overlap or if both normals are equal. It has no points if a face
/// is at more than 45° to that plane.
Meeting on_common_plane(const Convex& a, const Convex& b, const Meeting& m, double shrink);

}  // namespace voussoir
