// Where the ground is: the exact double integral of an accelerogram that is linear between its samples.
#pragma once
#include <vector>

#include "solver/model/settings.h"

namespace voussoir {

/// Velocity and displacement of a ground that starts from rest at t = 0, integrated in closed form up to each sample.
/// A function of the motion and the time alone, so that whatever follows it survives a restart.
struct GroundPath {
  GroundMotion motion;
  std::vector<Vec3> velocity;   // m/s, at the samples
  std::vector<Vec3> at_sample;  // m, likewise

  /// m, `t` seconds after the first sample: zero before it; after the last one at the velocity reached. Zero for a path
  /// without samples.
  Vec3 displacement(double t) const;
};

GroundPath ground_path(const GroundMotion& motion);

}  // namespace voussoir
