// Imports stones of other programs: converts a surface file or an assembly file into an assembly.
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

/// Closed shapes of a surface file that are convex cells of one stone. none: each shape is a stone; objects: the shapes
/// of one object; names: those of objects whose names differ only in a number after the last point (corbel.1,
/// corbel.2).
enum class CellRule { none, objects, names };

struct ImportOptions {
  double scale = 1.0;  // m per unit of the file
  std::string up;      // axis of the file that points up: x, y, z, -x, -y or -z; empty: as the format states, else z
  Material material = {"stone", 2000.0, 4.0e9, 1.6e9, 0.0, 0.0, 0.5235987755982988};  // dry, 30 degrees
  std::vector<MaterialOfObjects> materials;  // empty: `material` for all stones
  NameMap map;                               // meaning of objects by their names
  double kn = 0.0, ks = 0.0;                 // Pa/m of every joint; both 0: from the moduli and the sizes of the stones
  std::string fixed = "lowest";              // lowest, none, or names or numbers of stones: "0,3,plinth"
  CellRule cells = CellRule::none;
  double merge_angle = 1e-3;                 // rad: triangles with a smaller angle between them are one face
  double flatten = 1e-3;                     // share of the size of a stone up to which faces are made plane
  NotConvex not_convex = NotConvex::refuse;  // treatment of shapes beyond that
  JointSearch search = careful_search();
  /// The stones that the file or the map fixes are fixed. `fixed` is used only for a surface file, if neither it nor
  /// the map fixes a stone.
  bool keep_fixed = false;
  std::vector<double Material::*> given;  // values of `material` that replace those of an assembly file
};

struct Import {
  Assembly assembly;                 // finished: masses, joints, stiffness; group "object NAME" for each named object
  std::vector<std::string> names;    // name of each stone as in the file; empty: none
  std::vector<std::string> objects;  // object of each stone
  std::vector<NameRow> meant;        // row of the map for each stone
  std::vector<bool> supports;        // whether the file fixes the stone
  JointReport joints;
  std::vector<std::string> notes;  // repairs and unexpected facts, for the log
};

/// Reads a file of surfaces (surface_formats()), whose closed convex shapes become stones or cells of stones and whose
/// nearly plane faces are made plane; or an assembly file (HDF5), whose joints are found again. Throws InputError with
/// object and line for a shape that is not closed, not convex or without volume, for stones that overlap, and for an
/// unknown stone in `fixed`.
Import import_blocks(const std::string& path, const ImportOptions& options = {});
/// Imports surfaces that are already in memory. `path` is used in messages. `meaning`, if given, takes the place of
/// options.map for each closed shape.
Import import_surface(const Surface& surface, const std::string& path, const ImportOptions& options,
                      const std::function<NameRow(const Shell&)>& meaning = {});

}  // namespace voussoir
