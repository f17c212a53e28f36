// Taking a file's surfaces apart into closed shells, one a stone.
#pragma once
#include <string>
#include <vector>

#include "geometry/polyhedron.h"
#include "io/vtk/surface_file.h"

namespace voussoir {

/// One closed surface and where it came from.
struct Shell {
  Polyhedron shape;      // file units, outward loops
  std::string name;      // of its object, with #2, #3 … where an object holds several shells
  std::size_t line = 0;  // of its first face; 0: unknown
  bool flipped = false;  // the file had it inside-out
  std::string object{};  // its name, without number
  std::string layer{};   // of its object
  bool support = false;  // as the file says of its object
};

/// Splits every object of the surface into closed shells: first by shared vertices; what is not closed that way has its
/// corners of equal place welded and is followed from face to face over shared edges, at an edge of several stones by
/// the sharper inner angle. Inside-out shells are turned. A face that stands there
/// twice is taken once, with a note. `path` is for messages. Throws InputError naming object and
/// line when a surface is not closed or bounds no volume.
std::vector<Shell> split_shells(const Surface& surface, const std::string& path, std::vector<std::string>& notes);

}  // namespace voussoir
