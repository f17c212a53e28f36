// Integration points of a patch, on its boundary and inside. The rule is exact for quadratics, so that the elastic
// stiffness is exact (A kn, A ks, kn I, ks J), and the points on the boundary allow the joint to hinge about its edge.
#pragma once
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

struct PatchPoint {
  double s = 0.0, t = 0.0;  // m, in the patch's plane, from its centroid, along its principal axes
  double weight = 0.0;      // m2
};

/// Gauss–Lobatto rule on [−1, 1]; weights sum to 1 (Abramowitz & Stegun 1964, table 25.6).
struct LineRule {
  int count = 0;
  double x[5] = {}, w[5] = {};
};
/// The rule with 3, 4 or 5 points. Throws InputError for other numbers.
LineRule lobatto_rule(int points);

/// Plane frame and moments of a polygon. Axes s, t are principal (∫ s t dA = 0), n = s × t.
struct PatchShape {
  Vec3 centroid = Vec3::Zero();
  Mat3 frame = Mat3::Identity();      // columns n, s, t
  double area = 0.0;                  // m2
  double ss = 0.0, tt = 0.0;          // m4: ∫ s² dA, ∫ t² dA
  double half_s = 0.0, half_t = 0.0;  // m: largest |s|, |t| of a corner
  bool rectangle = false;             // with corners (±half_s, ±half_t): point i n + j of the rule is at s_i, t_j
  std::vector<PatchPoint> corners;    // weights zero
  std::vector<PatchPoint> points;     // the rule
};

/// `polygon` is convex and counter-clockwise about `normal` (unit). Quadrilaterals take the tensor Gauss–Lobatto rule
/// with `per_side` = 3, 4 or 5 points a side, every other polygon with m sides the fan rule of 2 m + 1 points.
PatchShape patch_shape(const Polygon& polygon, const Vec3& normal, int per_side);

/// The points of the rule on a rectangle, equal to those of patch_shape(). They need not be stored.
std::vector<PatchPoint> rectangle_points(const PatchShape& rectangle, int per_side);

/// Four points of equal weight at (±√(∫s²/A), ±√(∫t²/A)): exact for quadratics on any polygon, because they have the
/// same area, centroid and second moments. On a convex polygon they are never outside (Kannan, Lovász & Simonovits
/// 1995, theorem 4.1: a convex body in isotropic position contains the ball of radius √((n + 2)/n), which is √2 in the
/// plane).
std::vector<PatchPoint> moment_points(const PatchShape& shape);

}  // namespace voussoir
