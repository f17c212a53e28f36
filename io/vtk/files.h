// VTK XML files: appended raw data, compressed, written atomically.
#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>

#include "io/vtk/packing.h"

namespace voussoir {

/// Write a file. Throw RunError with the path if it cannot be written.
void write_vtu(vtkUnstructuredGrid* grid, const std::string& path, Packing packing = usual_packing);
void write_vtp(vtkPolyData* data, const std::string& path, Packing packing = usual_packing);

/// Read a file. Throw InputError with the path if it is missing, damaged or of another kind.
vtkSmartPointer<vtkUnstructuredGrid> read_vtu(const std::string& path);
vtkSmartPointer<vtkPolyData> read_vtp(const std::string& path);

}  // namespace voussoir
