#include "io/vtk/surface_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"

namespace voussoir {

const std::vector<SurfaceFormat>& surface_formats() {
  static const std::vector<SurfaceFormat> formats = {{".obj", parse_obj},   {".ply", parse_ply},
                                                     {".stl", parse_stl},   {".json", parse_compas},
                                                     {".gltf", parse_gltf}, {".glb", parse_gltf}};
  return formats;
}

Surface read_surface(const std::string& path) {
  std::vector<std::string> endings;
  for (const SurfaceFormat& format : surface_formats()) endings.push_back(format.ending);
  const auto known = [&] { return fmt::format("{}", fmt::join(endings, ", ")); };
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    throw InputError("{}: no such file; give a file with one of the endings: {}", path, known());
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  const auto format = std::find(endings.begin(), endings.end(), ending);
  if (format == endings.end())
    throw InputError("{}: the program does not read '{}' files; give one of: {}", path, shown(ending), known());
  const Surface surface = surface_formats()[std::size_t(format - endings.begin())].parse(read_text(path), path);
  if (surface.faces.empty()) throw InputError("{}: has no faces; export closed surfaces, one for each stone", path);
  return surface;
}

}  // namespace voussoir
