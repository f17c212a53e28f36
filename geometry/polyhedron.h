// Polyhedra with planar faces: the shape of a stone, or of a convex cell of it.
#pragma once
#include <Eigen/Dense>
#include <vector>

namespace voussoir {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Polygon = std::vector<Vec3>;  // planar loop, metres

/// A half-space {p : normal·p <= offset}; `normal` is the outward unit vector.
struct Plane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0.0;  // m
};

/// A closed polyhedron: vertices in metres, faces as loops of vertex indices, counter-clockwise seen from outside.
struct Polyhedron {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> faces;
};

/// Exact integrals of a polyhedron at unit density.
struct MassProperties {
  double volume = 0.0;           // m3
  Vec3 centroid = Vec3::Zero();  // m
  Mat3 inertia = Mat3::Zero();   // m5, about the centroid, axes of the world
};

/// A box along the axes, m. The default is empty: it contains no point.
struct Box {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
};

Polyhedron make_box(const Vec3& low, const Vec3& high);
/// The prism between two parallel congruent loops: `base` counter-clockwise seen from the side opposite to `sweep`.
Polyhedron make_prism(const Polygon& base, const Vec3& sweep);

/// Volume, centroid and inertia by the divergence theorem over the faces fanned about their mean vertex
/// (Mirtich 1996; Eberly 2002). Negative volume means that the faces point inwards.
MassProperties mass_properties(const Polyhedron& shape);
/// Sum over the parts of one body; cells must not overlap.
MassProperties mass_properties(const std::vector<Polyhedron>& cells);

Polygon face_polygon(const Polyhedron& shape, int face);
Vec3 polygon_normal(const Polygon& polygon);          // unit, by Newell's method; zero for a polygon without area
double polygon_area(const Polygon& polygon);          // m2
Vec3 polygon_centroid(const Polygon& polygon);        // area centroid
Plane face_plane(const Polyhedron& shape, int face);  // through its mean corner; zero normal for a face without area
Box bounding_box(const Polygon& points);              // of any set of points
Box bounding_box(const Polyhedron& shape);
double surface_area(const Polyhedron& shape);  // m2

/// The part of a convex polyhedron inside the half-space; empty (no faces) if its depth would be below `tolerance` (m).
/// Vertices within `tolerance` of the plane count as on it, so that cuts along existing faces leave no slivers.
Polyhedron cut(const Polyhedron& convex, const Plane& keep, double tolerance = 1e-9);
/// The part of a convex planar polygon inside the half-space (Sutherland & Hodgman 1974).
Polygon cut(const Polygon& convex, const Plane& keep, double tolerance = 1e-12);
/// Intersection of two convex polygons in one plane with unit normal `normal` (both counter-clockwise about it).
Polygon intersect(const Polygon& a, const Polygon& b, const Vec3& normal);
/// The polygon without repeated corners and corners on a straight edge (within `tolerance`); empty if nothing is left.
Polygon cleaned(const Polygon& polygon, double tolerance = 1e-9);

}  // namespace voussoir
