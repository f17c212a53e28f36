// Surfaces as other programs write them (OBJ, PLY, STL), before they are taken apart into stones.
#pragma once
#include <string>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// The faces that stand under one name in a file: an object of an OBJ, a solid of an STL, all of a PLY.
struct FileObject {
  std::string name;        // as written; empty where the format has none
  std::size_t line = 0;    // of its first face in a text file; 0: unknown
  std::vector<int> faces;  // into Surface::faces
};

struct Surface {
  std::vector<Vec3> vertices;           // file units
  std::vector<std::vector<int>> faces;  // vertex loops as written
  std::vector<std::size_t> face_lines;  // line of each face; 0: unknown
  std::vector<FileObject> objects;      // in file order, none empty
  std::vector<std::string> notes;       // what was passed over, in words
};

/// Reads .obj, .ply or .stl (by the ending, in any case). Throws InputError naming file and line where one is known.
Surface read_surface(const std::string& path);
// The same of a file's bytes; `path` is for messages.

/// OBJ: v, f (also negative and slashed indices), o, g; other keywords are passed over. Objects are those of `o`, or of
/// `g` in a file without `o`.
Surface parse_obj(const std::string& text, const std::string& path);
/// STL, text or binary. Each `solid` of a text file is an object. Corners with the very same coordinates are one
/// vertex. Bytes behind the last facet of a binary file are passed over with a note.
Surface parse_stl(const std::string& bytes, const std::string& path);
/// PLY 1.0, text or binary: the elements `vertex` (x, y, z) and `face` (vertex_indices); others are passed over.
Surface parse_ply(const std::string& bytes, const std::string& path);

}  // namespace voussoir
