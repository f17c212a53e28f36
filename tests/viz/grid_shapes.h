// Grids of stones of unlike shapes, and what their cells hold.
#pragma once
#include <vtkCell.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>

#include "tests/viz/scenes.h"

namespace voussoir::test {

/// Volume of one cell of a grid, from its faces as VTK gives them (divergence theorem).
inline double cell_volume(vtkUnstructuredGrid* grid, vtkIdType c) {
  Polyhedron shape;
  vtkCell* cell = grid->GetCell(c);
  for (int f = 0; f < cell->GetNumberOfFaces(); ++f) {
    shape.faces.emplace_back();
    vtkPoints* points = cell->GetFace(f)->GetPoints();
    for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k) {
      shape.faces.back().push_back(int(shape.vertices.size()));
      shape.vertices.emplace_back(points->GetPoint(k));
    }
  }
  return mass_properties(shape).volume;
}

/// An L of two boxes whose common face is smaller than one of them, a wedge and a box.
inline Assembly mixed_shapes() {
  Assembly assembly;
  Block angle = make_block(make_box({0, 0, 0}, {2, 1, 1}), Component::wall);
  angle.cells.push_back(make_box({0, 0, 1}, {1, 1, 2}));
  assembly.blocks = {angle, make_block(make_prism({{5, 0, 0}, {7, 0, 0}, {5, 0, 1}}, {0, -3, 0}), Component::pier),
                     make_block(make_box({0, 5, 0}, {1, 6, 3}), Component::arch)};
  // make_prism wants its base clockwise or not depending on the sweep; a stone must have a positive volume.
  auto& wedge = assembly.blocks[1].cells[0];
  if (mass_properties(wedge).volume < 0)
    for (auto& loop : wedge.faces) std::reverse(loop.begin(), loop.end());
  finish(assembly);
  return assembly;
}

}  // namespace voussoir::test
