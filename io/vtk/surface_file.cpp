#include "io/vtk/surface_file.h"

#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "io/vtk/quiet.h"
#include "solver/base/error.h"

namespace voussoir {
namespace {

/// Polygons of a VTK surface; the objects are told apart by the cell array `tag`, where there is one.
Surface from_polydata(vtkPolyData* data, vtkDataArray* tag) {
  Surface surface;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    Vec3 x;
    data->GetPoint(i, x.data());
    surface.vertices.push_back(x);
  }
  std::map<int, std::size_t> known;
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < data->GetNumberOfPolys(); ++c) {
    data->GetPolys()->GetCellAtId(c, corners);
    std::vector<int> loop;
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) loop.push_back(int(corners->GetId(k)));
    const auto [entry, fresh] = known.try_emplace(tag ? int(tag->GetComponent(c, 0)) : 0, surface.objects.size());
    if (fresh) surface.objects.push_back({});
    surface.objects[entry->second].faces.push_back(int(surface.faces.size()));
    surface.faces.push_back(loop);
    surface.face_lines.push_back(0);
  }
  return surface;
}

template <class Reader>
void read_quietly(Reader* reader, const std::string& path, const char* kind) {
  bool failed = false;
  reader->AddObserver(vtkCommand::ErrorEvent, error_flag(failed));
  reader->SetFileName(path.c_str());
  reader->Update();
  if (failed || reader->GetErrorCode() != 0) throw InputError("{}: cannot be read as {}; export it again", path, kind);
}

Surface read_stl(const std::string& path) {
  vtkNew<vtkSTLReader> reader;
  reader->ScalarTagsOn();
  read_quietly(reader.Get(), path, "STL");
  return from_polydata(reader->GetOutput(), reader->GetOutput()->GetCellData()->GetScalars());
}

Surface read_ply(const std::string& path) {
  vtkNew<vtkPLYReader> reader;
  read_quietly(reader.Get(), path, "PLY");
  return from_polydata(reader->GetOutput(), nullptr);
}

}  // namespace

Surface read_surface(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw InputError("{}: no such file; give an .obj, .ply or .stl file", path);
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  Surface surface;
  if (ending == ".obj")
    surface = read_obj(path);
  else if (ending == ".ply")
    surface = read_ply(path);
  else if (ending == ".stl")
    surface = read_stl(path);
  else
    throw InputError("{}: '{}' files are not read; give .obj, .ply or .stl", path, ending);
  if (surface.faces.empty()) throw InputError("{}: holds no faces; export closed surfaces, one per stone", path);
  return surface;
}

}  // namespace voussoir
