#include "viz/scene.h"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFeatureEdges.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <set>

#include "solver/base/error.h"

namespace voussoir {
namespace {

constexpr double kFeatureAngle = 8.0;  // degrees; faces of one stone that turn less are one curved face

vtkDataArray* required(vtkDataSetAttributes* data, const char* name, const char* what) {
  vtkDataArray* array = data->GetArray(name);
  if (!array)
    throw InputError(
        "pictures: the {} have no field '{}'. Give files written by voussoir (vtk/blocks_*.vtu, vtk/joints_*.vtp)",
        what, name);
  return array;
}

/// Polygons of a grid's cells, with the cell they come from.
struct Faces {
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> origin;
  void add(const Loop& loop, vtkIdType cell) {
    polygons->InsertNextCell(vtkIdType(loop.size()), loop.data());
    origin->InsertNextId(cell);
  }
};

/// A poly data with these points and polygons, and the cell data of the cells they come from.
vtkSmartPointer<vtkPolyData> polygons_of(vtkDataSet* from, const Places& places, double amplification,
                                         const Faces& faces) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(places.amplified(amplification));
  data->SetPolys(faces.polygons);
  data->GetPointData()->AddArray(places.displacements());
  data->GetCellData()->CopyAllocate(from->GetCellData(), faces.origin->GetNumberOfIds());
  for (vtkIdType i = 0; i < faces.origin->GetNumberOfIds(); ++i)
    data->GetCellData()->CopyData(from->GetCellData(), faces.origin->GetId(i), i);
  data->GetFieldData()->ShallowCopy(from->GetFieldData());
  return data;
}

Loop loop_of(vtkIdList* ids) {
  return {ids->begin(), ids->end()};
}

std::vector<Loop> faces_of(vtkCell* cell) {
  std::vector<Loop> faces;
  for (int f = 0; f < cell->GetNumberOfFaces(); ++f) faces.push_back(loop_of(cell->GetFace(f)->GetPointIds()));
  return faces;
}

Loop sorted(Loop loop) {
  std::sort(loop.begin(), loop.end());
  return loop;
}

/// The triangles that belong to one tetrahedron only, by their sorted corners.
std::set<Loop> outer_triangles(vtkUnstructuredGrid* grid) {
  std::set<Loop> outer;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    if (grid->GetCellType(c) != VTK_TETRA) continue;
    for (const Loop& face : faces_of(grid->GetCell(c)))
      if (const auto [at, fresh] = outer.insert(sorted(face)); !fresh) outer.erase(at);
  }
  return outer;
}

}  // namespace

Hidden::Hidden(const std::vector<std::string>& names) : hidden_(component_names().size(), false) {
  const auto& known = component_names();
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end())
      throw InputError("pictures: there is no component '{}' to hide. Give one of {}", name, fmt::join(known, ", "));
    hidden_[std::size_t(at - known.begin())] = true;
  }
}

vtkSmartPointer<vtkPolyData> deformed_faces(vtkUnstructuredGrid* grid, const Hidden& hidden, double amplification,
                                            const std::optional<CutPlane>& cut) {
  vtkDataArray* component = required(grid->GetCellData(), "component", "blocks");
  const std::set<Loop> outer = outer_triangles(grid);
  Places places(grid, "blocks");
  Faces faces;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    if (hidden(int(component->GetComponent(c, 0)))) continue;
    std::vector<Loop> loops = faces_of(grid->GetCell(c));
    std::vector<bool> seen(loops.size(), true);
    if (grid->GetCellType(c) == VTK_TETRA)
      for (std::size_t f = 0; f < loops.size(); ++f) seen[f] = outer.contains(sorted(loops[f]));
    if (cut) {
      for (const Loop& loop : cut_body(loops, seen, places, *cut)) faces.add(loop, c);
      continue;
    }
    for (std::size_t f = 0; f < loops.size(); ++f)
      if (seen[f]) faces.add(loops[f], c);
  }
  return polygons_of(grid, places, amplification, faces);
}

vtkSmartPointer<vtkPolyData> outlines(vtkPolyData* faces) {
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(faces);
  edges->SetFeatureAngle(kFeatureAngle);
  edges->FeatureEdgesOn();
  edges->BoundaryEdgesOn();
  edges->NonManifoldEdgesOn();
  edges->ManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();
  return edges->GetOutput();
}

vtkSmartPointer<vtkPolyData> joint_faces(vtkPolyData* joints, const Hidden& hidden, double amplification,
                                         const std::function<bool(vtkIdType)>& shown,
                                         const std::optional<CutPlane>& cut) {
  Places places(joints, "joints");
  vtkDataArray *a = required(joints->GetCellData(), "component_a", "joints"),
               *b = required(joints->GetCellData(), "component_b", "joints");
  vtkDataArray* replaced = joints->GetCellData()->GetArray("replaced");  // its polygon lies where nothing is any more
  Faces faces;
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < joints->GetNumberOfPolys(); ++c) {
    if (replaced && replaced->GetComponent(c, 0) != 0.0) continue;
    if (hidden(int(a->GetComponent(c, 0))) || hidden(int(b->GetComponent(c, 0)))) continue;
    if (!shown(c)) continue;
    joints->GetCellPoints(c, corners);
    Loop loop = loop_of(corners);
    if (cut && in_plane(loop, places, *cut)) continue;  // it would cover the section
    if (cut) loop = cut_polygon(loop, places, *cut, nullptr);
    if (loop.size() >= 3) faces.add(loop, c);
  }
  return polygons_of(joints, places, amplification, faces);
}

vtkSmartPointer<vtkPolyData> crack_patches(vtkPolyData* joints, const Hidden& hidden, double amplification,
                                           const CrackRule& rule, const std::optional<CutPlane>& cut) {
  const auto field = [&](const char* name) { return required(joints->GetCellData(), name, "joints"); };
  vtkDataArray *opening = field("largest_opening"), *slip = field("largest_slip"), *bonded = field("bonded");
  vtkDataArray* had_bond = field("had_bond");
  const auto cracked = [&](vtkIdType c) {
    const bool lost = had_bond->GetComponent(c, 0) != 0.0 && bonded->GetComponent(c, 0) < rule.bonded;
    return lost || opening->GetComponent(c, 0) > rule.opening || slip->GetComponent(c, 0) > rule.slip;
  };
  return joint_faces(joints, hidden, amplification, cracked, cut);
}

vtkSmartPointer<vtkPolyData> borders(vtkPolyData* polygons) {
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < polygons->GetNumberOfPolys(); ++c) {
    polygons->GetPolys()->GetCellAtId(c, corners);
    const vtkIdType n = corners->GetNumberOfIds();
    for (vtkIdType k = 0; k < n; ++k) {
      lines->InsertNextCell(2);
      lines->InsertCellPoint(corners->GetId(k));
      lines->InsertCellPoint(corners->GetId((k + 1) % n));
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(polygons->GetPoints());
  data->SetLines(lines);
  return data;
}

}  // namespace voussoir
