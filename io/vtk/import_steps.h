// What stones drawn elsewhere and assemblies of other programs have in common on their way in.
#pragma once
#include "io/vtk/import.h"
#include "io/vtk/shells.h"

namespace voussoir {

/// The rotation that makes the axis "x", "y", "z", "-x", "-y" or "-z" point up. Throws InputError for another word.
Mat3 turn_of(const std::string& up);
/// Adds notes on names that the map and the drawing do not have in common.
void note_strangers(const std::vector<Shell>& shells, const std::vector<NameRow>& meant, const std::vector<bool>& used,
                    const NameMap& map, std::vector<std::string>& notes);
/// Makes one stone of the pieces that the map or the rule says belong together; until then each is a stone. Throws
/// InputError for pieces that do not touch, or of which the map says different things.
void join_cells(Import& import, CellRule rule, const JointSearch& search, const std::string& path);
/// Gives stones the components and parts that the map says.
void give_places(Import& import);
/// Gives every stone the material for its object. Throws InputError for an object of two materials, for a name that
/// fits none, and for a material that is not known.
void give_materials(Import& import, const ImportOptions& options, const std::string& path);
/// Fixes what `options.fixed` names, or with `keep_fixed` what the file or the map says where they say anything. The
/// map comes before all else. Whether it was `fixed` that decided. Throws InputError for a stone that is not there.
bool fix_stones(Import& import, const ImportOptions& options, const std::string& path);
/// Adds notes on what cannot be meant: nothing that can move, nothing fixed, no joint, a model that lies on its side.
void note_what_surprises(Import& import, const ImportOptions& options, const std::string& path);
/// An assembly file: its shapes, materials, groups and sensors stay, its joints are found anew. Throws InputError for
/// one whose joints cannot be found from shapes (ties, a fill, effects).
Import import_assembly(const std::string& path, const ImportOptions& options);

}  // namespace voussoir
