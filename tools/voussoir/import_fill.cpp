#include "tools/voussoir/import_fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "geometry/fill_import.h"
#include "io/hdf5/assembly_file.h"
#include "io/msh/msh_file.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"
#include "tools/voussoir/assembly_table.h"

namespace voussoir {

namespace {

bool given(const options::variables_map& values, const char* name) {
  return !values[name].defaulted();
}

/// A new material for the fill. The defaults are those of a loose gravel fill, not of a stone.
Material new_material(const options::variables_map& values, const std::string& name) {
  Material m = {name, 1500.0, 4e8, 1.6e8, 0.0, 2e4, 40.0 * pi / 180.0};
  if (given(values, "density")) m.density = values["density"].as<double>();
  if (given(values, "youngs-modulus")) m.youngs_modulus = values["youngs-modulus"].as<double>();
  if (given(values, "shear-modulus")) m.shear_modulus = values["shear-modulus"].as<double>();
  if (given(values, "tension")) m.tensile_strength = values["tension"].as<double>();
  if (given(values, "cohesion")) m.cohesion = values["cohesion"].as<double>();
  if (given(values, "friction")) m.friction_angle = angle(values, "friction");
  m.dilation_angle = angle(values, "dilation");
  if (m.dilation_angle > m.friction_angle)
    throw InputError("--dilation is {} degrees. It must be at most the friction angle, {:g} degrees",
                     values["dilation"].as<double>(), m.friction_angle * 180.0 / pi);
  return m;
}

/// Index of the material of that name. If there is none, a new one is added at the end of the list.
std::int32_t find_material(const options::variables_map& values, Assembly& assembly) {
  const std::string name = values["material"].as<std::string>();
  for (std::size_t i = 0; i < assembly.materials.size(); ++i) {
    if (assembly.materials[i].name != name) continue;
    for (const char* number :
         {"density", "youngs-modulus", "shear-modulus", "tension", "cohesion", "friction", "dilation"})
      if (given(values, number))
        throw InputError(
            "--{} is given, but the assembly already defines the material \"{}\". Leave the option out, or name a new "
            "material with --material",
            number, name);
    return std::int32_t(i);
  }
  assembly.materials.push_back(new_material(values, name));
  return std::int32_t(assembly.materials.size()) - 1;
}

FillInterface interface_of(const options::variables_map& values) {
  FillInterface interface;
  interface.kn = values["kn"].as<double>();
  interface.ks = values["ks"].as<double>();
  interface.share = values["interface-share"].as<double>();
  interface.friction = angle(values, "interface-friction");
  interface.search.gap = values["gap"].as<double>();
  return interface;
}

}  // namespace

double angle(const options::variables_map& values, const char* name) {
  return values[name].as<double>() * pi / 180.0;
}

double scale_asked(const options::variables_map& values) {
  if (!values.count("units")) return values["scale"].as<double>();
  const std::string unit = values["units"].as<std::string>();
  if (given(values, "scale")) throw InputError("--units and --scale are both given. Give only one of them");
  static const std::vector<std::pair<std::string, double>> units = {
      {"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
  std::vector<std::string> known;
  for (const auto& [name, metres] : units) {
    if (name == unit) return metres;
    known.push_back(name);
  }
  throw InputError("--units is '{}'. It must be one of {}", shown(unit), fmt::join(known, ", "));
}

bool is_fill_file(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".msh";
}

int import_fill(const options::variables_map& values) {
  const std::string file = values["FILE"].as<std::string>(), to = values["output"].as<std::string>();
  Assembly assembly;
  assembly.generator = "import";
  const bool into = values.count("into") > 0;
  if (into) assembly = read_assembly(values["into"].as<std::string>());
  const std::size_t known = assembly.materials.size();
  const std::int32_t material = find_material(values, assembly);
  const FillInterface interface = interface_of(values);
  FillMesh mesh = read_msh(file, scale_asked(values));
  FillJointReport report;
  try {
    report = put_fill(assembly, std::move(mesh), material, interface);
  } catch (const InputError& error) {
    throw InputError("{}: {}", file, error.what());
  }
  write_assembly(to, assembly);
  if (values.count("quiet")) return 0;
  if (assembly.materials.size() > known)
    fmt::print("the fill's material \"{}\" is new: {:g} kg/m3, E {:g} Pa, G {:g} Pa\n", assembly.materials.back().name,
               assembly.materials.back().density, assembly.materials.back().youngs_modulus,
               assembly.materials.back().shear_modulus);
  if (into)
    fmt::print("gaps closed: {}, the largest {:.3g} m\n", counted(report.closed_gaps, "patch", "patches"),
               report.largest_closed_gap);
  else
    fmt::print("The assembly holds only the fill. Give --into ASSEMBLY to put it between stones\n");
  print_assembly_table(assembly);
  fmt::print("written to {}\n", to);
  return 0;
}

}  // namespace voussoir
