// Small helpers of the grids: named arrays, points in double precision.
#pragma once
#include <vtkDataObject.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>

#include "solver/step/snapshot.h"

namespace voussoir {

template <class ArrayType>
vtkSmartPointer<ArrayType> make_array(const char* name, vtkIdType rows, int columns = 1) {
  auto array = vtkSmartPointer<ArrayType>::New();
  array->SetName(name);
  array->SetNumberOfComponents(columns);
  array->SetNumberOfTuples(rows);
  return array;
}

inline vtkSmartPointer<vtkPoints> make_points() {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  return points;
}

/// TimeValue (s) and base_displacement (m).
void add_field_data(vtkDataObject* data, const Snapshot& snapshot);

}  // namespace voussoir
