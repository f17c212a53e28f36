// Steps of the import that surface files and assembly files share.
#pragma once
#include "io/vtk/import.h"
#include "io/vtk/shells.h"

namespace voussoir {

/// The rotation that makes the axis "x", "y", "z", "-x", "-y" or "-z" point up. Throws InputError for another word.
Mat3 turn_of(const std::string& up);
/// Adds notes on rows of the map without objects, and on objects without rows.
void note_strangers(const std::vector<Shell>& shells, const std::vector<NameRow>& meant, const std::vector<bool>& used,
                    const NameMap& map, std::vector<std::string>& notes);
/// Joins pieces that belong together by the map or the rule into one stone; before, each is a stone. Throws InputError
/// for pieces that do not touch, or for which the map gives different values.
void join_cells(Import& import, CellRule rule, const JointSearch& search, const std::string& path);
/// Sets components and parts of stones as in the map.
void give_places(Import& import);
/// Sets the material of every stone. Throws InputError for an object with two materials, for a name that fits no
/// object, and for an unknown material.
void give_materials(Import& import, const ImportOptions& options, const std::string& path);
/// Fixes the stones of `options.fixed` or, with `keep_fixed`, those of the file or the map if these fix any. The map
/// takes precedence. Returns whether `fixed` was used. Throws InputError for a stone that does not exist.
bool fix_stones(Import& import, const ImportOptions& options, const std::string& path);
/// Adds notes on probable mistakes: nothing can move, nothing is fixed, no joint, a model that lies on its side.
void note_what_surprises(Import& import, const ImportOptions& options, const std::string& path);
/// Imports an assembly file: shapes, materials, groups and sensors stay, joints are found again. Throws InputError if
/// the joints do not follow from the shapes (ties, a fill, effects).
Import import_assembly(const std::string& path, const ImportOptions& options);

}  // namespace voussoir
