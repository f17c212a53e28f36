// voussoir export.
#include <fmt/format.h>

#include <filesystem>

#include "io/case/case.h"
#include "io/hdf5/assembly_file.h"
#include "io/hdf5/h5.h"
#include "io/vtk/export_blocks.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace {

int export_shapes(const std::vector<std::string>& arguments) {
  CommandLine line("export", "export CASE|ASSEMBLY -o FILE.obj|FILE.json",
                   "voussoir export cases/cs2-f.toml -o bridge.obj");
  line.described.add_options()(
      "output,o", options::value<std::string>()->value_name("FILE"),
      "file to write: .obj, or .json for COMPAS; the map for import is written to FILE.names.toml");
  line.positional = line.required = {"CASE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  if (!values.count("output")) throw InputError("-o FILE is missing. Usage: voussoir {}", line.usage);
  const std::string file = values["CASE"].as<std::string>(), to = values["output"].as<std::string>();
  const std::string ending = std::filesystem::path(to).extension().string();
  if (ending != ".obj" && ending != ".json")
    throw InputError("-o {}: the ending of the file selects the format. It must be .obj or .json", shown(to, 300));
  const std::string names = std::filesystem::path(to).replace_extension(".names.toml").string();
  const Assembly assembly =
      h5::File::is_hdf5(file) ? read_assembly(file) : make_assembly(read_case(file, CaseUse::geometry));
  if (assembly.blocks.empty()) throw InputError("{}: the assembly has no blocks. Only blocks can be exported", file);
  const ExportedBlocks out = ending == ".obj" ? export_obj(assembly) : export_compas(assembly);
  write_atomically(to, out.text);
  write_atomically(names, text_of(out.map));
  if (values.count("quiet")) return 0;
  std::size_t cells = 0;
  for (const Block& block : assembly.blocks) cells += block.cells.size();
  for (const std::string& note : out.notes) fmt::print("{}\n", with_full_stop(note));
  fmt::print("{} of {} written to {}, the map of their names to {}\n", counted(assembly.blocks.size(), "block"),
             counted(cells, "cell"), to, names);
  fmt::print("To import them again: voussoir import {} --map {} --gap 1e-6 -o ASSEMBLY.h5\n", to, names);
  return 0;
}

}  // namespace

Verb export_verb() {
  return {"export", "write the blocks for other programs (OBJ, COMPAS), with a map of their names", export_shapes};
}

}  // namespace voussoir
