// The elastic stiffness of one joint on a convex polygon, compared with elementary beam theory. Used by the rung of
// that name and by tests of other polygons and motions.
#pragma once
#include "tools/ladder/models.h"

namespace voussoir::ladder {

/// Stiffnesses of the joint, Pa/m.
constexpr double prisms_kn = 3e9, prisms_ks = 1.1e9;

/// Two prisms on both sides of a polygon in the plane z = 0, in any orientation and position.
Assembly two_prisms(const Polygon& polygon, const Eigen::Quaterniond& rotation, const Vec3& shift);

/// Largest relative errors: of the force of a single translation (kn A, ks A), of the moment of a single rotation (kn
/// I, ks J), of the components that should be zero, and of any motion to first order (a displacement and a rotation of
/// 1e-7).
struct StiffnessErrors {
  double force = 0.0, moment = 0.0, beside = 0.0, any_force = 0.0, any_moment = 0.0;
};

/// Compares the joint of two prisms, by the intact path or point by point, and raises `worst` to the errors found.
/// Throws RunError if the prisms do not meet in one joint square to the polygon.
void compare_stiffness(const Polygon& polygon, std::mt19937& random, bool shortcut, StiffnessErrors& worst);

}  // namespace voussoir::ladder
