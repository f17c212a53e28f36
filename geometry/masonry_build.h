// From the description of a bridge to its assembly: what all generators of whole bridges do.
#pragma once
#include "geometry/generator.h"
#include "geometry/masonry_parts.h"
#include "geometry/stiffness.h"

namespace voussoir {

/// What the keys that all of them have say: blocks and their scale, fill, restraint of the ends.
void read_fill_and_blocks(Bridge& bridge, const GeneratorInput& in);
/// Indices of "vault", "infill" and "backfill"; a bridge without a material of its own for a part uses the first.
/// Vaults and supports get the usual ones.
void find_materials(Bridge& bridge, const std::vector<Material>& materials);
/// Stiffness from the moduli, over blocks of these sizes.
JointRules joint_rules(const Bridge& bridge, const GeneratorInput& in);
/// Lays all parts, finds the joints, sets their stiffness, meshes a deformable fill.
Assembly lay_bridge(const Bridge& bridge, const std::vector<Material>& materials, const JointRules& rules,
                    const GeneratorInput& in);

}  // namespace voussoir
