// Surface files of other programs, before they are split into stones.
#pragma once
#include <string>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// The faces with one name in a file: an object of an OBJ, a solid of an STL, all faces of a PLY, a block of COMPAS, a
/// node of glTF.
struct FileObject {
  std::string name;        // as in the file; empty if the format has no names
  std::size_t line = 0;    // of its first face in a text file; 0: unknown
  std::vector<int> faces;  // into Surface::faces
  std::string layer{};     // the group (`g`) of an object of an OBJ, or the parent node in glTF
  bool support = false;    // whether the file fixes it
};

struct Surface {
  std::vector<Vec3> vertices;           // file units
  std::vector<std::vector<int>> faces;  // vertex loops as in the file
  std::vector<std::size_t> face_lines;  // line of each face; 0: unknown
  std::vector<FileObject> objects;      // in file order, none empty
  std::vector<std::string> notes;       // parts of the file that were ignored, in words
  std::string up = "z";                 // the axis that points up by the rules of the format
};

/// A kind of file. A new kind needs one file here and one line in surface_file.cpp.
struct SurfaceFormat {
  std::string ending;  // with the point, in lower case
  Surface (*parse)(const std::string& bytes, const std::string& path);
};
const std::vector<SurfaceFormat>& surface_formats();

/// Reads a file; its ending, in any case, selects the format. Throws InputError with file and, if known, line.
Surface read_surface(const std::string& path);
// The following functions parse the bytes of a file; `path` is used in messages.

/// OBJ: v, f (also negative and slashed indices), o, g; other keywords are ignored. Objects are those of `o`, with
/// `g` as their layers, or those of `g` in a file without `o`.
Surface parse_obj(const std::string& text, const std::string& path);
/// STL, text or binary. Each `solid` of a text file is an object. Corners with identical coordinates are one
/// vertex. Bytes after the last facet of a binary file are ignored, with a note.
Surface parse_stl(const std::string& bytes, const std::string& path);
/// PLY 1.0, text or binary: the elements `vertex` (x, y, z) and `face` (vertex_indices); others are ignored.
Surface parse_ply(const std::string& bytes, const std::string& path);
/// JSON of COMPAS: blocks of an Assembly, a Model or a list of meshes (for the forms see compas_json.cpp).
Surface parse_compas(const std::string& text, const std::string& path);
/// glTF 2.0, as JSON (buffers embedded or in files in the folder of `path`) or binary. y points up by the standard.
Surface parse_gltf(const std::string& bytes, const std::string& path);

}  // namespace voussoir
