#include "io/vtk/sound.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include "geometry/assembly.h"

namespace voussoir {
namespace {

bool all_within(vtkDataArray* array, double low, double high) {
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    const double value = array->GetComponent(i, 0);
    if (!(value >= low && value <= high)) return false;
  }
  return true;
}

bool has_three(vtkFieldData* data, const char* name) {
  vtkDataArray* array = data->GetArray(name);
  return !array || (array->GetNumberOfComponents() == 3 && array->GetNumberOfTuples() > 0);
}

bool fits(vtkFieldData* data, vtkIdType rows) {
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    if (data->GetAbstractArray(i)->GetNumberOfTuples() != rows) return false;
  for (const char* name : {"component", "component_a", "component_b"})
    if (vtkDataArray* array = data->GetArray(name))
      if (!all_within(array, -1.0, double(component_names().size()) - 1.0)) return false;
  return true;
}

bool fits(vtkCellArray* cells, vtkIdType points) {
  vtkDataArray* offsets = cells->GetOffsetsArray();
  double last = 0.0;
  for (vtkIdType i = 0; i < offsets->GetNumberOfTuples(); ++i) {
    if (!(offsets->GetComponent(i, 0) >= last)) return false;
    last = offsets->GetComponent(i, 0);
  }
  return last == double(cells->GetConnectivityArray()->GetNumberOfTuples()) &&
         all_within(cells->GetConnectivityArray(), 0.0, double(points) - 1.0);
}

/// One polyhedron's faces from `at` on: their number, and for each the number of its corners and the corners.
bool faces_fit(vtkIdTypeArray* faces, vtkIdType at, vtkIdType points) {
  const vtkIdType size = faces->GetNumberOfTuples();
  if (at >= size) return false;
  const vtkIdType count = faces->GetValue(at++);
  for (vtkIdType f = 0; f < count; ++f) {
    if (at >= size) return false;
    const vtkIdType corners = faces->GetValue(at++);
    if (corners < 3 || corners > size - at) return false;
    for (const vtkIdType end = at + corners; at < end; ++at)
      if (faces->GetValue(at) < 0 || faces->GetValue(at) >= points) return false;
  }
  return true;
}

bool faces_fit(vtkUnstructuredGrid* grid) {
  vtkIdTypeArray *faces = grid->GetFaces(), *places = grid->GetFaceLocations();
  if (places && places->GetNumberOfTuples() != grid->GetNumberOfCells()) return false;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    const vtkIdType place = places ? places->GetValue(c) : -1;
    const int type = grid->GetCellType(c);
    if (type != VTK_POLYHEDRON && type != VTK_HEXAHEDRON && type != VTK_TETRA) return false;
    if (type == VTK_HEXAHEDRON && grid->GetCells()->GetCellSize(c) != 8) return false;
    if (type == VTK_TETRA && grid->GetCells()->GetCellSize(c) != 4) return false;
    if (type == VTK_POLYHEDRON && (place < 0 || !faces || !faces_fit(faces, place, grid->GetNumberOfPoints())))
      return false;
  }
  return true;
}

bool fields_fit(vtkPointSet* data) {
  return data->GetNumberOfPoints() > 0 && fits(data->GetPointData(), data->GetNumberOfPoints()) &&
         fits(data->GetCellData(), data->GetNumberOfCells()) &&
         has_three(data->GetPointData(), "displacement_of_point") &&
         has_three(data->GetFieldData(), "base_displacement") &&
         (!data->GetFieldData()->GetArray("TimeValue") ||
          data->GetFieldData()->GetArray("TimeValue")->GetNumberOfTuples() > 0);
}

bool types_are_stated(vtkXMLDataElement* element) {
  int type = 0;
  if (std::string_view(element->GetName()) == "DataArray" && !element->GetWordTypeAttribute("type", type)) return false;
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
    if (!types_are_stated(element->GetNestedElement(i))) return false;
  return true;
}

}  // namespace

bool head_is_sound(const std::string& path) {
  auto parser = vtkSmartPointer<vtkXMLDataParser>::New();
  parser->SetFileName(path.c_str());
  return parser->Parse() != 0 && parser->GetRootElement() && types_are_stated(parser->GetRootElement());
}

bool is_sound(vtkUnstructuredGrid* grid) {
  return grid->GetNumberOfCells() > 0 && fits(grid->GetCells(), grid->GetNumberOfPoints()) && fields_fit(grid) &&
         faces_fit(grid);
}

bool is_sound(vtkPolyData* data) {
  if (data->GetNumberOfPoints() == 0) return data->GetNumberOfCells() == 0;  // blocks without a joint
  return fits(data->GetPolys(), data->GetNumberOfPoints()) && fields_fit(data);
}

}  // namespace voussoir
