// Stones modelled elsewhere: a surface file to an assembly.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "geometry/joints.h"

namespace voussoir {

struct ImportOptions {
  double scale = 1.0;                                                                 // m per unit of the file
  Material material = {"stone", 2000.0, 4.0e9, 1.6e9, 0.0, 0.0, 0.5235987755982988};  // of all stones; dry, 30 degrees
  double kn = 0.0, ks = 0.0;     // Pa/m of every joint; both 0: from the moduli and the stones' sizes
  std::string fixed = "lowest";  // lowest, none, or names or numbers of stones: "0,3,plinth"
  double merge_angle = 1e-3;     // rad: triangles that turn less are one face
  JointSearch search;
};

struct Import {
  Assembly assembly;               // finished: masses, joints, stiffness; group "object NAME" for each named object
  std::vector<std::string> names;  // of each stone, as in the file; empty where it has none
  JointReport joints;
  std::vector<std::string> notes;  // what was repaired or may surprise, for the log
};

/// Reads .obj (objects), .ply or .stl; every closed convex shape becomes one stone. Throws InputError that names the
/// object and the line for a shape that is not closed, not convex or without volume, for stones that overlap, and for
/// an unknown stone in `fixed`.
Import import_blocks(const std::string& path, const ImportOptions& options = {});

}  // namespace voussoir
