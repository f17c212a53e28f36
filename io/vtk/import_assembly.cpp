// Imports assemblies of other programs: finds missing data, and applies the options.
#include <algorithm>

#include "geometry/stiffness.h"
#include "io/hdf5/assembly_file.h"
#include "io/vtk/import_steps.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {
namespace {

/// Joints that cannot be found from shapes would be lost.
void check_joints(const Assembly& assembly, const std::string& path) {
  const char* held = nullptr;
  if (!assembly.fill.empty()) held = "a deformable fill";
  if (!assembly.effects.empty()) held = "changes by effects";
  for (const Joint& joint : assembly.joints)
    if (assembly.laws[std::size_t(joint.law)].kind == JointLaw::Kind::tie) held = "ties";
  if (held)
    throw InputError(
        "{}: it has {}, which would be lost if its joints were found again. Use the file without import (assembly = "
        "\"...\" in [bridge]), or import the file from which it was made.",
        path, held);
}

/// Whether a material has a density only, as in files of shapes and densities.
bool states_density_only(const Material& m) {
  return m.youngs_modulus == 0.0 && m.shear_modulus == 0.0 && m.tensile_strength == 0.0 && m.cohesion == 0.0 &&
         m.friction_angle == 0.0;
}

void change_materials(Import& import, const ImportOptions& options, const std::string& path) {
  bool filled = false;
  for (Material& own : import.assembly.materials) {
    if (states_density_only(own)) {
      Material whole = options.material;
      whole.name = own.name;
      whole.density = own.density;
      own = whole;
      filled = true;
    }
    for (const auto member : options.given) own.*member = options.material.*member;
  }
  if (filled)
    import.notes.push_back(fmt::format(
        "{}: the file states only densities; moduli and strengths are those of the options (E {:g} Pa, G {:g} Pa)",
        path, options.material.youngs_modulus, options.material.shear_modulus));
}

void turn(Assembly& assembly, const Mat3& by) {
  if (by.isIdentity()) return;
  for (Block& block : assembly.blocks)
    for (Polyhedron& cell : block.cells)
      for (Vec3& v : cell.vertices) v = by * v;
  for (Sensor& sensor : assembly.sensors)
    sensor.position = by * sensor.position, sensor.direction = by * sensor.direction;
}

std::vector<std::string> names_of_stones(const Assembly& assembly) {
  std::vector<std::string> names(assembly.blocks.size());
  for (const auto& [group, members] : assembly.groups)
    if (group.starts_with(object_group_prefix))
      for (const std::int64_t i : members)
        names[std::size_t(i)] = group.substr(std::string_view(object_group_prefix).size());
  return names;
}

}  // namespace

Import import_assembly(const std::string& path, const ImportOptions& options) {
  if (options.scale != 1.0)
    throw InputError("{}: --scale is {}, but assembly files are in metres. Leave it out.", path, options.scale);
  if (options.cells != CellRule::none || !options.materials.empty() || !options.map.empty())
    throw InputError(
        "{}: --cells, --materials and --map are for files of surfaces. An assembly file states cells, materials, "
        "components and groups itself.",
        path);
  Import import;
  Assembly& assembly = import.assembly = read_stated_assembly(path);
  turn(assembly, turn_of(options.up.empty() ? "z" : options.up));
  check_joints(assembly, path);
  change_materials(import, options, path);
  finish_blocks(assembly);
  import.names = import.objects = names_of_stones(assembly);
  import.meant.resize(import.names.size());
  import.supports.resize(import.names.size());
  if (!options.keep_fixed) {
    for (Block& block : assembly.blocks) block.fixed = false;
    fix_stones(import, options, path);
  }
  const std::size_t stated = assembly.joints.size();
  assembly.joints.clear();
  try {
    import.joints = lay_joints(assembly, options.search, {options.kn, options.ks});
  } catch (const InputError& error) {
    throw InputError("{}: {}", path, error.what());
  }
  if (stated > 0)
    import.notes.push_back(fmt::format("{}: the program has ignored its {} and has found {}", path,
                                       counted(stated, "joint"), counted(assembly.joints.size(), "joint")));
  ImportOptions meant = options;
  if (options.keep_fixed) meant.fixed = "as stated";
  note_what_surprises(import, meant, path);
  return import;
}

}  // namespace voussoir
