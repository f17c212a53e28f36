// Integration points of a patch: on its boundary as well as inside, exact for quadratics, so that the elastic stiffness
// is exact (A kn, A ks, kn I, ks J) and the joint can hinge about its edge.
#pragma once
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

struct PatchPoint {
  double s = 0.0, t = 0.0;  // m, in the patch's plane, from its centroid, along its principal axes
  double weight = 0.0;      // m2
};

/// Plane frame and moments of a polygon. Axes s, t are principal (∫ s t dA = 0), n = s × t.
struct PatchShape {
  Vec3 centroid = Vec3::Zero();
  Mat3 frame = Mat3::Identity();    // columns n, s, t
  double area = 0.0;                // m2
  double ss = 0.0, tt = 0.0;        // m4: ∫ s² dA, ∫ t² dA
  std::vector<PatchPoint> corners;  // weights zero
  std::vector<PatchPoint> points;   // the rule
};

/// `polygon` is convex and counter-clockwise about `normal` (unit). Quadrilaterals take the tensor Gauss–Lobatto rule
/// with `per_side` = 3, 4 or 5 points a side, every other polygon with m sides the fan rule of 2 m + 1 points.
PatchShape patch_shape(const Polygon& polygon, const Vec3& normal, int per_side);

}  // namespace voussoir
