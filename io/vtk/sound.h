// Whether what a VTK file says of itself holds together. VTK takes a damaged file at its word and reads past the end.
#pragma once
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <string>

namespace voussoir {

/// That the head of an XML file is whole and names a type for every array: its readers crash where one is missing.
bool head_is_sound(const std::string& path);
/// Arrays as long as there are points or cells, corners among the points, faces within their list, known components,
/// vectors of three.
bool is_sound(vtkUnstructuredGrid* grid);
bool is_sound(vtkPolyData* data);

}  // namespace voussoir
