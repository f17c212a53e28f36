// voussoir import.
#include "io/vtk/import.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/case/material_table.h"
#include "io/hdf5/assembly_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "tools/voussoir/assembly_table.h"
#include "tools/voussoir/import_fill.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace {

CellRule cell_rule(const std::string& word) {
  if (word == "none") return CellRule::none;
  if (word == "objects") return CellRule::objects;
  if (word == "names") return CellRule::names;
  throw InputError("--cells is '{}'. It must be none, objects or names", word);
}

NotConvex not_convex(const std::string& word) {
  const auto& words = not_convex_words();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) throw InputError("--not-convex is '{}'. It must be {}", word, fmt::join(words, ", "));
  return NotConvex(found - words.begin());
}

ImportOptions import_options(const options::variables_map& values) {
  ImportOptions o;
  o.scale = scale_asked(values);
  o.fixed = values["fixed"].as<std::string>();
  o.material.density = values["density"].as<double>();
  o.material.youngs_modulus = values["youngs-modulus"].as<double>();
  o.material.shear_modulus = values["shear-modulus"].as<double>();
  o.material.tensile_strength = values["tension"].as<double>();
  o.material.cohesion = values["cohesion"].as<double>();
  o.material.friction_angle = angle(values, "friction");
  if (values.count("up")) o.up = values["up"].as<std::string>();
  o.cells = cell_rule(values["cells"].as<std::string>());
  o.flatten = values["flatten"].as<double>();
  o.not_convex = not_convex(values["not-convex"].as<std::string>());
  if (values.count("map")) o.map = read_name_map(values["map"].as<std::string>(), o.material);
  if (values.count("materials")) o.materials = read_material_table(values["materials"].as<std::string>(), o.material);
  o.kn = values["kn"].as<double>();
  o.ks = values["ks"].as<double>();
  o.search = careful_search(values["gap"].as<double>());
  o.keep_fixed = values["fixed"].defaulted();
  for (const auto& [name, member] :
       std::initializer_list<std::pair<const char*, double Material::*>>{{"density", &Material::density},
                                                                         {"youngs-modulus", &Material::youngs_modulus},
                                                                         {"shear-modulus", &Material::shear_modulus},
                                                                         {"tension", &Material::tensile_strength},
                                                                         {"cohesion", &Material::cohesion},
                                                                         {"friction", &Material::friction_angle}})
    if (!values[name].defaulted()) o.given.push_back(member);
  return o;
}

/// Refuses options that belong to the other kind of file.
void check_kind(const options::variables_map& values, bool fill) {
  const auto given = [&](const char* name) { return values.count(name) && !values[name].defaulted(); };
  for (const char* name : {"into", "material", "interface-share", "interface-friction", "dilation"})
    if (!fill && given(name))
      throw InputError("--{} applies to a fill (.msh), but this file holds stones. Leave the option out", name);
  for (const char* name : {"fixed", "up", "cells", "flatten", "not-convex", "map", "materials"})
    if (fill && given(name))
      throw InputError("--{} applies to stones, but a .msh file holds a fill. Leave the option out", name);
}

int import(const std::vector<std::string>& arguments) {
  CommandLine line("import", "import FILE -o ASSEMBLY",
                   "voussoir import vault.obj -o vault.h5 --density 2200 --fixed lowest");
  line.described.add_options()("output,o", options::value<std::string>()->value_name("FILE"), "assembly file to write")(
      "units", options::value<std::string>()->value_name("UNIT"), "unit of length of the file: m, cm, mm, in, ft")(
      "scale", real_option("scale", 1e-9, 1e6)->default_value(1.0),
      "the unit of length as a number: metres per unit of the file")(
      "up", options::value<std::string>()->value_name("AXIS"),
      "axis of the file that points up: x, y, z, -x, -y, -z (default: z; for glTF y)")(
      "map", options::value<std::string>()->value_name("FILE"),
      "TOML file that assigns properties to objects by their names: [names] \"arch*\" = {component = \"arch\", part = "
      "0, material = ..., group = ..., fixed = ..., block = ..., not_convex = ...}; the same by layers: [layers]; "
      "[materials.NAME] as in a case")(
      "cells", options::value<std::string>()->default_value("none"),
      "pieces that are one stone: none; objects: the closed shapes of one object; names: also objects whose names "
      "differ only in the number after the last point (corbel.1, corbel.2)")(
      "flatten", real_option("flatten", 0.0, 0.1)->default_value(1e-3),
      "largest deviation of a face from a plane, as a share of the stone's size (at least --gap); the face is made "
      "plane")("not-convex", options::value<std::string>()->default_value("refuse"),
               "treatment of shapes that are not convex beyond --flatten: refuse; hull: use the convex hull; cut: cut "
               "into convex cells of one stone")(
      "materials", options::value<std::string>()->value_name("FILE"),
      "TOML file with tables [materials.NAME]: the keys of a case and objects = [\"corbel*\", ...]; keys that are left "
      "out are as the options say")(
      "fixed", options::value<std::string>()->default_value("lowest"),
      "blocks that move with the ground: lowest, none, or names or numbers of objects, separated by commas; without "
      "this option: those of the map, of an assembly file or of the supports of a COMPAS file, otherwise lowest")(
      "density", real_option("density", 1e-6, 1e5)->default_value(2000.0),
      "density of the stones or of the fill, kg/m3")(
      "youngs-modulus", real_option("youngs-modulus", 1.0, 1e13)->default_value(4e9, "4e9"),
      "Young's modulus of the stones or of the fill, Pa")(
      "shear-modulus", real_option("shear-modulus", 1.0, 1e13)->default_value(1.6e9, "1.6e9"),
      "shear modulus of the stones or of the fill, Pa")("tension",
                                                        real_option("tension", 0.0, 1e10)->default_value(0.0),
                                                        "tensile strength of the joints or of the fill, Pa")(
      "cohesion", real_option("cohesion", 0.0, 1e10)->default_value(0.0), "cohesion of the joints or of the fill, Pa")(
      "friction", real_option("friction", 0.0, 89.0)->default_value(30.0),
      "friction angle of the joints or of the fill, degrees")(
      "kn", real_option("kn", 0.0, 1e15)->default_value(0.0),
      "normal stiffness of every joint, Pa/m; 0: from the moduli")(
      "ks", real_option("ks", 0.0, 1e15)->default_value(0.0),
      "shear stiffness of every joint, Pa/m; 0: from the moduli")(
      "gap", real_option("gap", 1e-9, 0.1)->default_value(1e-4), "faces closer than this are in contact, m")(
      "into", options::value<std::string>()->value_name("ASSEMBLY"), ".msh: assembly into which the fill is put")(
      "material", options::value<std::string>()->value_name("NAME")->default_value("backfill"),
      ".msh: name of the fill's material, one of the assembly or a new one; defaults of a new material: 1500 kg/m3, E "
      "4e8 Pa, G 1.6e8 Pa, tension 0, cohesion 2e4 Pa, friction 40 degrees")(
      "dilation", real_option("dilation", 0.0, 89.0)->default_value(0.0),
      ".msh: dilation angle of a new material, degrees")(
      "interface-share", real_option("interface-share", 1e-6, 1e6)->default_value(0.2, "0.2"),
      ".msh: stiffness of the patches as a share of E/dc and G/dc of the stones")(
      "interface-friction", real_option("interface-friction", 0.0, 89.0)->default_value(35.0),
      ".msh: friction angle of the patches, degrees");
  line.positional = line.required = {"FILE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  if (!values.count("output")) throw InputError("-o ASSEMBLY is missing. Usage: voussoir {}", line.usage);
  check_ending(values["output"].as<std::string>(), {".h5", ".hdf5"}, "an HDF5 assembly");
  const bool fill = is_fill_file(values["FILE"].as<std::string>());
  check_kind(values, fill);
  if (fill) return import_fill(values);
  const Import imported = import_blocks(values["FILE"].as<std::string>(), import_options(values));
  write_assembly(values["output"].as<std::string>(), imported.assembly);
  if (values.count("quiet")) return 0;
  for (const std::string& note : imported.notes) fmt::print("{}\n", with_full_stop(note));
  fmt::print("gaps closed: {}, the largest {:.3g} m; gaps left open: {}\n",
             counted(imported.joints.closed_gaps, "joint"), imported.joints.largest_closed_gap,
             imported.joints.open_gaps);
  print_assembly_table(imported.assembly);
  fmt::print("written to {}\n", values["output"].as<std::string>());
  return 0;
}

}  // namespace

Verb import_verb() {
  return {"import",
          "make an assembly from stones (OBJ, PLY, STL, glTF, COMPAS, HDF5) or a fill (Gmsh) of another program",
          import};
}

}  // namespace voussoir
