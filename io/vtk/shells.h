// Splits the surfaces of a file into closed shells, one for each stone.
#pragma once
#include <string>
#include <vector>

#include "geometry/polyhedron.h"
#include "io/vtk/surface_file.h"

namespace voussoir {

/// One closed surface and its origin in the file.
struct Shell {
  Polyhedron shape;      // file units, outward loops
  std::string name;      // name of its object, with #2, #3 … if the object has several shells
  std::size_t line = 0;  // of its first face; 0: unknown
  bool flipped = false;  // its faces were inside-out in the file
  std::string object{};  // name of the object, without number
  std::string layer{};   // layer of the object
  bool support = false;  // whether the file fixes the object
};

/// Splits every object of the surface into closed shells, first by shared vertices. If a shell is then not closed,
/// corners at the same place are welded, and faces are joined over shared edges. At an edge of several stones each face
/// is joined to the one with the smallest inner angle between them. Inside-out shells are reversed. A face that occurs
/// twice is used once, with a note. `path` is used in messages. Throws InputError with object and line if a surface is
/// not closed or encloses no volume.
std::vector<Shell> split_shells(const Surface& surface, const std::string& path, std::vector<std::string>& notes);

}  // namespace voussoir
