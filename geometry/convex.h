// Contact of two convex polyhedra: separating axes, and the contact patch by clipping in the common plane.
#pragma once
#include "geometry/polyhedron.h"

namespace voussoir {

/// The contact of two convex polyhedra: the axis of largest separation (least overlap) and the shared patch.
struct Meeting {
  enum class Kind { apart, face, edge };  // apart: farther than the given distance
  Kind kind = Kind::apart;
  double separation = 0.0;       // m along `normal`; negative when they overlap
  Vec3 normal = Vec3::Zero();    // unit, from a to b
  int face_a = -1, face_b = -1;  // for Kind::face: the facing faces of a and of b
  // The shared patch as material points, one pair a corner: for Kind::face the clip of the two facing faces projected
  // on the common plane (>= 3 corners, counter-clockwise about `normal`); for Kind::edge the one pair of nearest
  // points.
  std::vector<Vec3> on_a, on_b;  // m, world
  double area = 0.0;             // m2 of the projected clip polygon; 0 for Kind::edge
};

/// A convex polyhedron with its edges and face planes, computed once for meeting().
struct Convex {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> faces;
  std::vector<Plane> planes;  // of the faces
  std::vector<std::pair<int, int>> edges;
  std::vector<Vec3> directions;  // of the edges, unit, each direction once
  Vec3 centre = Vec3::Zero();    // mean vertex
};
Convex make_convex(const Polyhedron& shape);
/// The shape moved by a rotation about `pivot` followed by a translation: p → pivot + shift + R (p − pivot).
Convex moved(const Convex& shape, const Mat3& rotation, const Vec3& pivot, const Vec3& shift);

/// Largest separation over the face normals of both and the cross products of their edges (Gottschalk, Lin & Manocha
/// 1996), m; negative: they overlap by that much. Stops at the first axis that separates by more than `enough`, so a
/// result above it is a lower bound of the largest. Never more than the true distance.
double separation(const Convex& a, const Convex& b, double enough);

/// Separating-axis test over face normals of both and cross products of edges (Gottschalk, Lin & Manocha 1996), then a
/// patch. Face axes win ties over edge axes (within 1e-6 m plus 2 % of the gap) so that face contacts do not flicker.
/// Among face axes that tie within 1e-9 m the one nearest to the line of centres wins.
///
/// The reference face belongs to the winning axis; the facing face of the other body is the most anti-parallel one of
/// those that hold its deepest corner. If the plane of the facing face is within 6 degrees of the axis, the result is
/// Kind::edge with the tip of the other body and its projection on the reference face. If the two faces do not
/// overlap when they are projected on the common plane, or if that tip is not above the reference face, the result is
/// Kind::face with area 0 and no points. For Kind::apart, separation and normal are those of the axis that separates.
///
/// Faces must be whole: a flat side given as triangles meets triangle by triangle (see merge_coplanar_faces()).
Meeting meeting(const Convex& a, const Convex& b, double within);

}  // namespace voussoir
