// Blocks for other programs, and the map of names with which import makes the same assembly of them again.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "io/case/name_map.h"

namespace voussoir {

struct ExportedBlocks {
  std::string text;                // of the file of shapes: m, z up, every digit
  NameMap map;                     // components, parts, materials, groups, fixed blocks, cells of blocks
  std::vector<std::string> notes;  // what the assembly holds and the files do not
};

/// Every convex cell is an object (OBJ) or a node with a mesh (JSON of COMPAS 2, compas_assembly) of the name
/// COMPONENT_PART_bBLOCK_cCELL; an OBJ's objects lie in groups COMPONENT_PART. Joints are not written: they are found
/// anew where faces meet.
ExportedBlocks export_obj(const Assembly& assembly);
ExportedBlocks export_compas(const Assembly& assembly);

}  // namespace voussoir
