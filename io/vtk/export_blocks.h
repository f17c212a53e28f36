// Exports blocks for other programs, with the map of names with which import makes the same assembly again.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "io/case/name_map.h"

namespace voussoir {

struct ExportedBlocks {
  std::string text;                // text of the file of shapes: m, z up, all digits
  NameMap map;                     // components, parts, materials, groups, fixed blocks, cells of blocks
  std::vector<std::string> notes;  // parts of the assembly that the files do not have
};

/// Every convex cell is an object (OBJ) or a node with a mesh (JSON of COMPAS 2, compas_assembly) with the name
/// COMPONENT_PART_bBLOCK_cCELL; the objects of an OBJ are in groups COMPONENT_PART. Joints are not written: an import
/// finds them where faces meet.
ExportedBlocks export_obj(const Assembly& assembly);
ExportedBlocks export_compas(const Assembly& assembly);

}  // namespace voussoir
