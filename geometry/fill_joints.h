// Where a deformable fill touches stones: patches between faces of stones and triangles of the fill's surface.
#pragma once
#include "geometry/assembly.h"
#include "geometry/joints.h"

namespace voussoir {

struct FillJointReport {
  std::int64_t patches = 0;
  double covered = 0.0;             // m2, of the fill's surface
  double surface = 0.0;             // m2, all of it
  std::int64_t closed_gaps = 0;     // patches whose face and triangle are apart, or overlap, by more than 1e-9 m
  double largest_closed_gap = 0.0;  // m
};

/// Finds all patches (geometry only: kn, ks and law are left at zero): every triangle clipped with every face it lies
/// on, opposed within `search.angle` and apart by at most `search.gap` either way. Stones and fill must be finished.
/// Throws InputError when two stones cover the same part of a triangle, which are then in one another, and when a part
/// of the fill touches no stone at all.
FillJointReport find_fill_joints(Assembly& assembly, const JointSearch& search = {});

}  // namespace voussoir
