// Adds an imported mesh of a fill to an assembly, with its patches.
#pragma once

#include "geometry/fill_joints.h"
#include "solver/base/constants.h"

namespace voussoir {

/// Properties of the patches between stones and an imported fill: friction only.
struct FillInterface {
  double kn = 0.0, ks = 0.0;          // Pa/m of every patch; both 0: from the moduli of the stones
  double share = 0.20;                // used if both are 0: share of E/dc and G/dc between two such stones
  double friction = 35.0 * pi / 180;  // rad
  JointSearch search;
};

/// Adds this fill, made of the material with the index `material`, to an assembly without a fill, finds its patches and
/// sets their stiffness and law. From the moduli kn = share E/dc and ks = share G/dc, where dc is twice the distance
/// from the centroid of the stone to the patch along its normal. If the assembly has no blocks, only the fill is added.
/// Throws InputError if there is already a fill, if only one of kn and ks is given, or if a stone has no modulus for
/// them.
FillJointReport put_fill(Assembly& assembly, FillMesh mesh, std::int32_t material, const FillInterface& interface);

}  // namespace voussoir
