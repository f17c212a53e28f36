// Builds the assembly of a bridge from its description; common to all generators of whole bridges.
#pragma once
#include "geometry/generator.h"
#include "geometry/masonry_parts.h"
#include "geometry/stiffness.h"

namespace voussoir {

/// Reads the keys that all of them have: blocks and their scale, fill, restraint of the ends.
void read_fill_and_blocks(Bridge& bridge, const GeneratorInput& in);
/// Sets the indices of the materials "vault", "infill", "backfill" and "surfacing"; a part without its own material
/// uses the first one. Vaults get the material "vault", supports the first material.
void find_materials(Bridge& bridge, const std::vector<Material>& materials);
/// Stiffness from the moduli, over blocks of these sizes.
JointRules joint_rules(const Bridge& bridge, const GeneratorInput& in);
/// Lays all parts, finds the joints, sets their stiffness, meshes a deformable fill. Throws InputError for a bridge
/// whose supports overlap or that has too many blocks, and RunError if Gmsh fails.
Assembly lay_bridge(const Bridge& bridge, const std::vector<Material>& materials, const JointRules& rules,
                    const GeneratorInput& in);

}  // namespace voussoir
