// Finds the patches between faces of stones and triangles of the surface of a deformable fill.
#pragma once
#include "geometry/assembly.h"
#include "geometry/joints.h"

namespace voussoir {

struct FillJointReport {
  std::int64_t patches = 0;
  double covered = 0.0;             // m2, area of the surface of the fill that patches cover
  double surface = 0.0;             // m2, area of the whole surface
  std::int64_t closed_gaps = 0;     // patches whose face and triangle have a gap or an overlap of more than 1e-9 m
  double largest_closed_gap = 0.0;  // m
};

/// Finds all patches (geometry only: kn, ks and law stay zero): every triangle is clipped with every face that is
/// opposed within `search.angle` and has a gap or an overlap of at most `search.gap`. If several faces of a cell meet a
/// triangle, only the largest patch is kept. Stones and fill must be finished.
/// Throws InputError if two stones cover the same part of a triangle, which means that stones overlap, and if a part of
/// the fill touches no stone.
FillJointReport find_fill_joints(Assembly& assembly, const JointSearch& search = {});

}  // namespace voussoir
