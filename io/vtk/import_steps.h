// What stones drawn elsewhere and assemblies of other programs have in common on their way in.
#pragma once
#include "io/vtk/import.h"

namespace voussoir {

/// The rotation that makes the axis "x", "y", "z", "-x", "-y" or "-z" point up. Throws InputError for another word.
Mat3 turn_of(const std::string& up);
/// Makes one stone of the pieces that the rule says belong together; until then each is a stone. Throws InputError for
/// pieces that do not touch.
void join_cells(Import& import, CellRule rule, const JointSearch& search, const std::string& path);
/// Gives every stone the material for its object. Throws InputError for an object of two materials and for a name that
/// fits none.
void give_materials(Import& import, const ImportOptions& options, const std::string& path);
/// Fixes what `options.fixed` names. Throws InputError for a stone that is not there.
void fix_stones(Import& import, const ImportOptions& options);
/// Adds notes on what cannot be meant: nothing that can move, nothing fixed, no joint, a model that lies on its side.
void note_what_surprises(Import& import, const ImportOptions& options, const std::string& path);
/// An assembly file: its shapes, materials, groups and sensors stay, its joints are found anew. Throws InputError for
/// one whose joints cannot be found from shapes (ties, a fill, effects).
Import import_assembly(const std::string& path, const ImportOptions& options);

}  // namespace voussoir
