// Fixed blocks that the stages of a run move, and free ones that they put somewhere else.
#pragma once
#include "geometry/assembly.h"
#include "solver/model/model.h"
#include "solver/motion/ground_path.h"

namespace voussoir {

/// The blocks of a group. Throws InputError "`who` the group '…'" with the nearest name when there is none; `fixed`: of
/// the groups of fixed blocks, else of those of free ones.
const std::vector<std::int64_t>& group_of(const Assembly& assembly, const std::string& name, const std::string& who,
                                          bool fixed);

/// Where the blocks of a drive are relative to the ground, m, `time` (s) after the beginning of a stage of this
/// duration (s): its own path, and by how much its share of the ground's motion u, perhaps delayed, differs from that
/// motion,
///   d(t) = Drive::at(t) + factor u(t − delay) − u(t).
/// `ground` is not looked at when the blocks move with the ground.
Vec3 drive_path(const Drive& drive, const GroundPath& ground, double time, double duration);

/// Throws InputError when a stage drives a group that the assembly does not have, a block that is not fixed, a block
/// twice, or one along an axis on which it is free.
void check_drives(const Assembly& assembly, const std::vector<StageSettings>& stages, const std::vector<Guide>& guides);

/// Lets fixed bodies move where guides say so. Throws InputError for groups that are not there or not fixed.
void apply_guides(const Assembly& assembly, const std::vector<Guide>& guides, Model& model);

/// Names of the groups of fixed blocks alone, guided and driven ones among them, in the order of their names.
std::vector<std::string> names_held(const Assembly& assembly);

/// The same for placements: of free blocks, in stages that begin from rest (the first, or after one without time).
void check_placements(const Assembly& assembly, const std::vector<StageSettings>& stages);

}  // namespace voussoir
