#include "io/case/material_table.h"

#include "io/toml/table_reader.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"

namespace voussoir {

std::vector<MaterialOfObjects> read_material_table(const std::string& path, const Material& usual) {
  const toml::table text = parse_toml(read_text(path), path);
  TableReader root(text, path, "the file");
  auto tables = root.table("materials", "[materials]");
  root.finish();
  if (!tables) root.missing("materials", "tables such as [materials.iron], each with its objects and values");
  std::vector<MaterialOfObjects> materials;
  std::string for_all;
  for (const std::string& name : tables->keys()) {
    TableReader table = tables->member(name, fmt::format("[materials.{}]", name));
    MaterialOfObjects& own = materials.emplace_back();
    if (table.has("objects")) own.objects = table.texts("objects");
    if (table.has("objects") && own.objects.empty())
      table.fail("objects", "is empty. Name the objects, or leave the key out.");
    if (own.objects.empty() && !for_all.empty())
      table.fail(fmt::format(
          "has no objects, and neither has [materials.{}]. Only one material can apply to all other objects.",
          for_all));
    if (own.objects.empty()) for_all = name;
    own.material = usual;
    own.material.name = name;
    read_material(table, own.material);
  }
  if (materials.empty()) tables->fail("is empty. Give at least one table [materials.NAME].");
  return materials;
}

}  // namespace voussoir
