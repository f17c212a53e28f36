// Assembly files: blocks, joints, materials and laws in HDF5, with a public layout (docs/formats.md).
#pragma once
#include <string>

#include "geometry/assembly.h"
#include "geometry/joints.h"

namespace voussoir {

inline constexpr std::int64_t assembly_format_version = 3;
/// Groups whose names begin with this are the objects of a drawing. There may be thousands, so they are stored in one
/// table, objects/*, since version 3; files without such groups are written as version 2.
inline constexpr const char* object_group_prefix = "object ";

/// Writes the assembly (finished: masses, joints) atomically. blocks/* have the outer boundary of each block; the
/// convex cells of blocks with several cells are in cells/*. Throws RunError if the file cannot be written, and
/// InputError if the name of a group is empty or contains '/'.
void write_assembly(const std::string& path, const Assembly& assembly);

/// Reads an assembly file and checks everything in it: format and version, shapes, offsets, index ranges, finite
/// numbers, convex closed blocks of positive volume, stated masses, at least one fixed block, valid joints, a valid
/// mesh of the fill. Optional in a file: cells/*, materials/* (without them, materials are made from blocks/density),
/// mass, centroid and inertia, joints/cells and faces, joints as a whole, fill/*, groups, sensors. A file with a fill
/// needs no blocks. If the file has no list of joints, joints are found, with stiffness and strength from its
/// materials. Throws InputError with file, dataset and row.
Assembly read_assembly(const std::string& path, const JointSearch& search = careful_search());
/// The same without changes: joints are not found, and no block needs to be fixed. For callers that change the
/// assembly.
Assembly read_stated_assembly(const std::string& path);
/// Whether the file has a list of joints, which may be empty.
bool states_joints(const std::string& path);

/// Hash of everything that affects the motion of the assembly: blocks with components, parts and materials, joints,
/// laws and fill; not names, groups, sensors and the text of the case.
std::uint64_t assembly_hash(const Assembly& assembly);

}  // namespace voussoir
