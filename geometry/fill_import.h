// A fill that was meshed elsewhere: put into an assembly, with its patches.
#pragma once

#include "geometry/fill_joints.h"
#include "solver/base/constants.h"

namespace voussoir {

/// What the patches between stones and such a fill are like: friction only.
struct FillInterface {
  double kn = 0.0, ks = 0.0;          // Pa/m of every patch; both 0: from the stones' moduli
  double share = 0.20;                // then: of E/dc and G/dc between two such stones
  double friction = 35.0 * pi / 180;  // rad
  JointSearch search;
};

/// Gives the assembly, which must have none, this fill of one of its materials, finds its patches and sets their
/// stiffness and law. By the moduli kn = share E/dc, with dc twice the distance from the stone's centroid to the patch
/// along its normal. An assembly without blocks just gets the fill. Throws InputError when there is a fill already,
/// when only one of kn and ks is given, or when a stone has no modulus to take them from.
FillJointReport put_fill(Assembly& assembly, FillMesh mesh, std::int32_t material, const FillInterface& interface);

}  // namespace voussoir
