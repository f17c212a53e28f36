// Stones modelled elsewhere: a surface file, or the assembly file of another program, to an assembly.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "geometry/joints.h"
#include "io/case/material_table.h"
#include "io/case/name_map.h"

namespace voussoir {

struct Shell;
struct Surface;

/// Which closed shapes of a surface file are convex cells of one stone: none; those of one object; those of objects
/// whose names differ only in a number behind the last point (corbel.1, corbel.2).
enum class CellRule { none, objects, names };

struct ImportOptions {
  double scale = 1.0;  // m per unit of the file
  std::string up;      // the file's axis that points up: x, y, z, -x, -y or -z; empty: as the format has it, else z
  Material material = {"stone", 2000.0, 4.0e9, 1.6e9, 0.0, 0.0, 0.5235987755982988};  // dry, 30 degrees
  std::vector<MaterialOfObjects> materials;  // empty: `material` for all stones
  NameMap map;                               // what objects are, by their names
  double kn = 0.0, ks = 0.0;                 // Pa/m of every joint; both 0: from the moduli and the stones' sizes
  std::string fixed = "lowest";              // lowest, none, or names or numbers of stones: "0,3,plinth"
  CellRule cells = CellRule::none;
  double merge_angle = 1e-3;                 // rad: triangles that turn less are one face
  double flatten = 1e-3;                     // share of a stone's size up to which faces are made plane
  NotConvex not_convex = NotConvex::refuse;  // what becomes of shapes beyond that
  JointSearch search = careful_search();
  bool keep_fixed = false;  // what the file or the map fixes stays so and nothing else is, whatever `fixed` says
  std::vector<double Material::*> given;  // values of `material` that take the place of those of an assembly file
};

struct Import {
  Assembly assembly;                 // finished: masses, joints, stiffness; group "object NAME" for each named object
  std::vector<std::string> names;    // of each stone, as in the file; empty where it has none
  std::vector<std::string> objects;  // the object that each stone is of
  std::vector<NameRow> meant;        // what the map says of each
  std::vector<bool> supports;        // which the file says do not move
  JointReport joints;
  std::vector<std::string> notes;  // what was repaired or may surprise, for the log
};

/// Reads a file of surfaces (surface_formats()); every closed convex shape becomes one stone, or a cell of one. Faces
/// that are nearly plane are made so. Or an assembly file (HDF5), whose joints are found anew. Throws InputError that
/// names the object and the line for a shape that is not closed, not convex or without volume, for stones that overlap,
/// and for an unknown stone in `fixed`.
Import import_blocks(const std::string& path, const ImportOptions& options = {});
/// The same of surfaces that are at hand; `path` is for messages, and `meaning`, where it is given, says of each closed
/// shape what options.map would.
Import import_surface(const Surface& surface, const std::string& path, const ImportOptions& options,
                      const std::function<NameRow(const Shell&)>& meaning = {});

}  // namespace voussoir
