// Checks VTK files for consistency, because VTK does not check the numbers of a damaged file and may read beyond its
// end.
#pragma once
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <string>

namespace voussoir {

/// Whether the head of an XML file is complete and has a type for every array; the readers of VTK crash without it.
bool head_is_sound(const std::string& path);
/// Whether arrays have as many entries as there are points or cells, corners are points, faces are within their list,
/// components are known, and vectors have three components.
bool is_sound(vtkUnstructuredGrid* grid);
bool is_sound(vtkPolyData* data);

}  // namespace voussoir
