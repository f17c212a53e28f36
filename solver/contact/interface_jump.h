// Where the corners of a patch with the fill are, seen from the stone.
#pragma once
#include <array>

#include "solver/model/state.h"

namespace voussoir {

struct InterfaceJump {
  Mat3 axes = Mat3::Identity();   // n, s, t as columns, world axes
  Vec3 origin = Vec3::Zero();     // m, of the patch's axes, world
  Vec3 centroid = Vec3::Zero();   // m, of the stone, world
  std::array<Vec3, 3> at, moved;  // m: the triangle's corners, world; what they have moved in the patch's axes
  /// The jump at (s, t), given the patch's shape functions.
  Vec3 point(const Mat3& shape, double s, double t) const {
    const Vec3 n = shape * Vec3(1.0, s, t);
    return n[0] * moved[0] + n[1] * moved[1] + n[2] * moved[2];
  }
};

InterfaceJump interface_jump(const Model& model, const State& state, const InterfacePatch& patch);

/// Elastic jump at point `i` of the patch in a slot, m; zero where it is open. Shear past the cone is cut back to it,
/// as the next pass will do.
Vec3 elastic_point(const Model& model, const State& state, std::size_t slot, const InterfaceJump& jump,
                   const Mat3& shape, std::size_t i);
/// Elastic energy of the patch in a slot, J, of those jumps.
double interface_energy(const Model& model, const State& state, std::size_t slot);

}  // namespace voussoir
