// The elastic stiffness of one joint on a convex polygon, compared with elementary beam theory; the rung of that name
// and the tests of other polygons and motions share it.
#pragma once
#include "tools/ladder/models.h"

namespace voussoir::ladder {

/// Stiffnesses of the joint, Pa/m.
constexpr double prisms_kn = 3e9, prisms_ks = 1.1e9;

/// Two prisms on the two sides of a polygon in the plane z = 0, turned and shifted anyhow.
Assembly two_prisms(const Polygon& polygon, const Eigen::Quaterniond& rotation, const Vec3& shift);

/// Largest relative errors: of the force of a single motion (kn A, ks A), of the moment of a single turn (kn I, ks J),
/// of what should be zero beside them, and of any motion to first order (a displacement and a turn of 1e-7).
struct StiffnessErrors {
  double force = 0.0, moment = 0.0, beside = 0.0, any_force = 0.0, any_moment = 0.0;
};

/// Compares the joint of two prisms, by the intact path or point by point, and raises `worst` to what is found. Throws
/// RunError when the prisms do not meet in one joint square to the polygon.
void compare_stiffness(const Polygon& polygon, std::mt19937& random, bool shortcut, StiffnessErrors& worst);

}  // namespace voussoir::ladder
