// A table of materials for stones drawn with another program: the materials of the objects of a drawing.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

class TableReader;

/// A material and its objects; without objects it is for all objects that no other material names.
struct MaterialOfObjects {
  Material material;
  std::vector<std::string> objects;  // names; * stands for any text
};

/// Reads [materials.NAME] tables with the keys of a case and `objects`; keys that are not given come from `usual`.
/// Throws InputError "FILE:LINE: …".
std::vector<MaterialOfObjects> read_material_table(const std::string& path, const Material& usual);

/// Reads the numbers of one table. The other keys must have been read before.
void read_material(TableReader& table, Material& material);

}  // namespace voussoir
