// Whether what a VTK file says of itself holds together. VTK takes a damaged file at its word and reads past the end.
#pragma once
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

namespace voussoir {

/// Arrays as long as there are points or cells, corners among the points, faces within their list, known components,
/// vectors of three.
bool is_sound(vtkUnstructuredGrid* grid);
bool is_sound(vtkPolyData* data);

}  // namespace voussoir
