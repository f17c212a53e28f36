#include "viz/scene.h"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFeatureEdges.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>

#include "solver/base/error.h"

namespace voussoir {
namespace {

constexpr double kFeatureAngle = 8.0;  // degrees; faces of one stone that turn less are one curved face

vtkDataArray* required(vtkDataSetAttributes* data, const char* name, const char* what) {
  vtkDataArray* array = data->GetArray(name);
  if (!array)
    throw InputError(
        "pictures: the {} have no field '{}'; give files written by voussoir (vtk/blocks_*.vtu, "
        "vtk/joints_*.vtp)",
        what, name);
  return array;
}

Vec3 base_displacement(vtkDataObject* data) {
  Vec3 base = Vec3::Zero();
  if (vtkDataArray* array = data->GetFieldData()->GetArray("base_displacement")) array->GetTuple(0, base.data());
  return base;
}

/// reference + amplification × displacement, where the stored points are reference + displacement + base.
vtkSmartPointer<vtkPoints> amplified_points(vtkPointSet* data, double amplification, const char* what) {
  vtkDataArray* displacement = required(data->GetPointData(), "displacement_of_point", what);
  const Vec3 base = base_displacement(data);
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  const vtkIdType n = data->GetNumberOfPoints();
  points->SetNumberOfPoints(n);
  for (vtkIdType i = 0; i < n; ++i) {
    Vec3 x, d;
    data->GetPoint(i, x.data());
    displacement->GetTuple(i, d.data());
    points->SetPoint(i, Vec3(x - base + (amplification - 1.0) * d).data());
  }
  return points;
}

/// A poly data with the given points and polygons, and the cell data of `from` for the cells listed in `origin`.
vtkSmartPointer<vtkPolyData> polygons_of(vtkDataSet* from, vtkPoints* points, vtkCellArray* polygons,
                                         vtkIdList* origin) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->GetPointData()->ShallowCopy(from->GetPointData());
  data->GetCellData()->CopyAllocate(from->GetCellData(), origin->GetNumberOfIds());
  for (vtkIdType i = 0; i < origin->GetNumberOfIds(); ++i)
    data->GetCellData()->CopyData(from->GetCellData(), origin->GetId(i), i);
  data->GetFieldData()->ShallowCopy(from->GetFieldData());
  return data;
}

}  // namespace

Hidden::Hidden(const std::vector<std::string>& names) : hidden_(component_names().size(), false) {
  const auto& known = component_names();
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end())
      throw InputError("pictures: there is no component '{}' to hide; give one of {}", name, fmt::join(known, ", "));
    hidden_[std::size_t(at - known.begin())] = true;
  }
}

vtkSmartPointer<vtkPolyData> deformed_faces(vtkUnstructuredGrid* grid, const Hidden& hidden, double amplification) {
  vtkDataArray* component = required(grid->GetCellData(), "component", "blocks");
  const auto points = amplified_points(grid, amplification, "blocks");
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> origin;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    if (hidden(int(component->GetComponent(c, 0)))) continue;
    vtkCell* cell = grid->GetCell(c);
    for (int f = 0; f < cell->GetNumberOfFaces(); ++f) {
      polygons->InsertNextCell(cell->GetFace(f)->GetPointIds());
      origin->InsertNextId(c);
    }
  }
  return polygons_of(grid, points, polygons, origin);
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

vtkSmartPointer<vtkPolyData> crack_patches(vtkPolyData* joints, const Hidden& hidden, double amplification,
                                           const CrackRule& rule) {
  const auto points = amplified_points(joints, amplification, "joints");
  const auto field = [&](const char* name) { return required(joints->GetCellData(), name, "joints"); };
  vtkDataArray *opening = field("largest_opening"), *slip = field("largest_slip"), *bonded = field("bonded");
  vtkDataArray *had_bond = field("had_bond"), *a = field("component_a"), *b = field("component_b");
  vtkDataArray* replaced = joints->GetCellData()->GetArray("replaced");  // its polygon lies where nothing is any more
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkIdList> origin, corners;
  for (vtkIdType c = 0; c < joints->GetNumberOfPolys(); ++c) {
    if (replaced && replaced->GetComponent(c, 0) != 0.0) continue;
    if (hidden(int(a->GetComponent(c, 0))) || hidden(int(b->GetComponent(c, 0)))) continue;
    const bool lost = had_bond->GetComponent(c, 0) != 0.0 && bonded->GetComponent(c, 0) < rule.bonded;
    const bool moved = opening->GetComponent(c, 0) > rule.opening || slip->GetComponent(c, 0) > rule.slip;
    if (!lost && !moved) continue;
    joints->GetCellPoints(c, corners);
    polygons->InsertNextCell(corners);
    origin->InsertNextId(c);
  }
  return polygons_of(joints, points, polygons, origin);
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
