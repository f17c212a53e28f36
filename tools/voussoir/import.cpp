// voussoir import.
#include "io/vtk/import.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "io/hdf5/assembly_file.h"
#include "solver/base/error.h"
#include "tools/voussoir/assembly_table.h"
#include "tools/voussoir/verb.h"

namespace voussoir {

namespace {

double positive(const options::variables_map& values, const char* name) {
  const double x = values[name].as<double>();
  if (!(x > 0.0 && std::isfinite(x))) throw InputError("--{} is {}; it must be positive and finite", name, x);
  return x;
}

double zero_or_more(const options::variables_map& values, const char* name) {
  const double x = values[name].as<double>();
  if (!(x >= 0.0 && std::isfinite(x))) throw InputError("--{} is {}; it must be 0 or more, and finite", name, x);
  return x;
}

ImportOptions import_options(const options::variables_map& values) {
  ImportOptions o;
  o.scale = positive(values, "scale");
  o.fixed = values["fixed"].as<std::string>();
  o.material.density = positive(values, "density");
  o.material.youngs_modulus = positive(values, "youngs-modulus");
  o.material.shear_modulus = positive(values, "shear-modulus");
  o.material.tensile_strength = zero_or_more(values, "tension");
  o.material.cohesion = zero_or_more(values, "cohesion");
  const double friction = values["friction"].as<double>();
  if (!(friction >= 0.0 && friction < 90.0))
    throw InputError("--friction is {} degrees; it must be from 0 to below 90", friction);
  o.material.friction_angle = friction * std::numbers::pi / 180.0;
  o.kn = zero_or_more(values, "kn");
  o.ks = zero_or_more(values, "ks");
  o.search.gap = positive(values, "gap");
  return o;
}

int import(const std::vector<std::string>& arguments) {
  CommandLine line("import", "import FILE -o ASSEMBLY",
                   "voussoir import vault.obj -o vault.h5 --density 2200 --fixed lowest");
  line.described.add_options()("output,o", options::value<std::string>()->value_name("FILE"), "assembly file to write")(
      "scale", options::value<double>()->default_value(1.0), "metres per unit of the file")(
      "fixed", options::value<std::string>()->default_value("lowest"),
      "what moves with the ground: lowest, none, or names or numbers")(
      "density", options::value<double>()->default_value(2000.0), "kg/m3")(
      "youngs-modulus", options::value<double>()->default_value(4e9), "Pa")(
      "shear-modulus", options::value<double>()->default_value(1.6e9), "Pa")(
      "tension", options::value<double>()->default_value(0.0), "tensile strength of the joints, Pa")(
      "cohesion", options::value<double>()->default_value(0.0), "Pa")(
      "friction", options::value<double>()->default_value(30.0), "degrees")(
      "kn", options::value<double>()->default_value(0.0), "Pa/m of every joint; 0: from the moduli")(
      "ks", options::value<double>()->default_value(0.0), "Pa/m of every joint; 0: from the moduli")(
      "gap", options::value<double>()->default_value(1e-4), "m: faces closer than this are in contact");
  line.positional = line.required = {"FILE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  if (!values.count("output")) throw InputError("-o ASSEMBLY is missing; usage: voussoir {}", line.usage);
  const Import imported = import_blocks(values["FILE"].as<std::string>(), import_options(values));
  write_assembly(values["output"].as<std::string>(), imported.assembly);
  if (values.count("quiet")) return 0;
  for (const std::string& note : imported.notes) fmt::print("{}\n", note);
  fmt::print("gaps closed: {} joints, largest {:.3g} m; left open: {}\n", imported.joints.closed_gaps,
             imported.joints.largest_closed_gap, imported.joints.open_gaps);
  print_assembly_table(imported.assembly);
  fmt::print("written to {}\n", values["output"].as<std::string>());
  return 0;
}

}  // namespace

Verb import_verb() {
  return {"import", "blocks made elsewhere (OBJ, PLY, STL) to an assembly", import};
}

}  // namespace voussoir
