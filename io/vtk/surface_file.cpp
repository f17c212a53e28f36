#include "io/vtk/surface_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"

namespace voussoir {

Surface read_surface(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    throw InputError("{}: no such file; give an .obj, .ply or .stl file", path);
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  Surface surface;
  if (ending == ".obj")
    surface = parse_obj(read_text(path), path);
  else if (ending == ".ply")
    surface = parse_ply(read_text(path), path);
  else if (ending == ".stl")
    surface = parse_stl(read_text(path), path);
  else
    throw InputError("{}: '{}' files are not read; give .obj, .ply or .stl", path, shown(ending));
  if (surface.faces.empty()) throw InputError("{}: holds no faces; export closed surfaces, one per stone", path);
  return surface;
}

}  // namespace voussoir
