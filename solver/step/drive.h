// Fixed blocks that stages move, and free blocks that stages place at another position.
#pragma once
#include "geometry/assembly.h"
#include "solver/model/model.h"
#include "solver/motion/ground_path.h"

namespace voussoir {

/// The blocks of a group. If the group does not exist, throws an InputError that begins with "`who` the group '…'" and
/// suggests a name: of the groups of fixed blocks if `fixed`, else of those of free blocks.
const std::vector<std::int64_t>& group_of(const Assembly& assembly, const std::string& name, const std::string& who,
                                          bool fixed);

/// Position of the blocks of a drive relative to the ground, m, `time` (s) after the beginning of a stage of this
/// duration (s). It is the path of the drive, plus the scaled and delayed motion u of the ground, minus that motion,
///   d(t) = Drive::at(t) + factor u(t − delay) − u(t).
/// `ground` is not used if the blocks move with the ground.
Vec3 drive_path(const Drive& drive, const GroundPath& ground, double time, double duration);

/// Throws InputError if a stage drives an unknown group, a block that is not fixed, a block twice, or a block along an
/// axis on which it is free.
void check_drives(const Assembly& assembly, const std::vector<StageSettings>& stages, const std::vector<Guide>& guides);

/// Releases fixed bodies along the axes of their guides. Throws InputError for groups that do not exist or are not
/// fixed.
void apply_guides(const Assembly& assembly, const std::vector<Guide>& guides, Model& model);

/// Names of the groups that consist of fixed blocks only, including guided and driven ones, in alphabetical order.
std::vector<std::string> names_held(const Assembly& assembly);

/// Throws InputError if a stage places an unknown group or a fixed block, or does not begin at rest: it must be the
/// first stage or follow a stage without simulated time.
void check_placements(const Assembly& assembly, const std::vector<StageSettings>& stages);

}  // namespace voussoir
