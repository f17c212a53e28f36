// A table of materials for stones drawn elsewhere: which material the objects of a drawing are of.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

class TableReader;

/// A material and the objects it is for; without any, for all that no other names.
struct MaterialOfObjects {
  Material material;
  std::vector<std::string> objects;  // names, where * stands for any text
};

/// Reads [materials.NAME] tables with the keys of a case and `objects`; what one leaves out is taken from `usual`.
/// Throws InputError "FILE:LINE: …".
std::vector<MaterialOfObjects> read_material_table(const std::string& path, const Material& usual);

/// The numbers of one table; its other keys have been read before.
void read_material(TableReader& table, Material& material);

}  // namespace voussoir
