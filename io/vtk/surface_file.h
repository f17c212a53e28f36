// Surfaces as other programs write them, before they are taken apart into stones.
#pragma once
#include <string>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// The faces that stand under one name in a file: an object of an OBJ, a solid of an STL, all of a PLY, a block of
/// COMPAS, a node of glTF.
struct FileObject {
  std::string name;        // as written; empty where the format has none
  std::size_t line = 0;    // of its first face in a text file; 0: unknown
  std::vector<int> faces;  // into Surface::faces
  std::string layer{};     // that it lies on: the group (`g`) of an OBJ's object, the node above in glTF
  bool support = false;    // the file says that it does not move
};

struct Surface {
  std::vector<Vec3> vertices;           // file units
  std::vector<std::vector<int>> faces;  // vertex loops as written
  std::vector<std::size_t> face_lines;  // line of each face; 0: unknown
  std::vector<FileObject> objects;      // in file order, none empty
  std::vector<std::string> notes;       // what was passed over, in words
  std::string up = "z";                 // the axis that points up by the format's rules
};

/// A kind of file. A new one is one file here and one line in surface_file.cpp.
struct SurfaceFormat {
  std::string ending;  // with the point, small letters
  Surface (*parse)(const std::string& bytes, const std::string& path);
};
const std::vector<SurfaceFormat>& surface_formats();

/// Reads a file of one of them (by its ending, in any case). Throws InputError naming file and line where one is known.
Surface read_surface(const std::string& path);
// The same of a file's bytes; `path` is for messages.

/// OBJ: v, f (also negative and slashed indices), o, g; other keywords are passed over. Objects are those of `o`, with
/// `g` as their layers, or those of `g` in a file without `o`.
Surface parse_obj(const std::string& text, const std::string& path);
/// STL, text or binary. Each `solid` of a text file is an object. Corners with the very same coordinates are one
/// vertex. Bytes behind the last facet of a binary file are passed over with a note.
Surface parse_stl(const std::string& bytes, const std::string& path);
/// PLY 1.0, text or binary: the elements `vertex` (x, y, z) and `face` (vertex_indices); others are passed over.
Surface parse_ply(const std::string& bytes, const std::string& path);
/// JSON of COMPAS: blocks of an Assembly, a Model or a list of meshes (compas_json.cpp says which forms).
Surface parse_compas(const std::string& text, const std::string& path);
/// glTF 2.0, as JSON (buffers embedded or in files beside `path`) or binary. y points up by the standard.
Surface parse_gltf(const std::string& bytes, const std::string& path);

}  // namespace voussoir
