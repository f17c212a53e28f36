// Positions of the corners of a patch with the fill, relative to the stone.
#pragma once
#include <array>

#include "solver/model/state.h"

namespace voussoir {

struct InterfaceJump {
  Mat3 axes = Mat3::Identity();   // n, s, t as columns, world axes
  Vec3 origin = Vec3::Zero();     // m, origin of the axes of the patch, world
  Vec3 centroid = Vec3::Zero();   // m, of the stone, world
  std::array<Vec3, 3> at, moved;  // m: corners of the triangle, world; their displacements in the axes of the patch
  /// The jump at (s, t), from the shape functions of the patch.
  Vec3 point(const Mat3& shape, double s, double t) const {
    const Vec3 n = shape * Vec3(1.0, s, t);
    return n[0] * moved[0] + n[1] * moved[1] + n[2] * moved[2];
  }
};

/// The jump of a patch in the present placement of its stone and its nodes.
InterfaceJump interface_jump(const Model& model, const State& state, const InterfacePatch& patch);

/// Elastic jump at point `i` of the patch in a slot, m; zero if it is open. Shear beyond the friction limit is reduced
/// to the limit, as in the next pass.
Vec3 elastic_point(const Model& model, const State& state, std::size_t slot, const InterfaceJump& jump,
                   const Mat3& shape, std::size_t i);
/// Elastic energy of these jumps for the patch in a slot, J.
double interface_energy(const Model& model, const State& state, std::size_t slot);

}  // namespace voussoir
