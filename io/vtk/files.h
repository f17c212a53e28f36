// VTK XML files: appended raw data, compressed, written whole or not at all.
#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>

#include "io/vtk/packing.h"

namespace voussoir {

/// Throw RunError naming the path when the file cannot be written.
void write_vtu(vtkUnstructuredGrid* grid, const std::string& path, Packing packing = usual_packing);
void write_vtp(vtkPolyData* data, const std::string& path, Packing packing = usual_packing);

/// Throw InputError naming the path when the file is absent, damaged or of another kind.
vtkSmartPointer<vtkUnstructuredGrid> read_vtu(const std::string& path);
vtkSmartPointer<vtkPolyData> read_vtp(const std::string& path);

}  // namespace voussoir
