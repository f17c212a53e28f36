// Displacement of the ground: the exact double integral of an accelerogram that is linear between its samples.
#pragma once
#include <vector>

#include "solver/model/settings.h"

namespace voussoir {

/// Velocity and displacement of a ground that starts from rest at t = 0, integrated in closed form up to each sample.
/// It depends only on the motion and the time, so it needs no data for a restart.
struct GroundPath {
  GroundMotion motion;
  std::vector<Vec3> velocity;   // m/s, at the samples
  std::vector<Vec3> at_sample;  // m, likewise

  /// Displacement (m) `t` seconds after the first sample. It is zero before the first sample and has constant velocity
  /// after the last one. Zero for a path without samples.
  Vec3 displacement(double t) const;
};

GroundPath ground_path(const GroundMotion& motion);

}  // namespace voussoir
